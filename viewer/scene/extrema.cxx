// Finds local extrema of the displayed array and draws them as balls. The kernel finds the extrema
// on the graph of the mesh's points. A dark rim makes a ball visible on any color. The rim is a
// larger ball of which only the back faces are drawn. Both balls are moved in front of the surface,
// on the line to the eye; otherwise the surface would cover the rim.
#include "scene/extrema.h"

#include "conversion.h"
#include "scene/colors.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkGlyph3D.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <algorithm>

namespace bindpose
{
namespace
{
constexpr double rim_size = 1.25;

std::vector<char> points_of_handles(vtkDataSet* data)
{
  std::vector<char> is_handle_point(static_cast<std::size_t>(data->GetNumberOfPoints()), 0);
  for (const char* name : { "Weights", "RawWeights" })
  {
    vtkDataArray* weights = data->GetPointData()->GetArray(name);
    for (vtkIdType v = 0; weights && v < weights->GetNumberOfTuples(); ++v)
    {
      for (int j = 0; j < weights->GetNumberOfComponents() && !is_handle_point[v]; ++j)
      {
        is_handle_point[v] = weights->GetComponent(v, j) == 1.0;
      }
    }
  }
  return is_handle_point;
}

} // namespace

Status find_extrema(const std::vector<Tile>& tiles, const Coloring& coloring,
  std::vector<std::vector<Extremum>>& extrema)
{
  extrema.assign(tiles.size(), {});
  bool any = false;
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    vtkDataSet* data = tiles[i].data;
    bool on_points = true;
    Domain domain;
    std::vector<Index> cells;
    const bool is_numeric = coloring.kind != Coloring::Kind::none && coloring.categories.empty();
    const auto shown = is_numeric ? color_values(data, coloring, on_points) : nullptr;
    if (!shown || !on_points || !to_domain(data, domain, cells).ok())
    {
      continue;
    }
    any = true;
    const Eigen::VectorXd values =
      Eigen::Map<const Eigen::VectorXd>(shown->GetPointer(0), shown->GetNumberOfValues());
    if (!values.allFinite())
    {
      return Status::invalid_input("extrema need finite values, but the array '" + coloring.array +
        "' has a value that is not finite");
    }
    extrema[i] = interior_extrema(vertex_graph(domain), values, points_of_handles(data));
  }
  return any
    ? Status()
    : Status::invalid_input("to show extrema, color by a point array of a surface or of tets");
}

std::vector<Category> count_extrema(const std::vector<std::vector<Extremum>>& extrema)
{
  std::vector<Category> categories = extremum_categories();
  for (const std::vector<Extremum>& tile_extrema : extrema)
  {
    for (const Extremum& extremum : tile_extrema)
    {
      ++categories[extremum.maximum ? 1 : 0].count;
    }
  }
  return categories;
}

void report_extrema(const std::vector<std::vector<Extremum>>& extrema,
  const std::vector<std::int64_t>& drawn, Report& report)
{
  std::vector<std::int64_t> maxima;
  std::vector<std::int64_t> minima;
  for (const std::vector<Extremum>& tile_extrema : extrema)
  {
    maxima.push_back(std::count_if(tile_extrema.begin(), tile_extrema.end(),
      [](const Extremum& extremum) { return extremum.maximum; }));
    minima.push_back(static_cast<std::int64_t>(tile_extrema.size()) - maxima.back());
  }
  report.set("picture.extrema[].maxima", maxima);
  report.set("picture.extrema[].minima", minima);
  report.set("picture.extrema[].drawn", drawn);
}

ExtremumBalls::ExtremumBalls()
{
  for (const int rim : { 0, 1 })
  {
    this->spheres_[rim]->SetThetaResolution(24);
    this->spheres_[rim]->SetPhiResolution(16);
    for (const int maximum : { 0, 1 })
    {
      vtkNew<vtkGlyph3D> balls;
      balls->SetInputData(this->clouds_[maximum]);
      balls->SetSourceConnection(this->spheres_[rim]->GetOutputPort());
      balls->ScalingOff();
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputConnection(balls->GetOutputPort());
      mapper->ScalarVisibilityOff();
      const auto actor = vtkSmartPointer<vtkActor>::New();
      actor->SetMapper(mapper);
      actor->PickableOff();
      vtkProperty* property = actor->GetProperty();
      if (rim)
      {
        set_color(property, palette::line);
        property->LightingOff();
        property->FrontfaceCullingOn();
      }
      else
      {
        const Rgb& color = extremum_categories()[maximum].color;
        set_color(property, color);
        property->SetAmbient(0.45);
        property->SetDiffuse(0.65);
      }
      this->actors_.push_back(actor);
    }
  }
}

void ExtremumBalls::set(const std::vector<Marker>& markers, double radius)
{
  this->markers_ = markers;
  this->radius_ = radius;
  this->spheres_[0]->SetRadius(radius);
  this->spheres_[1]->SetRadius(rim_size * radius);
}

void ExtremumBalls::face_eye(const Vec3& eye)
{
  for (const int maximum : { 0, 1 })
  {
    vtkNew<vtkPoints> points;
    for (const Marker& marker : this->markers_)
    {
      if (marker.maximum == (maximum == 1))
      {
        const Vec3 view_direction = (eye - marker.position).normalized();
        points->InsertNextPoint(
          Vec3(marker.position + rim_size * this->radius_ * view_direction).data());
      }
    }
    this->clouds_[maximum]->SetPoints(points);
    this->clouds_[maximum]->Modified();
  }
  for (std::size_t i = 0; i < this->actors_.size(); ++i)
  {
    this->actors_[i]->SetVisibility(this->clouds_[i % 2]->GetNumberOfPoints() > 0);
  }
}

Index add_extrema(vtkRenderer* renderer, vtkDataSet* data, const std::vector<Extremum>& extrema,
  const std::vector<char>& drawn_points, double radius)
{
  std::vector<ExtremumBalls::Marker> markers;
  for (const Extremum& extremum : extrema)
  {
    if (drawn_points.empty() || drawn_points[extremum.vertex])
    {
      markers.push_back({ Vec3(data->GetPoint(extremum.vertex)), extremum.maximum });
    }
  }
  ExtremumBalls balls;
  balls.set(markers, radius);
  balls.face_eye(Vec3(renderer->GetActiveCamera()->GetPosition()));
  for (const auto& actor : balls.actors())
  {
    if (actor->GetVisibility())
    {
      renderer->AddActor(actor);
    }
  }
  return static_cast<Index>(markers.size());
}

} // namespace bindpose
