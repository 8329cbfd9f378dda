// The widget has two states. While hovering, the mouse only moves the highlight, and events are
// passed on. While dragging, the widget has the focus, moves are passed to the representation, and
// an InteractionEvent reports every change of poses. Keys are looked up in handle_bindings.h.
#include "vtkHandleSetWidget.h"

#include "handle_bindings.h"
#include "vtkHandleSetRepresentation.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkWidgetCallbackMapper.h"
#include "vtkWidgetEvent.h"

#include <cctype>
#include <cstring>

using bindpose::HandleAction;

namespace
{
/// Map a letter to lower case, so that it is the same key with and without Shift.
std::string plain_key(const char* key)
{
  std::string name = key ? key : "";
  if (name.size() == 1)
  {
    name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
  }
  return name;
}

bool is_key_of(HandleAction action, const std::string& key)
{
  for (const bindpose::HandleBinding& binding : bindpose::handle_bindings)
  {
    if (binding.action == action && !key.empty() &&
      std::strstr(binding.keys, (" " + key + " ").c_str()))
    {
      return true;
    }
  }
  return false;
}

/// Return the character that vtkHandleSetRepresentation::TypeIntoDrag() expects.
char typed_character(const std::string& key)
{
  if (key == "period" || key == "comma" || key == "KP_Decimal")
  {
    return '.';
  }
  if (key == "minus" || key == "KP_Subtract")
  {
    return '-';
  }
  return key == "BackSpace" ? 'b' : key.back();
}
} // namespace

vtkStandardNewMacro(vtkHandleSetWidget);

vtkHandleSetWidget::vtkHandleSetWidget()
{
  this->CallbackMapper->SetCallbackMethod(
    vtkCommand::MouseMoveEvent, vtkWidgetEvent::Move, this, vtkHandleSetWidget::MoveAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::LeftButtonPressEvent, vtkWidgetEvent::Select,
    this, vtkHandleSetWidget::SelectAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::LeftButtonReleaseEvent,
    vtkWidgetEvent::EndSelect, this, vtkHandleSetWidget::EndSelectAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::RightButtonPressEvent, vtkWidgetEvent::Reset,
    this, vtkHandleSetWidget::CancelAction);
  this->CallbackMapper->SetCallbackMethod(vtkCommand::LeftButtonDoubleClickEvent,
    vtkWidgetEvent::AddFinalPoint, this, vtkHandleSetWidget::DoubleClickAction);
  this->CallbackMapper->SetCallbackMethod(
    vtkCommand::KeyPressEvent, vtkWidgetEvent::ModifyEvent, this, vtkHandleSetWidget::KeyAction);
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

std::string vtkHandleSetWidget::GetInteractionName()
{
  return this->GetHandleSetRepresentation()->GetInteractionName();
}

// ---- The mouse ---------------------------------------------------------------------------------

bool vtkHandleSetWidget::Hover()
{
  vtkHandleSetRepresentation* representation = this->GetHandleSetRepresentation();
  this->ReadModifiers();
  const int x = this->Interactor->GetEventPosition()[0];
  const int y = this->Interactor->GetEventPosition()[1];
  const vtkIdType handle_before = representation->GetHoveredHandle();
  const int state_before = representation->GetInteractionState();
  int state = vtkHandleSetRepresentation::OUTSIDE;
  if (this->CurrentRenderer && this->CurrentRenderer->IsInViewport(x, y))
  {
    state = representation->ComputeInteractionState(x, y);
  }
  else
  {
    representation->LeaveHandles();
  }
  // Outside the gizmo, all parts of a handle have the same highlight.
  const bool on_gizmo = state >= vtkHandleSetRepresentation::MOVE_X ||
    state_before >= vtkHandleSetRepresentation::MOVE_X;
  if (representation->GetEditMode() > vtkHandleSetRepresentation::MOVE_REST &&
    (on_gizmo || state_before != state))
  {
    this->Render(); // the preview of an edit mode follows the mouse
  }
  if (representation->GetHoveredHandle() != handle_before || (on_gizmo && state != state_before))
  {
    const bool usable = state != vtkHandleSetRepresentation::OUTSIDE &&
      representation->GetDragRefusal(representation->GetHoveredHandle()) ==
        vtkHandleSetRepresentation::DRAGGABLE;
    this->RequestCursorShape(usable ? VTK_CURSOR_HAND : VTK_CURSOR_DEFAULT);
    this->InvokeEvent(vtkCommand::HighlightEvent, nullptr);
    this->Render();
  }
  return state != vtkHandleSetRepresentation::OUTSIDE;
}

void vtkHandleSetWidget::ReadModifiers()
{
  vtkHandleSetRepresentation* representation = this->GetHandleSetRepresentation();
  representation->SetFine(this->Interactor->GetShiftKey() != 0);
  representation->SetSnap(this->Interactor->GetControlKey() != 0);
  representation->SetReach(this->Interactor->GetAltKey() != 0);
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
  self->ReadModifiers();
  self->Moved = true;
  self->GetHandleSetRepresentation()->WidgetInteraction(position);
  self->EventCallbackCommand->SetAbortFlag(1);
  if (self->GetEditMode() <= vtkHandleSetRepresentation::MOVE_REST)
  {
    self->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  }
  self->Render();
}

void vtkHandleSetWidget::SelectAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkHandleSetWidget*>(widget);
  if (self->State == DRAGGING)
  {
    self->EventCallbackCommand->SetAbortFlag(1);
    if (self->StartedByKey)
    {
      self->EndDrag();
    }
    return;
  }
  if (!self->Hover())
  {
    return; // not on a handle: the camera handles the event
  }
  self->EventCallbackCommand->SetAbortFlag(1);
  vtkHandleSetRepresentation* representation = self->GetHandleSetRepresentation();
  const vtkIdType handle = representation->GetHoveredHandle();
  const bool on_gizmo = representation->GetInteractionState() >= vtkHandleSetRepresentation::MOVE_X;
  if (!on_gizmo && self->Interactor->GetShiftKey())
  {
    // The mouse is on an existing handle. (At a position for a new handle, on_gizmo is also true,
    // because the state PLACING is above MOVE_X.)
    representation->ToggleSelected(handle);
    self->InvokeEvent(vtkCommand::SelectionChangedEvent, nullptr);
    self->Render();
    return;
  }
  const bool is_add_mode = representation->GetEditMode() > vtkHandleSetRepresentation::MOVE_REST;
  if (!is_add_mode && !representation->IsSelected(handle))
  {
    representation->SetSelectedHandle(handle);
    self->InvokeEvent(vtkCommand::SelectionChangedEvent, nullptr);
  }
  if (self->IsEditing())
  {
    self->PressInEditMode();
    return;
  }
  double position[2] = { static_cast<double>(self->Interactor->GetEventPosition()[0]),
    static_cast<double>(self->Interactor->GetEventPosition()[1]) };
  self->ReadModifiers();
  representation->StartWidgetInteraction(position);
  if (representation->GetActiveHandle() >= 0)
  {
    self->StartedByKey = false;
    self->BeginDragging();
  }
  self->Render();
}

/// Handle a press in edit modes. StartInteractionEvent is invoked before any change, so that an
/// observer can store the handles for an undo.
void vtkHandleSetWidget::PressInEditMode()
{
  vtkHandleSetRepresentation* representation = this->GetHandleSetRepresentation();
  double position[2] = { static_cast<double>(this->Interactor->GetEventPosition()[0]),
    static_cast<double>(this->Interactor->GetEventPosition()[1]) };
  if (this->Interactor->GetRepeatCount() > 0 && representation->FinishCage())
  {
    this->Render(); // redraw: a double click has ended the cage
    return;
  }
  this->ReadModifiers();
  this->StartedByKey = false;
  this->BeginDragging();
  representation->StartWidgetInteraction(position);
  if (!representation->IsInteracting())
  {
    this->FinishDragging(!representation->GetEdited());
  }
  this->Render();
}

void vtkHandleSetWidget::DoubleClickAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkHandleSetWidget*>(widget);
  if (self->State == HOVERING && self->GetHandleSetRepresentation()->FinishCage())
  {
    self->EventCallbackCommand->SetAbortFlag(1);
    self->Render();
  }
}

bool vtkHandleSetWidget::IsEditing()
{
  return this->GetEditMode() != vtkHandleSetRepresentation::POSE;
}

void vtkHandleSetWidget::SetEditMode(int mode)
{
  if (mode != this->GetEditMode())
  {
    this->CancelDrag();
    this->GetHandleSetRepresentation()->SetEditMode(mode);
  }
}

int vtkHandleSetWidget::GetEditMode()
{
  return this->GetHandleSetRepresentation()->GetEditMode();
}

void vtkHandleSetWidget::EndSelectAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkHandleSetWidget*>(widget);
  if (self->State != DRAGGING || self->StartedByKey)
  {
    return;
  }
  self->EventCallbackCommand->SetAbortFlag(1);
  vtkHandleSetRepresentation* representation = self->GetHandleSetRepresentation();
  const vtkIdType handle = representation->GetActiveHandle();
  const bool click = !self->Moved && representation->GetNumberOfSelectedHandles() > 1 &&
    representation->GetInteractionState() < vtkHandleSetRepresentation::MOVE_X;
  self->EndDrag();
  if (click) // a click without a drag on one of several selected handles
  {
    representation->SetSelectedHandle(handle);
    self->InvokeEvent(vtkCommand::SelectionChangedEvent, nullptr);
    self->Render();
  }
}

void vtkHandleSetWidget::CancelAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkHandleSetWidget*>(widget);
  if (self->State == DRAGGING)
  {
    self->EventCallbackCommand->SetAbortFlag(1);
    self->CancelDrag();
  }
}

// ---- The keyboard ------------------------------------------------------------------------------

void vtkHandleSetWidget::KeyAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkHandleSetWidget*>(widget);
  if (self->PressKey(plain_key(self->Interactor->GetKeySym())))
  {
    self->EventCallbackCommand->SetAbortFlag(1);
  }
}

bool vtkHandleSetWidget::PressKey(const std::string& key)
{
  if (this->State == DRAGGING)
  {
    return this->PressKeyInDrag(key);
  }
  if (this->IsEditing())
  {
    return this->PressKeyInEditMode(key);
  }
  if (!this->StartKeys || this->Interactor->GetControlKey() || this->Interactor->GetAltKey())
  {
    return false;
  }
  const std::pair<HandleAction, int> starts[3] = { { HandleAction::start_move,
                                                     vtkHandleSetRepresentation::GIZMO_MOVE },
    { HandleAction::start_turn, vtkHandleSetRepresentation::GIZMO_TURN },
    { HandleAction::start_scale, vtkHandleSetRepresentation::GIZMO_SCALE } };
  for (const auto& [action, gizmo] : starts)
  {
    if (is_key_of(action, key))
    {
      return this->StartDrag(gizmo);
    }
  }
  return false;
}

bool vtkHandleSetWidget::PressKeyInEditMode(const std::string& key)
{
  vtkHandleSetRepresentation* representation = this->GetHandleSetRepresentation();
  if (is_key_of(HandleAction::finish_cage, key) && representation->FinishCage())
  {
    this->Render();
    return true;
  }
  if (!is_key_of(HandleAction::drop_vertex, key))
  {
    return false;
  }
  if (representation->IsMakingCage())
  {
    this->BeginDragging();
    representation->DropCageVertex();
    this->FinishDragging(!representation->GetEdited());
  }
  else
  {
    this->SetEditMode(vtkHandleSetRepresentation::POSE);
    this->InvokeEvent(vtkCommand::StateChangedEvent, nullptr);
    this->Render();
  }
  return true;
}

bool vtkHandleSetWidget::PressKeyInDrag(const std::string& key)
{
  vtkHandleSetRepresentation* representation = this->GetHandleSetRepresentation();
  if (is_key_of(HandleAction::cancel, key))
  {
    this->CancelDrag();
    return true;
  }
  if (is_key_of(HandleAction::confirm, key))
  {
    this->EndDrag();
    return true;
  }
  if (this->GetEditMode() > vtkHandleSetRepresentation::MOVE_REST)
  {
    return false;
  }
  if (is_key_of(HandleAction::constrain_to_axis, key))
  {
    representation->ConstrainDrag(key[0] - 'x', this->Interactor->GetShiftKey() != 0);
  }
  else if (!is_key_of(HandleAction::type, key) ||
    !representation->TypeIntoDrag(typed_character(key)))
  {
    return false;
  }
  this->Moved = true;
  this->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  this->Render();
  return true;
}

int vtkHandleSetWidget::GetNumberOfBindings()
{
  return static_cast<int>(bindpose::handle_bindings.size());
}

std::string vtkHandleSetWidget::GetBindingWhen(int row)
{
  return row >= 0 && row < GetNumberOfBindings() ? bindpose::handle_bindings[row].context : "";
}

std::string vtkHandleSetWidget::GetBindingInput(int row)
{
  return row >= 0 && row < GetNumberOfBindings() ? bindpose::handle_bindings[row].input : "";
}

std::string vtkHandleSetWidget::GetBindingText(int row)
{
  return row >= 0 && row < GetNumberOfBindings() ? bindpose::handle_bindings[row].text : "";
}

// ---- Drags -------------------------------------------------------------------------------------

void vtkHandleSetWidget::BeginDragging()
{
  this->State = DRAGGING;
  this->Moved = false;
  this->Canceled = false;
  this->GrabFocus(this->EventCallbackCommand, this->EventCallbackCommand);
  this->Superclass::StartInteraction();
  this->InvokeEvent(vtkCommand::StartInteractionEvent, nullptr);
}

void vtkHandleSetWidget::FinishDragging(bool canceled)
{
  this->State = HOVERING;
  this->Canceled = canceled;
  this->ReleaseFocus();
  this->Superclass::EndInteraction();
  if (this->IsEditing())
  {
    this->InvokeEditEvents();
  }
  else if (canceled)
  {
    this->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  }
  this->InvokeEvent(vtkCommand::EndInteractionEvent, nullptr);
  this->Render();
}

void vtkHandleSetWidget::InvokeEditEvents()
{
  vtkHandleSetRepresentation* representation = this->GetHandleSetRepresentation();
  std::string message = representation->GetEditMessage();
  if (!message.empty())
  {
    this->InvokeEvent(vtkCommand::WarningEvent, &message[0]);
  }
  const bool moves_rest = this->GetEditMode() == vtkHandleSetRepresentation::MOVE_REST;
  if (representation->GetEdited() && !moves_rest)
  {
    this->InvokeEvent(vtkCommand::PlacePointEvent, nullptr);
    this->InvokeEvent(vtkCommand::SelectionChangedEvent, nullptr);
  }
  if (representation->GetEdited() || moves_rest)
  {
    this->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  }
}

bool vtkHandleSetWidget::StartDrag(int gizmo)
{
  if (this->State == DRAGGING || !this->Enabled || !this->Interactor)
  {
    return false;
  }
  double position[2] = { static_cast<double>(this->Interactor->GetEventPosition()[0]),
    static_cast<double>(this->Interactor->GetEventPosition()[1]) };
  if (!this->GetHandleSetRepresentation()->StartDrag(gizmo, position))
  {
    return false;
  }
  this->StartedByKey = true;
  this->BeginDragging();
  this->Render();
  return true;
}

void vtkHandleSetWidget::EndDrag()
{
  if (this->State == DRAGGING)
  {
    double position[2] = { static_cast<double>(this->Interactor->GetEventPosition()[0]),
      static_cast<double>(this->Interactor->GetEventPosition()[1]) };
    vtkHandleSetRepresentation* representation = this->GetHandleSetRepresentation();
    representation->EndWidgetInteraction(position);
    this->FinishDragging(this->IsEditing() && !representation->GetEdited());
  }
}

void vtkHandleSetWidget::CancelDrag()
{
  if (this->State == DRAGGING)
  {
    this->GetHandleSetRepresentation()->CancelWidgetInteraction();
    this->FinishDragging(true);
  }
}

void vtkHandleSetWidget::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "State: " << (this->State == DRAGGING ? "dragging" : "hovering") << "\n";
  os << indent << "StartKeys: " << this->StartKeys << "\n";
  os << indent << "Canceled: " << (this->Canceled ? "yes" : "no") << "\n";
}
