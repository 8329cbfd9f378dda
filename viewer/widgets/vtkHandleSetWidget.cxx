// Two states. Hovering: the mouse only moves the highlight, and events pass on. Dragging: the
// widget holds the focus, moves go to the representation, and every change of transforms is told
// by an InteractionEvent.
#include "vtkHandleSetWidget.h"

#include "vtkHandleSetRepresentation.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkEvent.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkWidgetCallbackMapper.h"
#include "vtkWidgetEvent.h"

#include <cstring>

vtkStandardNewMacro(vtkHandleSetWidget);

vtkHandleSetWidget::vtkHandleSetWidget()
{
  this->CallbackMapper->SetCallbackMethod(
    vtkCommand::MouseMoveEvent, vtkWidgetEvent::Move, this, vtkHandleSetWidget::MoveAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::LeftButtonPressEvent, vtkWidgetEvent::Select,
    this, vtkHandleSetWidget::SelectAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::LeftButtonReleaseEvent,
    vtkWidgetEvent::EndSelect, this, vtkHandleSetWidget::EndSelectAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::KeyPressEvent, vtkEvent::AnyModifier, 0, 0,
    "Escape", vtkWidgetEvent::Reset, this, vtkHandleSetWidget::CancelAction);
}

vtkHandleSetWidget::~vtkHandleSetWidget() = default;

void vtkHandleSetWidget::SetRepresentation(vtkHandleSetRepresentation* representation)
{
  this->SetWidgetRepresentation(representation);
}

vtkHandleSetRepresentation* vtkHandleSetWidget::GetHandleSetRepresentation()
{
  return static_cast<vtkHandleSetRepresentation*>(this->GetRepresentation());
}

void vtkHandleSetWidget::CreateDefaultRepresentation()
{
  if (!this->WidgetRep)
  {
    this->WidgetRep = vtkHandleSetRepresentation::New();
  }
}

void vtkHandleSetWidget::SetHandles(vtkPolyData* handles)
{
  this->CancelDrag();
  this->GetHandleSetRepresentation()->SetHandles(handles);
}

vtkPolyData* vtkHandleSetWidget::GetHandles()
{
  return this->GetHandleSetRepresentation()->GetHandles();
}

void vtkHandleSetWidget::SetEnabled(int enabling)
{
  if (!enabling)
  {
    this->CancelDrag();
  }
  this->Superclass::SetEnabled(enabling);
}

bool vtkHandleSetWidget::Hover()
{
  vtkHandleSetRepresentation* representation = this->GetHandleSetRepresentation();
  const int x = this->Interactor->GetEventPosition()[0];
  const int y = this->Interactor->GetEventPosition()[1];
  const vtkIdType before = representation->GetHoveredHandle();
  int state = vtkHandleSetRepresentation::OUTSIDE;
  if (this->CurrentRenderer && this->CurrentRenderer->IsInViewport(x, y))
  {
    state = representation->ComputeInteractionState(x, y);
  }
  else
  {
    representation->SetHoveredHandle(-1);
  }
  if (representation->GetHoveredHandle() != before)
  {
    this->RequestCursorShape(
      state == vtkHandleSetRepresentation::OUTSIDE ? VTK_CURSOR_DEFAULT : VTK_CURSOR_HAND);
    this->InvokeEvent(vtkCommand::HighlightEvent, nullptr);
    this->Render();
  }
  return state != vtkHandleSetRepresentation::OUTSIDE;
}

void vtkHandleSetWidget::MoveAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkHandleSetWidget*>(widget);
  if (self->State == HOVERING)
  {
    self->Hover();
    return;
  }
  double position[2] = { static_cast<double>(self->Interactor->GetEventPosition()[0]),
    static_cast<double>(self->Interactor->GetEventPosition()[1]) };
  self->GetHandleSetRepresentation()->WidgetInteraction(position);
  self->EventCallbackCommand->SetAbortFlag(1);
  self->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  self->Render();
}

void vtkHandleSetWidget::SelectAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkHandleSetWidget*>(widget);
  if (self->State == DRAGGING || !self->Hover())
  {
    return; // the camera's
  }
  self->EventCallbackCommand->SetAbortFlag(1);
  vtkHandleSetRepresentation* representation = self->GetHandleSetRepresentation();
  if (representation->GetSelectedHandle() != representation->GetHoveredHandle())
  {
    representation->SetSelectedHandle(representation->GetHoveredHandle());
    self->InvokeEvent(vtkCommand::SelectionChangedEvent, nullptr);
  }
  double position[2] = { static_cast<double>(self->Interactor->GetEventPosition()[0]),
    static_cast<double>(self->Interactor->GetEventPosition()[1]) };
  representation->StartWidgetInteraction(position);
  if (representation->GetActiveHandle() >= 0)
  {
    self->State = DRAGGING;
    self->Cancelled = false;
    self->GrabFocus(self->EventCallbackCommand, self->EventCallbackCommand);
    self->Superclass::StartInteraction();
    self->InvokeEvent(vtkCommand::StartInteractionEvent, nullptr);
  }
  self->Render();
}

void vtkHandleSetWidget::EndSelectAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkHandleSetWidget*>(widget);
  if (self->State != DRAGGING)
  {
    return;
  }
  double position[2] = { static_cast<double>(self->Interactor->GetEventPosition()[0]),
    static_cast<double>(self->Interactor->GetEventPosition()[1]) };
  self->GetHandleSetRepresentation()->EndWidgetInteraction(position);
  self->State = HOVERING;
  self->ReleaseFocus();
  self->EventCallbackCommand->SetAbortFlag(1);
  self->Superclass::EndInteraction();
  self->InvokeEvent(vtkCommand::EndInteractionEvent, nullptr);
  self->Render();
}

void vtkHandleSetWidget::CancelAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkHandleSetWidget*>(widget);
  // The translator takes a key without a name for any key.
  const char* key = self->Interactor->GetKeySym();
  if (self->State == DRAGGING && key && std::strcmp(key, "Escape") == 0)
  {
    self->EventCallbackCommand->SetAbortFlag(1);
    self->CancelDrag();
  }
}

void vtkHandleSetWidget::CancelDrag()
{
  if (this->State != DRAGGING)
  {
    return;
  }
  this->GetHandleSetRepresentation()->CancelWidgetInteraction();
  this->State = HOVERING;
  this->Cancelled = true;
  this->ReleaseFocus();
  this->Superclass::EndInteraction();
  this->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  this->InvokeEvent(vtkCommand::EndInteractionEvent, nullptr);
  this->Render();
}

void vtkHandleSetWidget::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "State: " << (this->State == DRAGGING ? "dragging" : "hovering") << "\n";
  os << indent << "Cancelled: " << (this->Cancelled ? "yes" : "no") << "\n";
}
