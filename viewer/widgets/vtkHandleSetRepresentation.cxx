// The glue between the handle dataset (handle_data), the mouse (handle_picking, handle_drag) and
// the picture (handle_drawing, screen_labels).
//
// What is drawn is rebuilt whenever the handles, the camera or the window change. All solid parts
// make one polydata, all outlines another.
//
// Handles lie inside the shape they bend. To be seen they are drawn in the overlay pass after the
// depth buffer has been cleared, so they hide each other correctly and nothing hides them; the same
// once more for the gizmo.
//
// A drag keeps the poses from its start. Every move makes one motion D from the start to now and
// writes D * start for the grabbed handle and its descendants: no error accumulates, and a cancel
// copies the start back.
#include "vtkHandleSetRepresentation.h"

#include "gizmo.h"
#include "handle_data.h"
#include "handle_drawing.h"
#include "handle_picking.h"
#include "handle_poses.h"
#include "pose_drag.h"
#include "screen_labels.h"
#include "screen_view.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"
#include "vtkWindow.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

using bindpose::Affine;
using bindpose::HandlePlace;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
constexpr unsigned int gl_depth_test = 0x0B71;
constexpr unsigned int gl_depth_buffer_bit = 0x00000100;

bindpose::Colour to_colour(const double rgb[3])
{
  return { rgb[0], rgb[1], rgb[2] };
}

/// Shapes and their hull, as two actors.
class ShapeActors
{
public:
  ShapeActors()
  {
    const std::pair<vtkActor*, vtkPolyDataMapper*> both[2] = {
      { this->Outline, this->OutlineMapper }, { this->Solid, this->SolidMapper }
    };
    for (const auto& [actor, mapper] : both)
    {
      mapper->SetScalarModeToUsePointData();
      mapper->SetColorModeToDirectScalars();
      actor->SetMapper(mapper);
    }
    vtkProperty* solid = this->Solid->GetProperty();
    solid->SetAmbient(0.25);
    solid->SetDiffuse(0.75);
    solid->SetSpecular(0.25);
    solid->SetSpecularPower(30.0);
    solid->BackfaceCullingOn();
    this->Outline->GetProperty()->LightingOff();
    this->Outline->GetProperty()->FrontfaceCullingOn();
  }
  /// Colours as they are, not as lights make them.
  void SetFlat()
  {
    this->Solid->GetProperty()->SetAmbient(0.75);
    this->Solid->GetProperty()->SetDiffuse(0.3);
    this->Solid->GetProperty()->SetSpecular(0.0);
  }
  void Set(const bindpose::HandleShapes& solid, const bindpose::HandleShapes& outline)
  {
    this->SolidMapper->SetInputData(solid.polydata());
    this->OutlineMapper->SetInputData(outline.polydata());
  }
  int Render(vtkViewport* viewport)
  {
    return this->Outline->RenderOpaqueGeometry(viewport) +
      this->Solid->RenderOpaqueGeometry(viewport);
  }
  void Release(vtkWindow* window)
  {
    this->Outline->ReleaseGraphicsResources(window);
    this->Solid->ReleaseGraphicsResources(window);
  }

private:
  vtkNew<vtkPolyDataMapper> OutlineMapper;
  vtkNew<vtkPolyDataMapper> SolidMapper;
  vtkNew<vtkActor> Outline;
  vtkNew<vtkActor> Solid;
};

/// 1, 2 or 5 times a power of ten: the largest that is not above the length.
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

class vtkHandleSetRepresentation::Internals
{
public:
  bindpose::HandleData Data;
  ShapeActors Handles;
  ShapeActors Gizmo;
  bindpose::ScreenLabels Labels;
  std::vector<vtkIdType> Selected;
  int HoveredPart = bindpose::no_part; // of the gizmo

  std::optional<bindpose::PoseDrag> Dragged;
  std::string LastName; // of the last drag
  std::string LastText;
};

vtkStandardNewMacro(vtkHandleSetRepresentation);

vtkHandleSetRepresentation::vtkHandleSetRepresentation() : Internal(new Internals)
{
  this->InteractionState = OUTSIDE;
  vtkMath::UninitializeBounds(this->Bounds);
  Internals& self = *this->Internal;
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
  this->Internal->Data.set(handles);
  this->HoveredHandle = -1;
  this->ActiveHandle = -1;
  this->InteractionState = OUTSIDE;
  this->Internal->Selected.clear();
  this->Internal->HoveredPart = bindpose::no_part;
  this->Internal->Dragged.reset();
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
  if (this->Internal->Selected != selected)
  {
    this->Internal->Selected = selected;
    this->Modified();
  }
}

vtkIdType vtkHandleSetRepresentation::GetSelectedHandle()
{
  return this->Internal->Selected.empty() ? -1 : this->Internal->Selected.back();
}

void vtkHandleSetRepresentation::ToggleSelected(vtkIdType handle)
{
  std::vector<vtkIdType>& selected = this->Internal->Selected;
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
  const std::vector<vtkIdType>& selected = this->Internal->Selected;
  return std::find(selected.begin(), selected.end(), handle) != selected.end();
}

int vtkHandleSetRepresentation::GetNumberOfSelectedHandles()
{
  return static_cast<int>(this->Internal->Selected.size());
}

vtkIdType vtkHandleSetRepresentation::GetSelectedHandle(int number)
{
  const std::vector<vtkIdType>& selected = this->Internal->Selected;
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
    const std::vector<HandlePlace> places = this->Internal->Data.places();
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const Vector3d middle = 0.5 * (places[i].head + places[i].tail);
      if (places[i].is_handle() && view.pixel_at(middle) > 0.0 &&
        box.contains(Vector2d(view.to_display(middle).head<2>())))
      {
        selected.push_back(static_cast<vtkIdType>(i));
      }
    }
  }
  this->Internal->Selected = selected;
  this->Modified();
}

// ---- Handles in numbers ------------------------------------------------------------------------

std::string vtkHandleSetRepresentation::GetHandleName(vtkIdType handle)
{
  return this->Internal->Data.name(handle);
}

int vtkHandleSetRepresentation::GetHandleMode(vtkIdType handle)
{
  return this->Internal->Data.place(handle).mode;
}

bool vtkHandleSetRepresentation::IsBone(vtkIdType handle)
{
  return this->Internal->Data.place(handle).is_bone();
}

void vtkHandleSetRepresentation::GetPosedHead(vtkIdType handle, double head[3])
{
  std::copy_n(this->Internal->Data.place(handle).head.data(), 3, head);
}

void vtkHandleSetRepresentation::GetPosedTail(vtkIdType handle, double tail[3])
{
  std::copy_n(this->Internal->Data.place(handle).tail.data(), 3, tail);
}

int vtkHandleSetRepresentation::GetDragRefusal(vtkIdType handle)
{
  const HandlePlace place = this->Internal->Data.place(handle);
  if (!this->Internal->Data.exists(handle) || !place.is_handle())
  {
    return IS_NO_HANDLE;
  }
  return place.locked ? IS_LOCKED : place.is_free() ? IS_FREE : DRAGGABLE;
}

bool vtkHandleSetRepresentation::WriteHandle(vtkIdType handle, const HandlePlace& posed)
{
  const std::vector<HandlePlace> places = this->Internal->Data.places();
  if (!this->Internal->Data.exists(handle) || this->GetDragRefusal(handle) == IS_LOCKED ||
    !places[static_cast<std::size_t>(handle)].is_handle() || !posed.transform.allFinite())
  {
    return false;
  }
  const HandlePlace& before = places[static_cast<std::size_t>(handle)];
  const bindpose::HandleGroup group =
    bindpose::make_group(places, { handle }, this->MoveDescendants != 0);
  // The motion from the one to the other is what the followers do; the handle itself takes the
  // numbers as they are.
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  const Eigen::Matrix3d inverse = before.transform.leftCols<3>().inverse();
  if (posed.transform != before.transform && inverse.allFinite())
  {
    motion.linear() = posed.transform.leftCols<3>() * inverse;
    motion.translation() = posed.transform.col(3) - motion.linear() * before.transform.col(3);
  }
  const double factor = before.stretch != 0.0 ? posed.stretch / before.stretch : 1.0;
  std::vector<bindpose::HandleData::CellPose> poses = bindpose::moved_poses(
    places, group, motion, { factor, Vector2d(0.0, posed.twist[1] - before.twist[1]), true });
  poses.front() = { posed.transform, posed.stretch, posed.twist };
  this->Internal->Data.set_poses(group.cells, poses);
  this->Modified();
  return true;
}

bool vtkHandleSetRepresentation::SetHandleTranslation(vtkIdType handle, const double translation[3])
{
  HandlePlace place = this->Internal->Data.place(handle);
  const Affine linear = place.transform;
  place.transform.col(3) =
    place.rest_head + Vector3d(translation) - linear.leftCols<3>() * place.rest_head;
  return this->WriteHandle(handle, place);
}

bool vtkHandleSetRepresentation::SetHandleRotation(
  vtkIdType handle, const double axis[3], double degrees)
{
  HandlePlace place = this->Internal->Data.place(handle);
  bindpose::PoseParts parts = bindpose::split_pose(place.transform, place.rest_head);
  const double length = Vector3d(axis).norm();
  if (!(length > 0.0))
  {
    return false;
  }
  parts.rotation = Eigen::AngleAxisd(vtkMath::RadiansFromDegrees(degrees), Vector3d(axis) / length)
                     .toRotationMatrix();
  place.transform = bindpose::join_pose(parts, place.rest_head);
  return this->WriteHandle(handle, place);
}

bool vtkHandleSetRepresentation::SetHandleScale(vtkIdType handle, const double factors[3])
{
  HandlePlace place = this->Internal->Data.place(handle);
  bindpose::PoseParts parts = bindpose::split_pose(place.transform, place.rest_head);
  const Eigen::Matrix3d axes = bindpose::rest_axes(place);
  const Vector3d scale(factors);
  if ((scale.array() == 0.0).any())
  {
    return false;
  }
  parts.scale = axes * scale.asDiagonal() * axes.transpose();
  if (scale[0] == scale[1] && scale[1] == scale[2])
  {
    parts.scale = scale[0] * Eigen::Matrix3d::Identity(); // without round-off
  }
  place.transform = bindpose::join_pose(parts, place.rest_head);
  return this->WriteHandle(handle, place);
}

bool vtkHandleSetRepresentation::SetHandleScale(vtkIdType handle, double factor)
{
  const double factors[3] = { factor, factor, factor };
  return this->SetHandleScale(handle, factors);
}

bool vtkHandleSetRepresentation::SetHandleStretch(vtkIdType handle, double ratio)
{
  HandlePlace place = this->Internal->Data.place(handle);
  place.stretch = ratio;
  return ratio > 0.0 && std::isfinite(ratio) && place.is_bone() && this->WriteHandle(handle, place);
}

bool vtkHandleSetRepresentation::SetHandleTwist(
  vtkIdType handle, double headDegrees, double tailDegrees)
{
  HandlePlace place = this->Internal->Data.place(handle);
  place.twist = Vector2d(headDegrees, tailDegrees);
  return place.twist.allFinite() && place.is_bone() && this->WriteHandle(handle, place);
}

bool vtkHandleSetRepresentation::ResetHandle(vtkIdType handle)
{
  HandlePlace place = this->Internal->Data.place(handle);
  place.transform = bindpose::identity_affine();
  place.stretch = 1.0;
  place.twist.setZero();
  return this->WriteHandle(handle, place);
}

void vtkHandleSetRepresentation::GetHandleTranslation(vtkIdType handle, double translation[3])
{
  const HandlePlace place = this->Internal->Data.place(handle);
  const Vector3d moved = bindpose::split_pose(place.transform, place.rest_head).translation;
  std::copy_n(moved.data(), 3, translation);
}

double vtkHandleSetRepresentation::GetHandleRotation(vtkIdType handle, double axis[3])
{
  const HandlePlace place = this->Internal->Data.place(handle);
  const Eigen::AngleAxisd turned(bindpose::split_pose(place.transform, place.rest_head).rotation);
  std::copy_n(turned.axis().data(), 3, axis);
  return vtkMath::DegreesFromRadians(turned.angle());
}

void vtkHandleSetRepresentation::GetHandleScale(vtkIdType handle, double factors[3])
{
  const HandlePlace place = this->Internal->Data.place(handle);
  const Eigen::Matrix3d axes = bindpose::rest_axes(place);
  const Vector3d scale =
    (axes.transpose() * bindpose::split_pose(place.transform, place.rest_head).scale * axes)
      .diagonal();
  std::copy_n(scale.data(), 3, factors);
}

double vtkHandleSetRepresentation::GetHandleStretch(vtkIdType handle)
{
  return this->Internal->Data.place(handle).stretch;
}

void vtkHandleSetRepresentation::GetHandleTwist(vtkIdType handle, double degrees[2])
{
  std::copy_n(this->Internal->Data.place(handle).twist.data(), 2, degrees);
}

// ---- Picking -----------------------------------------------------------------------------------

bindpose::GizmoSetup vtkHandleSetRepresentation::MakeGizmo(const HandlePlace& place)
{
  bindpose::GizmoSetup setup;
  setup.kind = static_cast<bindpose::GizmoKind>(this->Gizmo);
  setup.origin = place.head;
  setup.only_moves = place.only_moves();
  setup.twists_apart = this->StretchableBones != 0;
  setup.pixels = this->PixelScale * this->GizmoSize;
  if (this->Space == LOCAL)
  {
    setup.frame = bindpose::posed_axes(place);
  }
  if (place.is_bone())
  {
    setup.tail = place.tail;
  }
  return setup;
}

int vtkHandleSetRepresentation::ComputeInteractionState(int x, int y, int vtkNotUsed(modify))
{
  Internals& self = *this->Internal;
  bindpose::HandlePick pick;
  int part = bindpose::no_part;
  if (this->Renderer)
  {
    const bindpose::ScreenView view(this->Renderer);
    const Vector2d mouse(x, y);
    const vtkIdType selected = this->GetSelectedHandle();
    const double tolerance = this->PixelScale * this->PickTolerance;
    if (this->Gizmo != GIZMO_NONE && this->GetDragRefusal(selected) == DRAGGABLE)
    {
      part =
        bindpose::Gizmo(view, this->MakeGizmo(self.Data.place(selected))).pick(mouse, tolerance);
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
      pick = bindpose::pick_handle(view, self.Data.places(), mouse, sizes);
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
  const HandlePlace place = this->Internal->Data.place(this->GetSelectedHandle());
  if (!this->Renderer || this->GetDragRefusal(this->GetSelectedHandle()) != DRAGGABLE)
  {
    return false;
  }
  const auto grip =
    bindpose::Gizmo(bindpose::ScreenView(this->Renderer), this->MakeGizmo(place)).grip(part);
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
  settings.descend = this->MoveDescendants != 0;
  settings.bone_arrays = this->StretchableBones != 0;
  settings.reach = this->Reach != 0;
  settings.ring_pixels = this->PixelScale * this->GizmoSize;
  settings.length_step = this->GetSnapLength();
  settings.degree_step = this->DegreeStep;
  settings.factor_step = this->FactorStep;
  return settings;
}

void vtkHandleSetRepresentation::BeginDrag(int part, const double eventPos[2])
{
  Internals& self = *this->Internal;
  std::vector<vtkIdType> grabbed{ this->ActiveHandle };
  if (this->IsSelected(this->ActiveHandle))
  {
    for (const vtkIdType handle : self.Selected)
    {
      if (handle != this->ActiveHandle && this->GetDragRefusal(handle) == DRAGGABLE)
      {
        grabbed.push_back(handle);
      }
    }
  }
  self.Dragged.emplace(bindpose::ScreenView(this->Renderer), self.Data.places(), part, grabbed,
    Vector2d(eventPos), this->MakeSettings());
  self.LastName = self.Dragged->name();
  self.LastText.clear();
  this->Modified();
}

void vtkHandleSetRepresentation::StartWidgetInteraction(double eventPos[2])
{
  this->ActiveHandle = -1;
  this->Internal->Dragged.reset();
  if (this->Renderer && this->InteractionState != OUTSIDE &&
    this->GetDragRefusal(this->HoveredHandle) == DRAGGABLE)
  {
    this->ActiveHandle = this->HoveredHandle;
    this->BeginDrag(this->InteractionState, eventPos);
  }
}

bool vtkHandleSetRepresentation::StartDrag(int gizmo, double eventPos[2])
{
  Internals& self = *this->Internal;
  const vtkIdType handle = this->GetSelectedHandle();
  const bool moves = gizmo == GIZMO_MOVE;
  if (this->ActiveHandle >= 0 || !this->Renderer || this->GetDragRefusal(handle) != DRAGGABLE ||
    (!moves &&
      (self.Data.place(handle).only_moves() || (gizmo != GIZMO_TURN && gizmo != GIZMO_SCALE))))
  {
    return false;
  }
  this->ActiveHandle = handle;
  const int point = static_cast<int>(bindpose::HandlePart::point);
  this->BeginDrag(moves     ? point
      : gizmo == GIZMO_TURN ? static_cast<int>(bindpose::turn_view)
                            : static_cast<int>(bindpose::scale_all),
    eventPos);
  return true;
}

void vtkHandleSetRepresentation::UpdateDrag()
{
  Internals& self = *this->Internal;
  if (self.Dragged)
  {
    self.Dragged->drag().set_snapping(this->Snap != 0);
    self.Data.set_poses(self.Dragged->group().cells, self.Dragged->poses());
    self.LastName = self.Dragged->name();
    self.LastText = self.Dragged->text();
    this->Modified();
  }
}

void vtkHandleSetRepresentation::WidgetInteraction(double eventPos[2])
{
  if (this->Internal->Dragged)
  {
    this->Internal->Dragged->drag().move_to(Vector2d(eventPos), this->Fine != 0);
    this->UpdateDrag();
  }
}

void vtkHandleSetRepresentation::ConstrainDrag(int axis, bool plane)
{
  if (this->Internal->Dragged && axis >= 0 && axis < 3)
  {
    this->Internal->Dragged->press_axis(axis, plane);
    this->UpdateDrag();
  }
}

bool vtkHandleSetRepresentation::TypeIntoDrag(char key)
{
  if (!this->Internal->Dragged || !this->Internal->Dragged->type(key))
  {
    return false;
  }
  this->UpdateDrag();
  return true;
}

void vtkHandleSetRepresentation::EndWidgetInteraction(double vtkNotUsed(eventPos)[2])
{
  this->ActiveHandle = -1;
  this->Internal->Dragged.reset();
  this->Modified();
}

void vtkHandleSetRepresentation::CancelWidgetInteraction()
{
  if (this->Internal->Dragged)
  {
    const bindpose::HandleGroup& group = this->Internal->Dragged->group();
    this->Internal->Data.set_poses(group.cells, group.start);
    this->Internal->Dragged.reset();
    this->ActiveHandle = -1;
    this->Modified();
  }
}

std::string vtkHandleSetRepresentation::GetInteractionName()
{
  return this->Internal->LastName;
}

std::string vtkHandleSetRepresentation::GetInteractionText()
{
  return this->Internal->LastText;
}

// ---- Drawing -----------------------------------------------------------------------------------

vtkMTimeType vtkHandleSetRepresentation::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  time = std::max(time, this->Internal->Labels.text()->GetMTime());
  if (this->Internal->Data.get())
  {
    time = std::max(time, this->Internal->Data.get()->GetMTime());
  }
  return time;
}

void vtkHandleSetRepresentation::BuildRepresentation()
{
  Internals& self = *this->Internal;
  if (!this->Renderer || !this->Renderer->GetRenderWindow())
  {
    return;
  }
  vtkWindow* window = this->Renderer->GetRenderWindow();
  if (this->BuildTime > this->GetMTime() && this->BuildTime > window->GetMTime() &&
    this->BuildTime > this->Renderer->GetMTime() &&
    this->BuildTime > this->Renderer->GetActiveCamera()->GetMTime())
  {
    return;
  }
  const bindpose::ScreenView view(this->Renderer);
  const std::vector<HandlePlace> places = self.Data.places();
  const bool fine = places.size() <= 60;
  bindpose::HandleShapes solid(fine);
  bindpose::HandleShapes outline(fine);
  bindpose::HandleSizes sizes;
  sizes.ball = this->PixelScale * this->PointSize;
  sizes.bone_width = this->BoneWidth;
  const bindpose::HandleLook look{ { to_colour(this->FullColor), to_colour(this->PositionColor),
                                     to_colour(this->FreeColor) },
    to_colour(this->OutlineColor), to_colour(this->SelectedColor), this->PixelScale };
  const bindpose::HandleMarks marks{ this->HoveredHandle, this->ActiveHandle, self.Selected };
  bindpose::draw_handles(view, places,
    places.empty() ? std::vector<bindpose::HandleData::Bar>() : self.Data.bars(places), sizes, look,
    marks, solid, outline);
  self.Labels.clear();
  for (vtkIdType cell = 0; cell < self.Data.count(); ++cell)
  {
    const bool hot = cell == this->HoveredHandle || cell == this->ActiveHandle;
    const HandlePlace& place = places[static_cast<std::size_t>(cell)];
    const bool dragged = self.Dragged && cell == this->ActiveHandle;
    const bool named = this->ShowHoverName && hot && self.HoveredPart == bindpose::no_part;
    if (place.is_handle() && (this->ShowLabels || named || dragged))
    {
      std::string text = self.Data.name(cell);
      text += place.locked ? " (locked)" : place.is_free() && hot ? " (free)" : "";
      text += dragged && !self.LastText.empty() ? "   " + self.LastText : "";
      Vector2d at = bindpose::label_place(view, place, this->PixelScale * this->PointSize);
      if (dragged && self.Dragged->part() != bindpose::no_part)
      {
        // below the gizmo, where there is room
        const double aside = this->PixelScale * (1.45 * this->GizmoSize + 14.0);
        at = view.to_display(place.head).head<2>();
        at += Vector2d(-0.25 * aside, at[1] > 1.2 * aside ? -aside : aside);
      }
      self.Labels.add(text, at, this->PixelScale);
    }
  }
  self.Handles.Set(solid, outline);

  bindpose::HandleShapes gizmo_solid(true);
  bindpose::HandleShapes gizmo_outline(true);
  const vtkIdType gizmo_handle = self.Dragged ? this->ActiveHandle : this->GetSelectedHandle();
  const bool shows = this->Gizmo != GIZMO_NONE || self.Dragged;
  if (shows && this->GetDragRefusal(gizmo_handle) == DRAGGABLE)
  {
    bindpose::GizmoSetup setup = this->MakeGizmo(places[static_cast<std::size_t>(gizmo_handle)]);
    bindpose::GizmoMarks gizmo_marks;
    gizmo_marks.hovered = self.HoveredPart;
    if (self.Dragged)
    {
      // Whatever starts a drag, what it is held to is drawn.
      gizmo_marks.active = self.Dragged->part();
      setup.kind = bindpose::gizmo_with(gizmo_marks.active, setup.kind);
      setup.frame = self.Dragged->frame();
      const auto spokes = self.Dragged->spokes(
        bindpose::ring_pixels(setup, gizmo_marks.active) * view.pixel_at(setup.origin));
      std::copy(spokes.begin(), spokes.end(), gizmo_marks.spokes);
    }
    if (!self.Dragged || gizmo_marks.active != bindpose::no_part)
    {
      const bindpose::Gizmo gizmo(view, setup, gizmo_marks);
      gizmo.draw(gizmo_solid, gizmo_outline);
      for (const bindpose::Gizmo::Label& label : gizmo.labels())
      {
        self.Labels.add(label.text, label.display, this->PixelScale, label.colour.data());
      }
    }
  }
  self.Gizmo.Set(gizmo_solid, gizmo_outline);
  this->BuildTime.Modified();
}

double* vtkHandleSetRepresentation::GetBounds()
{
  Eigen::AlignedBox3d box;
  for (const HandlePlace& place : this->Internal->Data.places())
  {
    box.extend(place.head).extend(place.tail);
  }
  vtkMath::UninitializeBounds(this->Bounds);
  for (int axis = 0; axis < 3 && !box.isEmpty(); ++axis)
  {
    this->Bounds[2 * axis] = box.min()[axis];
    this->Bounds[2 * axis + 1] = box.max()[axis];
  }
  return this->Bounds;
}

int vtkHandleSetRepresentation::RenderOpaqueGeometry(vtkViewport* viewport)
{
  if (this->DrawOnTop)
  {
    return 0;
  }
  this->BuildRepresentation();
  return this->Internal->Handles.Render(viewport);
}

int vtkHandleSetRepresentation::RenderOverlay(vtkViewport* viewport)
{
  this->BuildRepresentation();
  int rendered = 0;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(viewport->GetVTKWindow());
  const auto on_top = [&](ShapeActors& actors)
  {
    vtkOpenGLState* state = window->GetState();
    state->vtkglEnable(gl_depth_test);
    state->vtkglDepthMask(1);
    state->vtkglClear(gl_depth_buffer_bit);
    rendered += actors.Render(viewport);
  };
  if (window && this->DrawOnTop)
  {
    on_top(this->Internal->Handles);
  }
  if (window)
  {
    on_top(this->Internal->Gizmo);
  }
  return rendered + this->Internal->Labels.render(viewport);
}

void vtkHandleSetRepresentation::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Handles.Release(window);
  this->Internal->Gizmo.Release(window);
  this->Internal->Labels.release(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkHandleSetRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Handles: " << this->Internal->Data.get() << "\n";
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
  const auto print_colour = [&](const char* name, const double c[3])
  { os << indent << name << ": (" << c[0] << ", " << c[1] << ", " << c[2] << ")\n"; };
  print_colour("FullColor", this->FullColor);
  print_colour("PositionColor", this->PositionColor);
  print_colour("FreeColor", this->FreeColor);
  print_colour("OutlineColor", this->OutlineColor);
  print_colour("SelectedColor", this->SelectedColor);
  os << indent << "HoveredHandle: " << this->HoveredHandle << "\n";
  os << indent << "SelectedHandle: " << this->GetSelectedHandle() << "\n";
  os << indent << "ActiveHandle: " << this->ActiveHandle << "\n";
}
