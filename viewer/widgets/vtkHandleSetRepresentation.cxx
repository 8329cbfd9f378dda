// The glue between the handle dataset (handle_data), the mouse (handle_picking, handle_drag) and
// the picture (handle_drawing, screen_labels).
//
// What is drawn is rebuilt whenever the handles, the camera or the window change. All solid parts
// make one polydata, all outlines another.
//
// Handles lie inside the shape they bend. To be seen they are drawn in the overlay pass after the
// depth buffer has been cleared, so they hide each other correctly and nothing hides them.
//
// A drag keeps the poses from its start. Every move makes one motion D from the start to now and
// writes D * start for the grabbed handle and its descendants: no error accumulates, and a cancel
// copies the start back.
#include "vtkHandleSetRepresentation.h"

#include "handle_data.h"
#include "handle_drag.h"
#include "handle_drawing.h"
#include "handle_picking.h"
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
#include <optional>
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

void use_point_colours(vtkActor* actor, vtkPolyDataMapper* mapper)
{
  mapper->SetScalarModeToUsePointData();
  mapper->SetColorModeToDirectScalars();
  actor->SetMapper(mapper);
}
} // namespace

class vtkHandleSetRepresentation::Internals
{
public:
  bindpose::HandleData Data;
  vtkNew<vtkPolyDataMapper> SolidMapper;
  vtkNew<vtkActor> Solid;
  vtkNew<vtkPolyDataMapper> OutlineMapper;
  vtkNew<vtkActor> Outline;
  bindpose::ScreenLabels Labels;

  // the drag that is going on
  std::optional<bindpose::Drag> Dragged;
  std::vector<vtkIdType> Moving;
  std::vector<bindpose::HandleData::CellPose> StartPoses;
};

vtkStandardNewMacro(vtkHandleSetRepresentation);

vtkHandleSetRepresentation::vtkHandleSetRepresentation() : Internal(new Internals)
{
  this->InteractionState = OUTSIDE;
  vtkMath::UninitializeBounds(this->Bounds);
  Internals& self = *this->Internal;
  use_point_colours(self.Solid, self.SolidMapper);
  use_point_colours(self.Outline, self.OutlineMapper);
  self.Solid->GetProperty()->SetAmbient(0.25);
  self.Solid->GetProperty()->SetDiffuse(0.75);
  self.Solid->GetProperty()->SetSpecular(0.25);
  self.Solid->GetProperty()->SetSpecularPower(30.0);
  self.Solid->GetProperty()->BackfaceCullingOn();
  self.Outline->GetProperty()->LightingOff();
  self.Outline->GetProperty()->FrontfaceCullingOn();
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
  this->SelectedHandle = -1;
  this->ActiveHandle = -1;
  this->InteractionState = OUTSIDE;
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

void vtkHandleSetRepresentation::SetSelectedHandle(vtkIdType handle)
{
  if (this->SelectedHandle != handle)
  {
    this->SelectedHandle = handle;
    this->Modified();
  }
}

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

// ---- Picking -----------------------------------------------------------------------------------

int vtkHandleSetRepresentation::ComputeInteractionState(int x, int y, int vtkNotUsed(modify))
{
  bindpose::HandlePick pick;
  if (this->Renderer)
  {
    bindpose::HandleSizes sizes;
    sizes.ball = this->PixelScale * this->PointSize;
    sizes.bone_width = this->BoneWidth;
    sizes.tolerance = this->PixelScale * this->PickTolerance;
    pick = bindpose::pick_handle(
      bindpose::ScreenView(this->Renderer), this->Internal->Data.places(), Vector2d(x, y), sizes);
  }
  this->InteractionState = static_cast<int>(pick.part);
  this->SetHoveredHandle(pick.handle);
  return this->InteractionState;
}

// ---- Dragging ----------------------------------------------------------------------------------

void vtkHandleSetRepresentation::StartWidgetInteraction(double eventPos[2])
{
  Internals& self = *this->Internal;
  this->ActiveHandle = -1;
  self.Dragged.reset();
  if (!this->Renderer || this->InteractionState == OUTSIDE ||
    !self.Data.exists(this->HoveredHandle) || this->GetHandleMode(this->HoveredHandle) == 2)
  {
    return;
  }
  this->ActiveHandle = this->HoveredHandle;
  const std::vector<HandlePlace> places = self.Data.places();
  const HandlePlace& place = places[static_cast<std::size_t>(this->ActiveHandle)];
  bindpose::DragSetup setup;
  setup.pivot = setup.grabbed = place.head;
  if (this->InteractionState == ON_TAIL)
  {
    setup.kind = bindpose::DragKind::aim;
    setup.grabbed = place.tail;
    setup.arm = place.tail - place.head;
  }
  else if (this->InteractionState == ON_BODY)
  {
    setup.grabbed = 0.5 * (place.head + place.tail);
  }
  self.Dragged.emplace(
    bindpose::ScreenView(this->Renderer), setup, Vector2d(eventPos[0], eventPos[1]));

  self.Moving.clear();
  self.StartPoses.clear();
  const vtkIdType count = self.Data.count();
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    // Up the hierarchy; the number of steps is bounded, whatever the file says.
    vtkIdType ancestor = cell;
    for (vtkIdType step = 0; step < count && self.Data.exists(ancestor); ++step)
    {
      if (ancestor == this->ActiveHandle)
      {
        const HandlePlace& moving = places[static_cast<std::size_t>(cell)];
        self.Moving.push_back(cell);
        self.StartPoses.push_back({ moving.transform, moving.stretch, moving.twist });
        break;
      }
      ancestor = this->MoveDescendants ? places[static_cast<std::size_t>(ancestor)].parent : -1;
    }
  }
  this->Modified();
}

void vtkHandleSetRepresentation::WidgetInteraction(double eventPos[2])
{
  Internals& self = *this->Internal;
  if (this->ActiveHandle < 0)
  {
    return;
  }
  self.Dragged->move_to(Vector2d(eventPos[0], eventPos[1]), false);
  const Eigen::Affine3d motion = self.Dragged->motion().motion;
  std::vector<bindpose::HandleData::CellPose> poses = self.StartPoses;
  for (bindpose::HandleData::CellPose& pose : poses)
  {
    pose.transform = motion.linear() * pose.transform;
    pose.transform.col(3) += motion.translation();
  }
  self.Data.set_poses(self.Moving, poses);
}

void vtkHandleSetRepresentation::EndWidgetInteraction(double vtkNotUsed(eventPos)[2])
{
  this->ActiveHandle = -1;
  this->Modified();
}

void vtkHandleSetRepresentation::CancelWidgetInteraction()
{
  if (this->ActiveHandle >= 0)
  {
    this->Internal->Data.set_poses(this->Internal->Moving, this->Internal->StartPoses);
    this->ActiveHandle = -1;
    this->Modified();
  }
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
  const bindpose::HandleMarks marks{ this->HoveredHandle, this->ActiveHandle,
    { this->SelectedHandle } };
  bindpose::draw_handles(view, places,
    places.empty() ? std::vector<bindpose::HandleData::Bar>() : self.Data.bars(places), sizes, look,
    marks, solid, outline);
  self.Labels.clear();
  for (vtkIdType cell = 0; cell < self.Data.count(); ++cell)
  {
    const bool hot = cell == this->HoveredHandle || cell == this->ActiveHandle;
    const HandlePlace& place = places[static_cast<std::size_t>(cell)];
    if (place.is_handle() && (this->ShowLabels || (this->ShowHoverName && hot)))
    {
      self.Labels.add(self.Data.name(cell),
        bindpose::label_place(view, place, this->PixelScale * this->PointSize), this->PixelScale);
    }
  }
  self.SolidMapper->SetInputData(solid.polydata());
  self.OutlineMapper->SetInputData(outline.polydata());
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
  return this->Internal->Outline->RenderOpaqueGeometry(viewport) +
    this->Internal->Solid->RenderOpaqueGeometry(viewport);
}

int vtkHandleSetRepresentation::RenderOverlay(vtkViewport* viewport)
{
  this->BuildRepresentation();
  int rendered = 0;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(viewport->GetVTKWindow());
  if (this->DrawOnTop && window)
  {
    vtkOpenGLState* state = window->GetState();
    state->vtkglEnable(gl_depth_test);
    state->vtkglDepthMask(1);
    state->vtkglClear(gl_depth_buffer_bit);
    rendered += this->Internal->Outline->RenderOpaqueGeometry(viewport);
    rendered += this->Internal->Solid->RenderOpaqueGeometry(viewport);
  }
  return rendered + this->Internal->Labels.render(viewport);
}

void vtkHandleSetRepresentation::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Solid->ReleaseGraphicsResources(window);
  this->Internal->Outline->ReleaseGraphicsResources(window);
  this->Internal->Labels.release(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkHandleSetRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Handles: " << this->Internal->Data.get() << "\n";
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
  os << indent << "SelectedHandle: " << this->SelectedHandle << "\n";
  os << indent << "ActiveHandle: " << this->ActiveHandle << "\n";
}
