// The widget has two states, like vtkHandleSetWidget. While hovering, the disc follows the mouse,
// and events are passed on. While painting, the widget has the focus.
#include "vtkRegionBrushWidget.h"

#include "handle_bindings.h"
#include "vtkRegionBrushRepresentation.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkWidgetCallbackMapper.h"
#include "vtkWidgetEvent.h"

#include <cstring>

namespace
{
// Factor on the brush radius per turn of the wheel or press of a key.
constexpr double growth = 1.15;

bool is_key(const char* keys, const char* key)
{
  return key && *key && std::strstr(keys, (" " + std::string(key) + " ").c_str()) != nullptr;
}
} // namespace

vtkStandardNewMacro(vtkRegionBrushWidget);

vtkRegionBrushWidget::vtkRegionBrushWidget()
{
  this->CallbackMapper->SetCallbackMethod(
    vtkCommand::MouseMoveEvent, vtkWidgetEvent::Move, this, vtkRegionBrushWidget::MoveAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::LeftButtonPressEvent, vtkWidgetEvent::Select,
    this, vtkRegionBrushWidget::SelectAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::LeftButtonReleaseEvent,
    vtkWidgetEvent::EndSelect, this, vtkRegionBrushWidget::EndSelectAction);
  this->CallbackMapper->SetCallbackMethod(
    vtkCommand::MouseWheelForwardEvent, vtkWidgetEvent::Up, this, vtkRegionBrushWidget::GrowAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::MouseWheelBackwardEvent, vtkWidgetEvent::Down,
    this, vtkRegionBrushWidget::ShrinkAction);
  this->CallbackMapper->SetCallbackMethod(
    vtkCommand::KeyPressEvent, vtkWidgetEvent::ModifyEvent, this, vtkRegionBrushWidget::KeyAction);
}

vtkRegionBrushWidget::~vtkRegionBrushWidget() = default;

void vtkRegionBrushWidget::SetRepresentation(vtkRegionBrushRepresentation* representation)
{
  this->SetWidgetRepresentation(representation);
}

vtkRegionBrushRepresentation* vtkRegionBrushWidget::GetRegionBrushRepresentation()
{
  return static_cast<vtkRegionBrushRepresentation*>(this->GetRepresentation());
}

void vtkRegionBrushWidget::CreateDefaultRepresentation()
{
  if (!this->WidgetRep)
  {
    this->WidgetRep = vtkRegionBrushRepresentation::New();
  }
}

void vtkRegionBrushWidget::SetSurface(vtkPolyData* surface)
{
  this->CancelStroke();
  this->GetRegionBrushRepresentation()->SetSurface(surface);
}

void vtkRegionBrushWidget::SetEnabled(int enabling)
{
  if (!enabling)
  {
    this->CancelStroke();
    this->GetRegionBrushRepresentation()->Leave();
  }
  this->Superclass::SetEnabled(enabling);
}

std::string vtkRegionBrushWidget::GetInteractionName()
{
  return this->Erased ? "erase region" : "paint region";
}

bool vtkRegionBrushWidget::Hover()
{
  vtkRegionBrushRepresentation* brush = this->GetRegionBrushRepresentation();
  const int x = this->Interactor->GetEventPosition()[0];
  const int y = this->Interactor->GetEventPosition()[1];
  const int before = brush->GetInteractionState();
  if (this->CurrentRenderer && this->CurrentRenderer->IsInViewport(x, y))
  {
    brush->SetErase(this->Interactor->GetControlKey() != 0);
    brush->ComputeInteractionState(x, y);
  }
  else
  {
    brush->Leave();
  }
  const bool on = brush->GetInteractionState() == vtkRegionBrushRepresentation::ON_SURFACE;
  if (on || brush->GetInteractionState() != before)
  {
    this->Render();
  }
  return on;
}

void vtkRegionBrushWidget::MoveAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkRegionBrushWidget*>(widget);
  if (self->State == HOVERING)
  {
    self->Hover();
    return;
  }
  double position[2] = { static_cast<double>(self->Interactor->GetEventPosition()[0]),
    static_cast<double>(self->Interactor->GetEventPosition()[1]) };
  self->GetRegionBrushRepresentation()->WidgetInteraction(position);
  self->EventCallbackCommand->SetAbortFlag(1);
  self->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  self->Render();
}

void vtkRegionBrushWidget::SelectAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkRegionBrushWidget*>(widget);
  if (self->State == PAINTING || !self->Hover())
  {
    return; // not on the surface: the camera handles the event
  }
  self->EventCallbackCommand->SetAbortFlag(1);
  self->State = PAINTING;
  self->Canceled = false;
  self->Erased = self->Interactor->GetControlKey() != 0;
  self->GrabFocus(self->EventCallbackCommand, self->EventCallbackCommand);
  self->Superclass::StartInteraction();
  self->InvokeEvent(vtkCommand::StartInteractionEvent, nullptr);
  double position[2] = { static_cast<double>(self->Interactor->GetEventPosition()[0]),
    static_cast<double>(self->Interactor->GetEventPosition()[1]) };
  self->GetRegionBrushRepresentation()->StartWidgetInteraction(position);
  self->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  self->Render();
}

void vtkRegionBrushWidget::EndSelectAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkRegionBrushWidget*>(widget);
  if (self->State == PAINTING)
  {
    self->EventCallbackCommand->SetAbortFlag(1);
    double position[2] = { static_cast<double>(self->Interactor->GetEventPosition()[0]),
      static_cast<double>(self->Interactor->GetEventPosition()[1]) };
    vtkRegionBrushRepresentation* brush = self->GetRegionBrushRepresentation();
    brush->EndWidgetInteraction(position);
    self->Finish(brush->GetNumberOfChangedPoints() == 0);
  }
}

void vtkRegionBrushWidget::Finish(bool canceled)
{
  this->State = HOVERING;
  this->Canceled = canceled;
  this->ReleaseFocus();
  this->Superclass::EndInteraction();
  this->InvokeEvent(vtkCommand::EndInteractionEvent, nullptr);
  this->Render();
}

void vtkRegionBrushWidget::CancelStroke()
{
  if (this->State == PAINTING)
  {
    this->GetRegionBrushRepresentation()->CancelWidgetInteraction();
    this->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
    this->Finish(true);
  }
}

// ---- The disc's size ---------------------------------------------------------------------------

void vtkRegionBrushWidget::Resize(double factor)
{
  vtkRegionBrushRepresentation* brush = this->GetRegionBrushRepresentation();
  brush->SetRadius(factor * brush->GetDiscRadius());
  this->EventCallbackCommand->SetAbortFlag(1);
  this->InvokeEvent(vtkCommand::StateChangedEvent, nullptr);
  this->Render();
}

bool vtkRegionBrushWidget::WheelResizesDisc()
{
  return this->State == PAINTING ||
    (this->Interactor->GetShiftKey() &&
      this->GetRegionBrushRepresentation()->GetInteractionState() ==
        vtkRegionBrushRepresentation::ON_SURFACE);
}

void vtkRegionBrushWidget::GrowAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkRegionBrushWidget*>(widget);
  if (self->WheelResizesDisc())
  {
    self->Resize(growth);
  }
}

void vtkRegionBrushWidget::ShrinkAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkRegionBrushWidget*>(widget);
  if (self->WheelResizesDisc())
  {
    self->Resize(1.0 / growth);
  }
}

void vtkRegionBrushWidget::KeyAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkRegionBrushWidget*>(widget);
  const char* key = self->Interactor->GetKeySym();
  for (const bindpose::BrushBinding& binding : bindpose::brush_bindings)
  {
    if (!is_key(binding.keys, key))
    {
      continue;
    }
    if (binding.action == bindpose::BrushAction::grow)
    {
      self->Resize(growth);
    }
    else if (binding.action == bindpose::BrushAction::shrink)
    {
      self->Resize(1.0 / growth);
    }
    else if (binding.action == bindpose::BrushAction::cancel && self->State == PAINTING)
    {
      self->EventCallbackCommand->SetAbortFlag(1);
      self->CancelStroke();
    }
  }
}

int vtkRegionBrushWidget::GetNumberOfBindings()
{
  return static_cast<int>(bindpose::brush_bindings.size());
}

std::string vtkRegionBrushWidget::GetBindingWhen(int row)
{
  return row >= 0 && row < GetNumberOfBindings() ? bindpose::brush_bindings[row].context : "";
}

std::string vtkRegionBrushWidget::GetBindingInput(int row)
{
  return row >= 0 && row < GetNumberOfBindings() ? bindpose::brush_bindings[row].input : "";
}

std::string vtkRegionBrushWidget::GetBindingText(int row)
{
  return row >= 0 && row < GetNumberOfBindings() ? bindpose::brush_bindings[row].text : "";
}

void vtkRegionBrushWidget::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "State: " << (this->State == PAINTING ? "painting" : "hovering") << "\n";
  os << indent << "Canceled: " << (this->Canceled ? "yes" : "no") << "\n";
}
