// Paints labels on the vertices of a disc. The center of the disc is the first intersection of the
// mouse ray with the surface. If Geodesic is on, SurfaceDisc finds the vertices within a distance
// along the surface. If it is off, a pass over all vertices finds those within a straight-line
// distance. Only labels that change are written and recorded, so a cancel restores exactly these
// labels.
#include "vtkRegionBrushRepresentation.h"

#include "handle_shapes.h"
#include "rest_surface.h"
#include "screen_view.h"
#include "surface/surface_disc.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
constexpr int outline_sides = 64;
// distance between the discs of a stroke, as a fraction of the radius
constexpr double spacing = 0.4;
constexpr int maximum_discs = 200; // maximum number of discs per move of the mouse
} // namespace

class vtkRegionBrushRepresentation::Internals
{
public:
  bindpose::RestSurface Surface;
  std::unique_ptr<bindpose::SurfaceDisc> Disc;
  int DiscBuild = -1; // RestSurface::build_count() of the surface for which Disc was created

  bool HasHit = false;
  Vector3d HitPosition = Vector3d::Zero();
  Vector3d Normal = Vector3d::UnitZ();
  bindpose::Index Triangle = -1;

  bool Painting = false;
  Vector2d LastPosition = Vector2d::Zero(); // last display position of the stroke
  // changed vertices with their labels before the stroke
  std::vector<std::pair<vtkIdType, double>> ChangedLabels;

  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;

  vtkDataArray* Labels()
  {
    vtkPointData* data = this->Surface.get()->GetPointData();
    vtkDataArray* labels = data->GetArray("RegionId");
    const vtkIdType count = this->Surface.get()->GetNumberOfPoints();
    if (!labels || labels->GetNumberOfComponents() != 1 || labels->GetNumberOfTuples() != count)
    {
      vtkNew<vtkIntArray> fresh;
      fresh->SetName("RegionId");
      fresh->SetNumberOfTuples(count);
      fresh->Fill(0.0);
      data->AddArray(fresh);
      labels = data->GetArray("RegionId");
    }
    return labels;
  }

  void MarkModified(vtkDataArray* labels)
  {
    labels->Modified();
    this->Surface.get()->Modified();
  }
};

vtkStandardNewMacro(vtkRegionBrushRepresentation);

vtkRegionBrushRepresentation::vtkRegionBrushRepresentation() : Internal(new Internals)
{
  this->InteractionState = OUTSIDE;
  Internals& self = *this->Internal;
  self.Mapper->SetScalarModeToUsePointData();
  self.Mapper->SetColorModeToDirectScalars();
  self.Actor->SetMapper(self.Mapper);
  self.Actor->GetProperty()->LightingOff();
}

vtkRegionBrushRepresentation::~vtkRegionBrushRepresentation() = default;

void vtkRegionBrushRepresentation::SetSurface(vtkPolyData* surface)
{
  if (surface != this->GetSurface())
  {
    this->CancelWidgetInteraction();
    this->Internal->Surface.set(surface);
    this->Internal->DiscBuild = -1;
    this->Internal->ChangedLabels.clear();
    this->Leave();
    this->Modified();
  }
}

vtkPolyData* vtkRegionBrushRepresentation::GetSurface()
{
  return this->Internal->Surface.get();
}

double vtkRegionBrushRepresentation::GetDiscRadius()
{
  if (this->Radius > 0.0 || !this->GetSurface())
  {
    return this->Radius;
  }
  double bounds[6];
  this->GetSurface()->GetBounds(bounds);
  return Vector3d(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]).norm() /
    20.0;
}

vtkIdType vtkRegionBrushRepresentation::GetNumberOfChangedPoints()
{
  return static_cast<vtkIdType>(this->Internal->ChangedLabels.size());
}

bool vtkRegionBrushRepresentation::IsPainting()
{
  return this->Internal->Painting;
}

// ---- The mouse ---------------------------------------------------------------------------------

bool vtkRegionBrushRepresentation::FindHit(const double eventPos[2])
{
  Internals& self = *this->Internal;
  self.HasHit = false;
  const bindpose::SurfaceProbe* probe = this->Renderer ? self.Surface.probe() : nullptr;
  if (!probe)
  {
    return false;
  }
  const bindpose::ScreenView view(this->Renderer);
  const bindpose::Ray ray = view.ray(Vector2d(eventPos));
  const std::vector<bindpose::SurfaceProbe::Hit> hits = probe->hits(ray.origin, ray.direction);
  if (hits.empty())
  {
    return false;
  }
  self.HasHit = true;
  self.HitPosition = ray.origin + hits.front().distance * ray.direction;
  self.Triangle = hits.front().triangle;
  const auto points = self.Surface.points();
  const auto corners = self.Surface.triangles().row(self.Triangle);
  const Vector3d a = points.row(corners[0]);
  self.Normal =
    (Vector3d(points.row(corners[1])) - a).cross(Vector3d(points.row(corners[2])) - a).normalized();
  return true;
}

int vtkRegionBrushRepresentation::ComputeInteractionState(int x, int y, int vtkNotUsed(modify))
{
  const double position[2] = { static_cast<double>(x), static_cast<double>(y) };
  this->InteractionState = this->FindHit(position) ? ON_SURFACE : OUTSIDE;
  this->Modified();
  return this->InteractionState;
}

void vtkRegionBrushRepresentation::Leave()
{
  this->InteractionState = OUTSIDE;
  if (this->Internal->HasHit)
  {
    this->Internal->HasHit = false;
    this->Modified();
  }
}

void vtkRegionBrushRepresentation::PaintDisc()
{
  Internals& self = *this->Internal;
  const double label = this->Erase ? 0.0 : this->RegionId;
  const double radius = this->GetDiscRadius();
  vtkDataArray* labels = self.Labels();
  const auto paint = [&](vtkIdType vertex)
  {
    const double before = labels->GetComponent(vertex, 0);
    if (before != label)
    {
      self.ChangedLabels.emplace_back(vertex, before);
      labels->SetComponent(vertex, 0, label);
    }
  };
  if (this->Geodesic)
  {
    if (self.DiscBuild != self.Surface.build_count())
    {
      self.Disc =
        std::make_unique<bindpose::SurfaceDisc>(self.Surface.points(), self.Surface.triangles());
      self.DiscBuild = self.Surface.build_count();
    }
    for (const auto& found : self.Disc->within(self.HitPosition, self.Triangle, radius))
    {
      paint(found.first);
    }
    return;
  }
  const auto points = self.Surface.points();
  for (bindpose::Index v = 0; v < points.rows(); ++v)
  {
    if ((points.row(v).transpose() - self.HitPosition).squaredNorm() <= radius * radius)
    {
      paint(v);
    }
  }
}

void vtkRegionBrushRepresentation::StartWidgetInteraction(double eventPos[2])
{
  Internals& self = *this->Internal;
  if (!this->FindHit(eventPos))
  {
    return;
  }
  self.Painting = true;
  self.ChangedLabels.clear();
  self.LastPosition = Vector2d(eventPos);
  this->PaintDisc();
  self.MarkModified(self.Labels());
  this->Modified();
}

void vtkRegionBrushRepresentation::WidgetInteraction(double eventPos[2])
{
  Internals& self = *this->Internal;
  if (!self.Painting)
  {
    return;
  }
  // Paint several discs along the path of the mouse, because the mouse may have moved far since the
  // last event.
  const Vector2d to(eventPos);
  const Vector2d displacement = to - self.LastPosition;
  const double pixel =
    self.HasHit ? bindpose::ScreenView(this->Renderer).pixel_length_at(self.HitPosition) : 0.0;
  const double step = pixel > 0.0 ? spacing * this->GetDiscRadius() / pixel : displacement.norm();
  const int count = static_cast<int>(std::clamp(
    std::ceil(displacement.norm() / std::max(step, 1.0)), 1.0, static_cast<double>(maximum_discs)));
  for (int i = 1; i <= count; ++i)
  {
    const Vector2d display_position = self.LastPosition + displacement * i / count;
    if (this->FindHit(display_position.data()))
    {
      this->PaintDisc();
    }
  }
  self.LastPosition = to;
  self.MarkModified(self.Labels());
  this->Modified();
}

void vtkRegionBrushRepresentation::EndWidgetInteraction(double vtkNotUsed(eventPos)[2])
{
  this->Internal->Painting = false;
  this->Modified();
}

void vtkRegionBrushRepresentation::CancelWidgetInteraction()
{
  Internals& self = *this->Internal;
  if (!self.Painting)
  {
    return;
  }
  self.Painting = false;
  vtkDataArray* labels = self.Labels();
  // in reverse order, because a vertex may have changed twice
  for (auto change = self.ChangedLabels.rbegin(); change != self.ChangedLabels.rend(); ++change)
  {
    labels->SetComponent(change->first, 0, change->second);
  }
  self.ChangedLabels.clear();
  self.MarkModified(labels);
  this->Modified();
}

// ---- Drawing -----------------------------------------------------------------------------------

void vtkRegionBrushRepresentation::BuildRepresentation()
{
  Internals& self = *this->Internal;
  bindpose::HandleShapes shapes(false);
  if (self.HasHit && this->Renderer)
  {
    const bindpose::ScreenView view(this->Renderer);
    const double* rgb = this->Erase ? this->EraseColor : this->PaintColor;
    const double pixel = this->PixelScale * view.pixel_length_at(self.HitPosition);
    const Vector3d u = self.Normal.unitOrthogonal();
    const Vector3d v = self.Normal.cross(u);
    std::vector<Vector3d> circle;
    for (int side = 0; side <= outline_sides; ++side)
    {
      const double angle = 2.0 * EIGEN_PI * (side % outline_sides) / outline_sides;
      circle.push_back(
        self.HitPosition + this->GetDiscRadius() * (std::cos(angle) * u + std::sin(angle) * v));
    }
    shapes.add_tube(circle, 2.0 * pixel, { 0.13, 0.13, 0.15 });
    // Draw a thinner circle in the brush color in front of the dark circle. The dark circle then
    // looks like the outline of the colored circle.
    for (Vector3d& point : circle)
    {
      point -= 3.0 * pixel * view.direction_to(point);
    }
    shapes.add_tube(circle, 1.2 * pixel, { rgb[0], rgb[1], rgb[2] });
    shapes.add_ball(self.HitPosition - 3.0 * pixel * view.direction_to(self.HitPosition),
      2.2 * pixel, { rgb[0], rgb[1], rgb[2] });
  }
  self.Mapper->SetInputData(shapes.polydata());
}

int vtkRegionBrushRepresentation::RenderOverlay(vtkViewport* viewport)
{
  this->BuildRepresentation();
  return this->Internal->HasHit ? this->Internal->Actor->RenderOpaqueGeometry(viewport) : 0;
}

void vtkRegionBrushRepresentation::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Actor->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkRegionBrushRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Surface: " << this->GetSurface() << "\n";
  os << indent << "RegionId: " << this->RegionId << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "Geodesic: " << this->Geodesic << "\n";
  os << indent << "Erase: " << this->Erase << "\n";
  os << indent << "PixelScale: " << this->PixelScale << "\n";
  const auto print_color = [&](const char* name, const double c[3])
  { os << indent << name << ": (" << c[0] << ", " << c[1] << ", " << c[2] << ")\n"; };
  print_color("PaintColor", this->PaintColor);
  print_color("EraseColor", this->EraseColor);
}
