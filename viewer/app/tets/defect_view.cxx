#include "app/tets/defect_view.h"

#include "app/view/viewport.h"

#include "scene/categories.h"
#include "scene/defect_actors.h"

#include "vtkActor.h"
#include "vtkRenderer.h"

#include <QCoreApplication>

namespace app::tets
{

DefectView::DefectView(view::Viewport* viewport) : viewport_(viewport) {}

void DefectView::set_defects(vtkPolyData* defects)
{
  for (const auto& actor : this->actors_)
  {
    this->viewport_->renderer()->RemoveActor(actor);
  }
  this->actors_.clear();
  this->defects_ = defects;
  if (defects)
  {
    this->actors_ = bindpose::make_defects(defects, 2.0 * this->viewport_->devicePixelRatioF());
    for (const auto& actor : this->actors_)
    {
      this->viewport_->renderer()->AddActor(actor);
    }
  }
  this->update();
}

void DefectView::show(bool shown)
{
  this->shown_ = shown;
  this->update();
}

void DefectView::update()
{
  for (const auto& actor : this->actors_)
  {
    actor->SetVisibility(this->is_shown());
  }
  std::vector<bindpose::Category> categories = bindpose::defect_categories();
  if (this->is_shown())
  {
    bindpose::count_defects(this->defects_, categories);
  }
  const bindpose::ColorMap map = bindpose::category_map(categories);
  this->viewport_->show_legend(view::Viewport::defect_legend,
    !this->is_shown()     ? QString()
      : map.texts.empty() ? QCoreApplication::translate("DefectView", "No defects")
                          : QCoreApplication::translate("DefectView", "Defects"),
    map);
}

} // namespace app::tets
