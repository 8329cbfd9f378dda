// This file connects the handle dataset (handle_data, handle_poses), the mouse (handle_picking,
// gizmo, pose_drag; rest_editor in edit modes) and the drawing in handle_set_drawing.cxx.
//
// A drag stores the poses from its start. Every move of the mouse computes one motion D since the
// start, and writes D * start for the grabbed handle and its descendants. Therefore no error
// accumulates, and a cancel restores the stored poses.
#include "vtkHandleSetRepresentation.h"

#include "handle_picking.h"
#include "handle_set_state.h"
#include "screen_view.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

using bindpose::HandleRecord;
using bindpose::HandleSetState;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
/// Round a length down to a round number: a power of ten times 1, 2 or 5.
double round_length(double length)
{
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return 0.1;
  }
  const double power = std::pow(10.0, std::floor(std::log10(length) + 1e-9));
  const double digits = length / power * (1.0 + 1e-9);
  return power * (digits >= 5.0 ? 5.0 : digits >= 2.0 ? 2.0 : 1.0);
}
} // namespace

vtkStandardNewMacro(vtkHandleSetRepresentation);

vtkHandleSetRepresentation::vtkHandleSetRepresentation() : Internal(new HandleSetState)
{
  this->InteractionState = OUTSIDE;
  vtkMath::UninitializeBounds(this->Bounds);
  HandleSetState& self = *this->Internal;
  self.Gizmo.SetFlat();
  vtkTextProperty* text = self.Labels.text();
  text->SetFontFamilyToArial();
  text->SetFontSize(13);
  text->SetColor(0.13, 0.13, 0.15);
  text->SetBackgroundColor(1.0, 1.0, 1.0);
  text->SetBackgroundOpacity(0.8);
  text->SetVerticalJustificationToCentered();
}

vtkHandleSetRepresentation::~vtkHandleSetRepresentation() = default;

void vtkHandleSetRepresentation::SetHandles(vtkPolyData* handles)
{
  if (this->Internal->Data.get() == handles)
  {
    return;
  }
  // Cancel before the handles are replaced, because canceling writes to the old handles.
  this->Internal->Editor.cancel();
  this->Internal->Editor.finish_cage();
  this->Internal->Data.set(handles);
  this->HoveredHandle = -1;
  this->ActiveHandle = -1;
  this->InteractionState = OUTSIDE;
  this->Internal->SelectedHandles.clear();
  this->Internal->HoveredPart = bindpose::no_part;
  this->Internal->CurrentDrag.reset();
  this->Modified();
}

vtkPolyData* vtkHandleSetRepresentation::GetHandles()
{
  return this->Internal->Data.get();
}

vtkTextProperty* vtkHandleSetRepresentation::GetLabelTextProperty()
{
  return this->Internal->Labels.text();
}

void vtkHandleSetRepresentation::SetHoveredHandle(vtkIdType handle)
{
  if (this->HoveredHandle != handle)
  {
    this->HoveredHandle = handle;
    this->Modified();
  }
}

// ---- Selection ---------------------------------------------------------------------------------

void vtkHandleSetRepresentation::SetSelectedHandle(vtkIdType handle)
{
  const std::vector<vtkIdType> selected =
    handle < 0 ? std::vector<vtkIdType>() : std::vector<vtkIdType>{ handle };
  if (this->Internal->SelectedHandles != selected)
  {
    this->Internal->SelectedHandles = selected;
    this->Modified();
  }
}

vtkIdType vtkHandleSetRepresentation::GetSelectedHandle()
{
  return this->Internal->SelectedHandles.empty() ? -1 : this->Internal->SelectedHandles.back();
}

void vtkHandleSetRepresentation::ToggleSelected(vtkIdType handle)
{
  std::vector<vtkIdType>& selected = this->Internal->SelectedHandles;
  const auto found = std::find(selected.begin(), selected.end(), handle);
  if (found != selected.end())
  {
    selected.erase(found);
  }
  else if (this->Internal->Data.exists(handle))
  {
    selected.push_back(handle);
  }
  this->Modified();
}

bool vtkHandleSetRepresentation::IsSelected(vtkIdType handle)
{
  const std::vector<vtkIdType>& selected = this->Internal->SelectedHandles;
  return std::find(selected.begin(), selected.end(), handle) != selected.end();
}

int vtkHandleSetRepresentation::GetNumberOfSelectedHandles()
{
  return static_cast<int>(this->Internal->SelectedHandles.size());
}

vtkIdType vtkHandleSetRepresentation::GetSelectedHandle(int number)
{
  const std::vector<vtkIdType>& selected = this->Internal->SelectedHandles;
  return number >= 0 && number < static_cast<int>(selected.size())
    ? selected[static_cast<std::size_t>(number)]
    : -1;
}

void vtkHandleSetRepresentation::SelectInRectangle(const double corner[2], const double opposite[2])
{
  std::vector<vtkIdType> selected;
  if (this->Renderer)
  {
    const bindpose::ScreenView view(this->Renderer);
    Eigen::AlignedBox2d box;
    box.extend(Vector2d(corner)).extend(Vector2d(opposite));
    const std::vector<HandleRecord> records = this->Internal->Data.records();
    for (std::size_t i = 0; i < records.size(); ++i)
    {
      const Vector3d middle = 0.5 * (records[i].head + records[i].tail);
      if (records[i].is_handle() && view.pixel_length_at(middle) > 0.0 &&
        box.contains(Vector2d(view.to_display(middle).head<2>())))
      {
        selected.push_back(static_cast<vtkIdType>(i));
      }
    }
  }
  this->Internal->SelectedHandles = selected;
  this->Modified();
}

// ---- Handles in numbers ------------------------------------------------------------------------

std::string vtkHandleSetRepresentation::GetHandleName(vtkIdType handle)
{
  return this->Internal->Data.name(handle);
}

int vtkHandleSetRepresentation::GetHandleMode(vtkIdType handle)
{
  return this->Internal->Data.record(handle).mode;
}

bool vtkHandleSetRepresentation::IsBone(vtkIdType handle)
{
  return this->Internal->Data.record(handle).is_bone();
}

void vtkHandleSetRepresentation::GetPosedHead(vtkIdType handle, double head[3])
{
  std::copy_n(this->Internal->Data.record(handle).head.data(), 3, head);
}

void vtkHandleSetRepresentation::GetPosedTail(vtkIdType handle, double tail[3])
{
  std::copy_n(this->Internal->Data.record(handle).tail.data(), 3, tail);
}

int vtkHandleSetRepresentation::GetDragRefusal(vtkIdType handle)
{
  const HandleRecord record = this->Internal->Data.record(handle);
  if (!this->Internal->Data.exists(handle) || !record.is_handle())
  {
    return IS_NO_HANDLE;
  }
  // In edit modes a handle is shown at its rest position, whatever its pose.
  const bool poses = this->EditMode == POSE;
  const bool free = record.is_free() && poses && !this->DragFree;
  return record.locked        ? IS_LOCKED
    : poses && this->ShowRest ? IS_AT_REST
    : free                    ? IS_FREE
                              : DRAGGABLE;
}

// ---- Picking -----------------------------------------------------------------------------------

bindpose::GizmoSetup vtkHandleSetRepresentation::MakeGizmo(const HandleRecord& record)
{
  bindpose::GizmoSetup setup;
  setup.kind = static_cast<bindpose::GizmoKind>(this->Gizmo);
  setup.origin = record.head;
  setup.only_moves = record.only_moves();
  setup.two_twist_rings = this->StretchableBones != 0;
  setup.pixels = this->PixelScale * this->GizmoSize;
  if (this->Space == LOCAL)
  {
    setup.frame = bindpose::posed_axes(record);
  }
  if (record.is_bone())
  {
    setup.tail = record.tail;
  }
  return setup;
}

int vtkHandleSetRepresentation::ComputeInteractionState(int x, int y, int vtkNotUsed(modify))
{
  HandleSetState& self = *this->Internal;
  bindpose::HandlePick pick;
  int part = bindpose::no_part;
  const double position[2] = { static_cast<double>(x), static_cast<double>(y) };
  if (this->Renderer && this->EditMode > MOVE_REST)
  {
    self.Editor.hover(bindpose::ScreenView(this->Renderer), this->MakeMouseState(position),
      this->MakeEditSettings());
    const bool has_target = self.Editor.preview().ball.has_value();
    this->InteractionState = has_target ? PLACING : OUTSIDE;
    this->SetHoveredHandle(self.Editor.target());
    this->Modified();
    return this->InteractionState;
  }
  if (this->Renderer)
  {
    const bindpose::ScreenView view(this->Renderer);
    const Vector2d mouse(x, y);
    const vtkIdType selected = this->GetSelectedHandle();
    const double tolerance = this->PixelScale * this->PickTolerance;
    if (this->EditMode == POSE && this->Gizmo != GIZMO_NONE &&
      this->GetDragRefusal(selected) == DRAGGABLE)
    {
      part =
        bindpose::Gizmo(view, this->MakeGizmo(self.Data.record(selected))).pick(mouse, tolerance);
    }
    if (part != bindpose::no_part)
    {
      pick.handle = selected;
    }
    else
    {
      bindpose::HandleSizes sizes;
      sizes.ball = this->PixelScale * this->PointSize;
      sizes.bone_width = this->BoneWidth;
      sizes.tolerance = tolerance;
      pick = bindpose::pick_handle(view, self.Data.records(this->DrawsRest()), mouse, sizes);
    }
  }
  this->InteractionState = part != bindpose::no_part ? part : static_cast<int>(pick.part);
  if (self.HoveredPart != part)
  {
    self.HoveredPart = part;
    this->Modified();
  }
  this->SetHoveredHandle(pick.handle);
  return this->InteractionState;
}

void vtkHandleSetRepresentation::LeaveHandles()
{
  if (this->Internal->Editor.preview().ball)
  {
    this->Internal->Editor.clear_preview();
    this->Modified();
  }
  this->InteractionState = OUTSIDE;
  if (this->Internal->HoveredPart != bindpose::no_part)
  {
    this->Internal->HoveredPart = bindpose::no_part;
    this->Modified();
  }
  this->SetHoveredHandle(-1);
}

bool vtkHandleSetRepresentation::GetGizmoGrip(int part, double display[2])
{
  const HandleRecord record = this->Internal->Data.record(this->GetSelectedHandle());
  if (!this->Renderer || this->EditMode != POSE ||
    this->GetDragRefusal(this->GetSelectedHandle()) != DRAGGABLE)
  {
    return false;
  }
  const auto grip =
    bindpose::Gizmo(bindpose::ScreenView(this->Renderer), this->MakeGizmo(record)).grip(part);
  std::copy_n(grip ? grip->data() : Vector2d::Zero().eval().data(), 2, display);
  return grip.has_value();
}

// ---- Dragging ----------------------------------------------------------------------------------

double vtkHandleSetRepresentation::GetSnapLength()
{
  if (this->LengthStep > 0.0)
  {
    return this->LengthStep;
  }
  double bounds[6];
  vtkMath::UninitializeBounds(bounds);
  if (this->Renderer)
  {
    this->Renderer->ComputeVisiblePropBounds(bounds);
  }
  if (!vtkMath::AreBoundsInitialized(bounds))
  {
    std::copy_n(this->GetBounds(), 6, bounds);
  }
  const Vector3d size(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  return round_length(size.norm() / 50.0);
}

bindpose::DragSettings vtkHandleSetRepresentation::MakeSettings()
{
  bindpose::DragSettings settings;
  settings.local_space = this->Space == LOCAL;
  settings.with_descendants = this->MoveDescendants != 0;
  settings.writes_bone_arrays = this->StretchableBones != 0;
  settings.reach = this->Reach != 0;
  settings.ring_pixels = this->PixelScale * this->GizmoSize;
  settings.length_step = this->GetSnapLength();
  settings.degree_step = this->DegreeStep;
  settings.factor_step = this->FactorStep;
  return settings;
}

void vtkHandleSetRepresentation::BeginDrag(int part, const double eventPos[2])
{
  HandleSetState& self = *this->Internal;
  std::vector<vtkIdType> grabbed{ this->ActiveHandle };
  if (this->IsSelected(this->ActiveHandle))
  {
    for (const vtkIdType handle : self.SelectedHandles)
    {
      if (handle != this->ActiveHandle && this->GetDragRefusal(handle) == DRAGGABLE)
      {
        grabbed.push_back(handle);
      }
    }
  }
  self.CurrentDrag.emplace(bindpose::ScreenView(this->Renderer), self.Data.records(), part, grabbed,
    Vector2d(eventPos), this->MakeSettings());
  self.LastDragName = self.CurrentDrag->name();
  self.LastDragText.clear();
  this->Modified();
}

void vtkHandleSetRepresentation::StartWidgetInteraction(double eventPos[2])
{
  this->ActiveHandle = -1;
  this->Internal->CurrentDrag.reset();
  this->Edited = false;
  this->Internal->Message.clear();
  if (this->Renderer && this->EditMode != POSE)
  {
    const vtkIdType hovered = this->HoveredHandle;
    const bool began = this->Internal->Editor.press(bindpose::ScreenView(this->Renderer),
      this->MakeMouseState(eventPos), this->MakeEditSettings(), this->Internal->SelectedHandles);
    this->ActiveHandle = began && this->EditMode == MOVE_REST ? hovered : -1;
    this->ApplyEditResult();
    return;
  }
  if (this->Renderer && this->InteractionState != OUTSIDE &&
    this->GetDragRefusal(this->HoveredHandle) == DRAGGABLE)
  {
    this->ActiveHandle = this->HoveredHandle;
    this->BeginDrag(this->InteractionState, eventPos);
  }
}

bool vtkHandleSetRepresentation::StartDrag(int gizmo, double eventPos[2])
{
  HandleSetState& self = *this->Internal;
  const vtkIdType handle = this->GetSelectedHandle();
  const bool is_move = gizmo == GIZMO_MOVE;
  if (this->ActiveHandle >= 0 || !this->Renderer || this->EditMode != POSE ||
    this->GetDragRefusal(handle) != DRAGGABLE ||
    (!is_move &&
      (self.Data.record(handle).only_moves() || (gizmo != GIZMO_TURN && gizmo != GIZMO_SCALE))))
  {
    return false;
  }
  this->ActiveHandle = handle;
  const int point = static_cast<int>(bindpose::HandlePart::point);
  this->BeginDrag(is_move   ? point
      : gizmo == GIZMO_TURN ? static_cast<int>(bindpose::turn_view)
                            : static_cast<int>(bindpose::scale_all),
    eventPos);
  return true;
}

void vtkHandleSetRepresentation::UpdateDrag()
{
  HandleSetState& self = *this->Internal;
  if (self.CurrentDrag)
  {
    self.CurrentDrag->drag().set_snapping(this->Snap != 0);
    self.Data.set_poses(self.CurrentDrag->group().cells, self.CurrentDrag->poses());
    self.LastDragName = self.CurrentDrag->name();
    self.LastDragText = self.CurrentDrag->text();
    this->Modified();
  }
}

void vtkHandleSetRepresentation::WidgetInteraction(double eventPos[2])
{
  if (this->Internal->Editor.is_busy() && this->Renderer)
  {
    this->Internal->Editor.move(bindpose::ScreenView(this->Renderer),
      this->MakeMouseState(eventPos), this->MakeEditSettings());
    this->Modified();
    return;
  }
  if (this->Internal->CurrentDrag)
  {
    this->Internal->CurrentDrag->drag().move_to(Vector2d(eventPos), this->Fine != 0);
    this->UpdateDrag();
  }
}

void vtkHandleSetRepresentation::ConstrainDrag(int axis, bool plane)
{
  if (this->Internal->Editor.is_busy() && axis >= 0 && axis < 3)
  {
    this->Internal->Editor.constrain(plane ? 7 ^ (1 << axis) : 1 << axis);
  }
  if (this->Internal->CurrentDrag && axis >= 0 && axis < 3)
  {
    this->Internal->CurrentDrag->press_axis(axis, plane);
    this->UpdateDrag();
  }
}

bool vtkHandleSetRepresentation::TypeIntoDrag(char key)
{
  if (!this->Internal->CurrentDrag || !this->Internal->CurrentDrag->type(key))
  {
    return false;
  }
  this->UpdateDrag();
  return true;
}

void vtkHandleSetRepresentation::EndWidgetInteraction(double eventPos[2])
{
  if (this->Internal->Editor.is_busy() && this->Renderer)
  {
    this->Internal->Editor.release(bindpose::ScreenView(this->Renderer),
      this->MakeMouseState(eventPos), this->MakeEditSettings());
    this->ApplyEditResult();
  }
  this->ActiveHandle = -1;
  this->Internal->CurrentDrag.reset();
  this->Modified();
}

void vtkHandleSetRepresentation::CancelWidgetInteraction()
{
  if (this->Internal->Editor.is_busy())
  {
    this->Internal->Editor.cancel();
    this->Internal->Editor.take_result();
    this->Edited = false;
    this->ActiveHandle = -1;
    this->Modified();
  }
  if (this->Internal->CurrentDrag)
  {
    const bindpose::HandleGroup& group = this->Internal->CurrentDrag->group();
    this->Internal->Data.set_poses(group.cells, group.start);
    this->Internal->CurrentDrag.reset();
    this->ActiveHandle = -1;
    this->Modified();
  }
}

// ---- Edit modes --------------------------------------------------------------------------------

bool vtkHandleSetRepresentation::IsInteracting()
{
  return this->Internal->CurrentDrag.has_value() || this->Internal->Editor.is_busy();
}

void vtkHandleSetRepresentation::SetEditMode(int mode)
{
  const int clamped = std::clamp<int>(mode, POSE, ADD_CAGE);
  if (clamped != this->EditMode)
  {
    this->CancelWidgetInteraction();
    this->FinishCage();
    this->LeaveHandles();
    this->EditMode = clamped;
    this->Modified();
  }
}

void vtkHandleSetRepresentation::SetShowRest(vtkTypeBool show)
{
  if (show != this->ShowRest)
  {
    this->CancelWidgetInteraction();
    this->LeaveHandles();
    this->ShowRest = show;
    this->Modified();
  }
}

void vtkHandleSetRepresentation::SetSurface(vtkPolyData* surface)
{
  if (surface != this->GetSurface())
  {
    this->Internal->Editor.surface().set(surface);
    this->Modified();
  }
}

vtkPolyData* vtkHandleSetRepresentation::GetSurface()
{
  return this->Internal->Editor.surface().get();
}

bindpose::EditSettings vtkHandleSetRepresentation::MakeEditSettings()
{
  bindpose::EditSettings settings;
  settings.mode = static_cast<bindpose::EditMode>(this->EditMode);
  settings.place_inside = this->PlaceInside != 0;
  settings.length_step = this->GetSnapLength();
  settings.sizes.ball = this->PixelScale * this->PointSize;
  settings.sizes.bone_width = this->BoneWidth;
  settings.sizes.tolerance = this->PixelScale * this->PickTolerance;
  settings.focus = Vector3d(this->Renderer->GetActiveCamera()->GetFocalPoint());
  return settings;
}

bindpose::MouseState vtkHandleSetRepresentation::MakeMouseState(const double eventPos[2])
{
  return { Vector2d(eventPos), this->Fine != 0, this->Snap != 0 };
}

/// Read the result of a finished edit, which may have renumbered cells.
void vtkHandleSetRepresentation::ApplyEditResult()
{
  HandleSetState& self = *this->Internal;
  self.LastDragName = self.Editor.name();
  self.LastDragText.clear();
  if (self.Editor.is_busy())
  {
    return;
  }
  const bindpose::EditResult result = self.Editor.take_result();
  this->Edited = result.changed;
  self.Message = result.message;
  if (result.changed)
  {
    std::vector<vtkIdType> selected;
    for (const vtkIdType handle : self.SelectedHandles)
    {
      const auto cell = static_cast<std::size_t>(handle);
      if (cell < result.cell_of.size() && result.cell_of[cell] >= 0)
      {
        selected.push_back(result.cell_of[cell]);
      }
    }
    // A new handle becomes the only selected handle.
    self.SelectedHandles =
      result.added.empty() ? selected : std::vector<vtkIdType>{ result.added.back() };
    this->SetHoveredHandle(-1);
  }
  this->Modified();
}

bool vtkHandleSetRepresentation::IsMakingCage()
{
  return this->Internal->Editor.has_cage();
}

bool vtkHandleSetRepresentation::FinishCage()
{
  const bool any = this->Internal->Editor.finish_cage();
  this->Modified();
  return any;
}

bool vtkHandleSetRepresentation::DropCageVertex()
{
  this->Edited = false;
  this->Internal->Message.clear();
  if (!this->Internal->Editor.drop_cage_vertex())
  {
    return false;
  }
  this->ApplyEditResult();
  return true;
}

std::string vtkHandleSetRepresentation::GetEditMessage()
{
  return this->Internal->Message;
}

std::string vtkHandleSetRepresentation::GetInteractionName()
{
  return this->Internal->LastDragName;
}

std::string vtkHandleSetRepresentation::GetInteractionText()
{
  return this->Internal->LastDragText;
}

void vtkHandleSetRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Handles: " << this->Internal->Data.get() << "\n";
  os << indent << "EditMode: " << this->EditMode << "\n";
  os << indent << "ShowRest: " << this->ShowRest << "\n";
  os << indent << "Surface: " << this->GetSurface() << "\n";
  os << indent << "PlaceInside: " << this->PlaceInside << "\n";
  os << indent << "Edited: " << this->Edited << "\n";
  os << indent << "Gizmo: " << this->Gizmo << "\n";
  os << indent << "Space: " << (this->Space == LOCAL ? "local" : "world") << "\n";
  os << indent << "GizmoSize: " << this->GizmoSize << "\n";
  os << indent << "StretchableBones: " << this->StretchableBones << "\n";
  os << indent << "LengthStep: " << this->LengthStep << "\n";
  os << indent << "DegreeStep: " << this->DegreeStep << "\n";
  os << indent << "FactorStep: " << this->FactorStep << "\n";
  os << indent << "Fine: " << this->Fine << "\n";
  os << indent << "Snap: " << this->Snap << "\n";
  os << indent << "Reach: " << this->Reach << "\n";
  os << indent << "PointSize: " << this->PointSize << "\n";
  os << indent << "BoneWidth: " << this->BoneWidth << "\n";
  os << indent << "PickTolerance: " << this->PickTolerance << "\n";
  os << indent << "PixelScale: " << this->PixelScale << "\n";
  os << indent << "ShowLabels: " << this->ShowLabels << "\n";
  os << indent << "ShowHoverName: " << this->ShowHoverName << "\n";
  os << indent << "DrawOnTop: " << this->DrawOnTop << "\n";
  os << indent << "MoveDescendants: " << this->MoveDescendants << "\n";
  os << indent << "DragFree: " << this->DragFree << "\n";
  os << indent << "FindsRotations: " << this->FindsRotations << "\n";
  const auto print_color = [&](const char* name, const double c[3])
  { os << indent << name << ": (" << c[0] << ", " << c[1] << ", " << c[2] << ")\n"; };
  print_color("FullColor", this->FullColor);
  print_color("PositionColor", this->PositionColor);
  print_color("FreeColor", this->FreeColor);
  print_color("OutlineColor", this->OutlineColor);
  print_color("SelectedColor", this->SelectedColor);
  os << indent << "HoveredHandle: " << this->HoveredHandle << "\n";
  os << indent << "SelectedHandle: " << this->GetSelectedHandle() << "\n";
  os << indent << "ActiveHandle: " << this->ActiveHandle << "\n";
}
