// What is drawn is rebuilt whenever the handles, the camera or the window change: sizes are in
// pixels, so every ball gets the world radius that a pixel has at its place. All solid parts make
// one polydata, all outlines another (the same shapes, a little larger, back sides only).
//
// Handles lie inside the shape they bend. To be seen they are drawn in the overlay pass after the
// depth buffer has been cleared, so they hide each other correctly and nothing hides them.
//
// A drag keeps the transforms from its start. Every move makes one rigid motion D from the start
// to now and writes D * start for the grabbed handle and its descendants: no error accumulates,
// and a cancel copies the start back.
#include "vtkHandleSetRepresentation.h"

#include "handle_shapes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkInteractorObserver.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkWindow.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

using Eigen::Vector3d;

namespace
{
constexpr double bone_end_size = 0.6; // of a ball's radius
constexpr double outline_pixels = 1.6;
constexpr unsigned int gl_depth_test = 0x0B71;
constexpr unsigned int gl_depth_buffer_bit = 0x00000100;

using Affine = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

struct Place
{
  int kind = 0;
  Vector3d head = Vector3d::Zero(); // posed
  Vector3d tail = Vector3d::Zero();
};

bindpose::Colour lighter(const bindpose::Colour& colour)
{
  bindpose::Colour result = colour;
  for (double& c : result)
  {
    c += 0.45 * (1.0 - c);
  }
  return result;
}

bindpose::Colour to_colour(const double rgb[3])
{
  return { rgb[0], rgb[1], rgb[2] };
}

double cell_value(vtkPolyData* data, const char* name, vtkIdType cell, double fallback)
{
  vtkDataArray* array = data->GetCellData()->GetArray(name);
  return array && cell < array->GetNumberOfTuples() ? array->GetComponent(cell, 0) : fallback;
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
  vtkSmartPointer<vtkPolyData> Handles;
  vtkNew<vtkPolyDataMapper> SolidMapper;
  vtkNew<vtkActor> Solid;
  vtkNew<vtkPolyDataMapper> OutlineMapper;
  vtkNew<vtkActor> Outline;
  vtkNew<vtkTextProperty> Text;
  std::vector<vtkSmartPointer<vtkTextActor>> Labels;
  std::size_t VisibleLabels = 0;

  // the drag that is going on
  int Grabbed = OUTSIDE;
  std::vector<Affine> StartTransforms;
  std::vector<vtkIdType> Moving;
  Vector3d GrabStart = Vector3d::Zero(); // world, under the mouse, in the plane of the drag
  Vector3d HeadStart = Vector3d::Zero();
  Vector3d TailStart = Vector3d::Zero();
  double GrabDepth = 0.0;

  Affine Transform(vtkIdType cell) const
  {
    Affine t = Affine::Zero();
    t.leftCols<3>().setIdentity();
    vtkDataArray* array = this->Handles->GetCellData()->GetArray("Transform");
    if (array && array->GetNumberOfComponents() == 12 && cell < array->GetNumberOfTuples())
    {
      array->GetTuple(cell, t.data());
    }
    return t;
  }

  void SetTransforms(const std::vector<vtkIdType>& cells, const std::vector<Affine>& transforms)
  {
    vtkCellData* data = this->Handles->GetCellData();
    vtkDataArray* array = data->GetArray("Transform");
    const vtkIdType count = this->Handles->GetNumberOfCells();
    if (!array || array->GetNumberOfComponents() != 12 || array->GetNumberOfTuples() != count)
    {
      vtkNew<vtkDoubleArray> fresh;
      fresh->SetName("Transform");
      fresh->SetNumberOfComponents(12);
      fresh->SetNumberOfTuples(count);
      for (vtkIdType cell = 0; cell < count; ++cell)
      {
        fresh->SetTuple(cell, this->Transform(cell).data());
      }
      data->AddArray(fresh);
      array = fresh;
    }
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      array->SetTuple(cells[i], transforms[i].data());
    }
    array->Modified();
    this->Handles->Modified();
  }

  bool Exists(vtkIdType cell) const
  {
    return this->Handles && cell >= 0 && cell < this->Handles->GetNumberOfCells();
  }

  int Kind(vtkIdType cell) const
  {
    vtkNew<vtkIdList> ids;
    this->Handles->GetCellPoints(cell, ids);
    const double fallback = ids->GetNumberOfIds() == 2 ? 1.0 : 0.0;
    return static_cast<int>(cell_value(this->Handles, "HandleKind", cell, fallback));
  }

  // Bones and bars have two ends, all else one; the stretch lengthens a bone from its head.
  Place PlaceOf(vtkIdType cell) const
  {
    Place place;
    place.kind = this->Kind(cell);
    vtkNew<vtkIdList> ids;
    this->Handles->GetCellPoints(cell, ids);
    if (ids->GetNumberOfIds() == 0)
    {
      return place;
    }
    this->Handles->GetPoint(ids->GetId(0), place.head.data());
    this->Handles->GetPoint(ids->GetId(ids->GetNumberOfIds() == 2 ? 1 : 0), place.tail.data());
    const Affine t = this->Transform(cell);
    place.head = t * place.head.homogeneous();
    place.tail = t * place.tail.homogeneous();
    const double stretch = cell_value(this->Handles, "Stretch", cell, 1.0);
    place.tail = place.head + stretch * (place.tail - place.head);
    return place;
  }

  vtkIdType CountCells() const { return this->Handles ? this->Handles->GetNumberOfCells() : 0; }

  // Where a cage element's end is: with the cage vertex at the same rest point.
  Vector3d PosedPoint(vtkIdType point) const
  {
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < this->CountCells(); ++cell)
    {
      this->Handles->GetCellPoints(cell, ids);
      if (ids->GetNumberOfIds() == 1 && ids->GetId(0) == point && this->Kind(cell) >= 0)
      {
        return this->PlaceOf(cell).head;
      }
    }
    Vector3d rest;
    this->Handles->GetPoint(point, rest.data());
    return rest;
  }
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
  self.Text->SetFontFamilyToArial();
  self.Text->SetFontSize(13);
  self.Text->SetColor(0.13, 0.13, 0.15);
  self.Text->SetBackgroundColor(1.0, 1.0, 1.0);
  self.Text->SetBackgroundOpacity(0.8);
  self.Text->SetVerticalJustificationToCentered();
}

vtkHandleSetRepresentation::~vtkHandleSetRepresentation() = default;

void vtkHandleSetRepresentation::SetHandles(vtkPolyData* handles)
{
  if (this->Internal->Handles == handles)
  {
    return;
  }
  this->Internal->Handles = handles;
  this->HoveredHandle = -1;
  this->SelectedHandle = -1;
  this->ActiveHandle = -1;
  this->InteractionState = OUTSIDE;
  this->Modified();
}

vtkPolyData* vtkHandleSetRepresentation::GetHandles()
{
  return this->Internal->Handles;
}

vtkTextProperty* vtkHandleSetRepresentation::GetLabelTextProperty()
{
  return this->Internal->Text;
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
  if (!this->Internal->Exists(handle))
  {
    return std::string();
  }
  vtkPolyData* handles = this->Internal->Handles;
  auto* names =
    vtkStringArray::SafeDownCast(handles->GetCellData()->GetAbstractArray("HandleName"));
  if (names && handle < names->GetNumberOfValues() && !names->GetValue(handle).empty())
  {
    return names->GetValue(handle);
  }
  // the names that the filters give: points and bones are numbered apart
  const bool bone = this->IsBone(handle);
  int number = 0;
  for (vtkIdType cell = 0; cell <= handle; ++cell)
  {
    const int kind = this->Internal->Kind(cell);
    number += kind >= 0 && (kind == 1) == bone;
  }
  return (bone ? "b" : "p") + std::to_string(number);
}

int vtkHandleSetRepresentation::GetHandleMode(vtkIdType handle)
{
  return this->Internal->Exists(handle)
    ? static_cast<int>(cell_value(this->Internal->Handles, "Mode", handle, 0))
    : 0;
}

bool vtkHandleSetRepresentation::IsBone(vtkIdType handle)
{
  return this->Internal->Exists(handle) && this->Internal->Kind(handle) == 1;
}

void vtkHandleSetRepresentation::GetPosedHead(vtkIdType handle, double head[3])
{
  const Place place = this->Internal->Exists(handle) ? this->Internal->PlaceOf(handle) : Place();
  std::copy_n(place.head.data(), 3, head);
}

void vtkHandleSetRepresentation::GetPosedTail(vtkIdType handle, double tail[3])
{
  const Place place = this->Internal->Exists(handle) ? this->Internal->PlaceOf(handle) : Place();
  std::copy_n(place.tail.data(), 3, tail);
}

// ---- Picking -----------------------------------------------------------------------------------

int vtkHandleSetRepresentation::ComputeInteractionState(int x, int y, int vtkNotUsed(modify))
{
  Internals& self = *this->Internal;
  int best_state = OUTSIDE;
  vtkIdType best_handle = -1;
  int best_rank = 4;
  double best_distance = 0.0;
  double best_depth = 0.0;
  const auto offer = [&](int state, vtkIdType handle, int rank, double distance, double depth)
  {
    const bool better = rank < best_rank ||
      (rank == best_rank &&
        (distance < best_distance || (distance == best_distance && depth < best_depth)));
    if (better)
    {
      best_state = state;
      best_handle = handle;
      best_rank = rank;
      best_distance = distance;
      best_depth = depth;
    }
  };
  const Eigen::Vector2d mouse(x, y);
  const double ball = this->PixelScale * (this->PointSize + this->PickTolerance);
  const double end = this->PixelScale * (bone_end_size * this->PointSize + this->PickTolerance);
  for (vtkIdType cell = 0; this->Renderer && cell < self.CountCells(); ++cell)
  {
    const Place place = self.PlaceOf(cell);
    if (place.kind < 0)
    {
      continue;
    }
    Vector3d head;
    vtkInteractorObserver::ComputeWorldToDisplay(
      this->Renderer, place.head[0], place.head[1], place.head[2], head.data());
    const double to_head = (head.head<2>() - mouse).norm();
    if (place.kind != 1)
    {
      if (to_head <= ball)
      {
        offer(ON_POINT, cell, 0, to_head, head[2]);
      }
      continue;
    }
    Vector3d tail;
    vtkInteractorObserver::ComputeWorldToDisplay(
      this->Renderer, place.tail[0], place.tail[1], place.tail[2], tail.data());
    const double to_tail = (tail.head<2>() - mouse).norm();
    // Of a joint that two bones share the tail is grabbed: turning the upper bone is what is
    // meant, moving the lower one off it hardly ever.
    if (to_tail <= end)
    {
      offer(ON_TAIL, cell, 1, to_tail, tail[2]);
    }
    if (to_head <= end)
    {
      offer(ON_HEAD, cell, 2, to_head, head[2]);
    }
    const Eigen::Vector2d along = (tail - head).head<2>();
    const double length2 = along.squaredNorm();
    const double s =
      length2 > 0.0 ? std::clamp((mouse - head.head<2>()).dot(along) / length2, 0.0, 1.0) : 0.0;
    const double to_body = (head.head<2>() + s * along - mouse).norm();
    const double width = std::clamp(this->BoneWidth * std::sqrt(length2),
      0.5 * this->PixelScale * this->PointSize, 2.0 * this->PixelScale * this->PointSize);
    if (to_body <= width + this->PixelScale * this->PickTolerance)
    {
      offer(ON_BODY, cell, 3, to_body, head[2] + s * (tail[2] - head[2]));
    }
  }
  this->InteractionState = best_state;
  this->SetHoveredHandle(best_handle);
  return best_state;
}

// ---- Dragging ----------------------------------------------------------------------------------

void vtkHandleSetRepresentation::StartWidgetInteraction(double eventPos[2])
{
  Internals& self = *this->Internal;
  this->ActiveHandle = -1;
  self.Grabbed = this->InteractionState;
  if (!this->Renderer || self.Grabbed == OUTSIDE || !self.Exists(this->HoveredHandle) ||
    this->GetHandleMode(this->HoveredHandle) == 2)
  {
    return;
  }
  this->ActiveHandle = this->HoveredHandle;
  const Place place = self.PlaceOf(this->ActiveHandle);
  self.HeadStart = place.head;
  self.TailStart = place.tail;
  Vector3d grabbed = place.head;
  if (self.Grabbed == ON_TAIL)
  {
    grabbed = place.tail;
  }
  else if (self.Grabbed == ON_BODY)
  {
    grabbed = 0.5 * (place.head + place.tail);
  }
  Vector3d display;
  vtkInteractorObserver::ComputeWorldToDisplay(
    this->Renderer, grabbed[0], grabbed[1], grabbed[2], display.data());
  self.GrabDepth = display[2];
  Eigen::Vector4d world;
  vtkInteractorObserver::ComputeDisplayToWorld(
    this->Renderer, eventPos[0], eventPos[1], self.GrabDepth, world.data());
  self.GrabStart = world.head<3>();

  self.Moving.clear();
  self.StartTransforms.clear();
  const vtkIdType count = self.CountCells();
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    // Up the hierarchy; the number of steps is bounded, whatever the file says.
    vtkIdType ancestor = cell;
    for (vtkIdType step = 0; step < count && self.Exists(ancestor); ++step)
    {
      if (ancestor == this->ActiveHandle)
      {
        self.Moving.push_back(cell);
        self.StartTransforms.push_back(self.Transform(cell));
        break;
      }
      ancestor = this->MoveDescendants
        ? static_cast<vtkIdType>(cell_value(self.Handles, "Parent", ancestor, -1))
        : -1;
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
  Eigen::Vector4d world;
  vtkInteractorObserver::ComputeDisplayToWorld(
    this->Renderer, eventPos[0], eventPos[1], self.GrabDepth, world.data());
  const Vector3d moved = world.head<3>() - self.GrabStart;
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (self.Grabbed == ON_TAIL)
  {
    const Vector3d before = self.TailStart - self.HeadStart;
    const Vector3d after = before + moved;
    if (before.norm() > 0.0 && after.norm() > 1e-6 * before.norm())
    {
      motion.translate(self.HeadStart);
      motion.rotate(Eigen::Quaterniond::FromTwoVectors(before, after));
      motion.translate(Vector3d(-self.HeadStart));
    }
  }
  else
  {
    motion.translate(moved);
  }
  std::vector<Affine> transforms;
  for (const Affine& start : self.StartTransforms)
  {
    Affine t = motion.linear() * start;
    t.col(3) += motion.translation();
    transforms.push_back(t);
  }
  self.SetTransforms(self.Moving, transforms);
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
    this->Internal->SetTransforms(this->Internal->Moving, this->Internal->StartTransforms);
    this->ActiveHandle = -1;
    this->Modified();
  }
}

// ---- Drawing -----------------------------------------------------------------------------------

vtkMTimeType vtkHandleSetRepresentation::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  time = std::max(time, this->Internal->Text->GetMTime());
  if (this->Internal->Handles)
  {
    time = std::max(time, this->Internal->Handles->GetMTime());
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
  const bool fine = self.CountCells() <= 60;
  bindpose::HandleShapes solid(fine);
  bindpose::HandleShapes outline(fine);
  self.VisibleLabels = 0;
  const bindpose::Colour mode_colours[3] = { to_colour(this->FullColor),
    to_colour(this->PositionColor), to_colour(this->FreeColor) };
  // World length of a pixel at a place.
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  const Vector3d eye(camera->GetPosition());
  const Vector3d sight(camera->GetDirectionOfProjection());
  const double height = std::max(this->Renderer->GetSize()[1], 1);
  const auto pixel_at = [&](const Vector3d& place)
  {
    const double half_height = camera->GetParallelProjection()
      ? camera->GetParallelScale()
      : std::max(sight.dot(place - eye), 0.0) *
        std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
    return this->PixelScale * 2.0 * half_height / height;
  };
  for (vtkIdType cell = 0; cell < self.CountCells(); ++cell)
  {
    const Place place = self.PlaceOf(cell);
    if (place.kind < 0)
    {
      vtkNew<vtkIdList> ids;
      self.Handles->GetCellPoints(cell, ids);
      for (vtkIdType i = 0; i + 1 < ids->GetNumberOfIds() + (ids->GetNumberOfIds() > 2); ++i)
      {
        const Vector3d a = self.PosedPoint(ids->GetId(i));
        const Vector3d b = self.PosedPoint(ids->GetId((i + 1) % ids->GetNumberOfIds()));
        solid.add_bone(a, b, 1.2 * pixel_at(0.5 * (a + b)), to_colour(this->OutlineColor));
      }
      continue;
    }
    const bool hot = cell == this->HoveredHandle || cell == this->ActiveHandle;
    const bool selected = cell == this->SelectedHandle;
    const bindpose::Colour base = mode_colours[std::clamp(this->GetHandleMode(cell), 0, 2)];
    const bindpose::Colour colour = hot ? lighter(base) : base;
    const bindpose::Colour edge = to_colour(selected ? this->SelectedColor : this->OutlineColor);
    const double growth = hot ? 1.2 : 1.0;
    const double line = outline_pixels * (selected ? 1.6 : 1.0);
    // Around the selected handle's outline there is another, so that it shows on any ground.
    const double rim = line + outline_pixels;
    const bindpose::Colour rim_colour = to_colour(this->OutlineColor);
    const auto add_ball = [&](const Vector3d& center, double size)
    {
      const double pixel = pixel_at(center);
      solid.add_ball(center, size * growth * pixel, colour);
      outline.add_ball(center, (size * growth + line) * pixel, edge);
      if (selected)
      {
        outline.add_ball(center, (size * growth + rim) * pixel, rim_colour);
      }
    };
    if (place.kind == 1)
    {
      const Vector3d middle = 0.5 * (place.head + place.tail);
      const double pixel = pixel_at(middle);
      const double width = growth *
        std::clamp(this->BoneWidth * (place.tail - place.head).norm(),
          0.5 * this->PointSize * pixel, 2.0 * this->PointSize * pixel);
      solid.add_bone(place.head, place.tail, width, colour);
      outline.add_bone(place.head, place.tail, width, edge, line * pixel);
      if (selected)
      {
        outline.add_bone(place.head, place.tail, width, rim_colour, rim * pixel);
      }
      add_ball(place.head, bone_end_size * this->PointSize);
      add_ball(place.tail, bone_end_size * this->PointSize);
    }
    else
    {
      add_ball(place.head, this->PointSize);
    }
    if (this->ShowLabels || (this->ShowHoverName && hot))
    {
      const Vector3d at = place.kind == 1 ? Vector3d(0.5 * (place.head + place.tail)) : place.head;
      Vector3d display;
      vtkInteractorObserver::ComputeWorldToDisplay(
        this->Renderer, at[0], at[1], at[2], display.data());
      if (self.Labels.size() == self.VisibleLabels)
      {
        self.Labels.push_back(vtkSmartPointer<vtkTextActor>::New());
        self.Labels.back()->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
      }
      vtkTextActor* label = self.Labels[self.VisibleLabels++];
      label->SetInput((" " + this->GetHandleName(cell) + " ").c_str());
      label->GetTextProperty()->ShallowCopy(self.Text);
      label->GetTextProperty()->SetFontSize(
        static_cast<int>(self.Text->GetFontSize() * this->PixelScale + 0.5));
      // Right of a ball; of a bone on the side that faces right, so as not to cover it.
      Eigen::Vector2d aside(1.0, 0.0);
      if (place.kind == 1)
      {
        Vector3d head;
        vtkInteractorObserver::ComputeWorldToDisplay(
          this->Renderer, place.head[0], place.head[1], place.head[2], head.data());
        const Eigen::Vector2d along = (display - head).head<2>();
        if (along.norm() > 0.0)
        {
          aside = Eigen::Vector2d(along.y(), -along.x()).normalized();
          aside *= aside.x() < 0.0 ? -1.0 : 1.0;
        }
      }
      const double distance = this->PixelScale * this->PointSize;
      label->SetDisplayPosition(static_cast<int>(display[0] + 1.9 * distance * aside.x()),
        static_cast<int>(display[1] + 2.4 * distance * aside.y()));
    }
  }
  self.SolidMapper->SetInputData(solid.polydata());
  self.OutlineMapper->SetInputData(outline.polydata());
  this->BuildTime.Modified();
}

double* vtkHandleSetRepresentation::GetBounds()
{
  Eigen::AlignedBox3d box;
  for (vtkIdType cell = 0; cell < this->Internal->CountCells(); ++cell)
  {
    const Place place = this->Internal->PlaceOf(cell);
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
  for (std::size_t i = 0; i < this->Internal->VisibleLabels; ++i)
  {
    // A text actor draws its letters in the opaque pass and shows them in the overlay.
    this->Internal->Labels[i]->RenderOpaqueGeometry(viewport);
    rendered += this->Internal->Labels[i]->RenderOverlay(viewport);
  }
  return rendered;
}

void vtkHandleSetRepresentation::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Solid->ReleaseGraphicsResources(window);
  this->Internal->Outline->ReleaseGraphicsResources(window);
  for (const auto& label : this->Internal->Labels)
  {
    label->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkHandleSetRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Handles: " << this->Internal->Handles.Get() << "\n";
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
