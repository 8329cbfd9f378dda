// Draws short texts in the window. A text actor renders its letters in the opaque pass and shows
// them in the overlay pass, so both passes are necessary.
#include "screen_labels.h"

#include "vtkCoordinate.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

namespace bindpose
{

void ScreenLabels::add(
  const std::string& text, const Eigen::Vector2d& display, double scale, const double* color)
{
  if (this->actors_.size() == this->used_actors_)
  {
    this->actors_.push_back(vtkSmartPointer<vtkTextActor>::New());
    this->actors_.back()->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
  }
  vtkTextActor* label = this->actors_[this->used_actors_++];
  label->SetInput((color ? text : " " + text + " ").c_str());
  vtkTextProperty* property = label->GetTextProperty();
  property->ShallowCopy(this->text_);
  property->SetFontSize(static_cast<int>(this->text_->GetFontSize() * scale + 0.5));
  if (color)
  {
    property->SetColor(color[0], color[1], color[2]);
    property->SetBackgroundOpacity(0.0);
    property->SetJustificationToCentered();
    property->BoldOn();
  }
  label->SetDisplayPosition(static_cast<int>(display[0]), static_cast<int>(display[1]));
}

int ScreenLabels::render(vtkViewport* viewport)
{
  int rendered = 0;
  for (std::size_t i = 0; i < this->used_actors_; ++i)
  {
    this->actors_[i]->RenderOpaqueGeometry(viewport);
    rendered += this->actors_[i]->RenderOverlay(viewport);
  }
  return rendered;
}

void ScreenLabels::release(vtkWindow* window)
{
  for (const auto& actor : this->actors_)
  {
    actor->ReleaseGraphicsResources(window);
  }
}

} // namespace bindpose
