// The mesh becomes a graph of its points, the kernel counts on it. A ball's rim is a larger ball of
// which only the far side is drawn: it stands out from any colour below. Both lie before the
// surface, on the line to the eye, or the surface would cover the rim.
#include "scene/extrema.h"

#include "conversion.h"
#include "scene/colours.h"

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
  std::vector<char> exempt(static_cast<std::size_t>(data->GetNumberOfPoints()), 0);
  for (const char* name : { "Weights", "RawWeights" })
  {
    vtkDataArray* weights = data->GetPointData()->GetArray(name);
    for (vtkIdType v = 0; weights && v < weights->GetNumberOfTuples(); ++v)
    {
      for (int j = 0; j < weights->GetNumberOfComponents() && !exempt[v]; ++j)
      {
        exempt[v] = weights->GetComponent(v, j) == 1.0;
      }
    }
  }
  return exempt;
}

void add_balls(vtkRenderer* renderer, vtkPolyData* places, double radius, const Rgb& colour)
{
  for (const bool rim : { false, true })
  {
    vtkNew<vtkSphereSource> ball;
    ball->SetRadius(rim ? rim_size * radius : radius);
    ball->SetThetaResolution(24);
    ball->SetPhiResolution(16);
    vtkNew<vtkGlyph3D> balls;
    balls->SetInputData(places);
    balls->SetSourceConnection(ball->GetOutputPort());
    balls->ScalingOff();
    balls->Update();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(balls->GetOutput());
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty* look = actor->GetProperty();
    if (rim)
    {
      look->SetColor(palette::line[0], palette::line[1], palette::line[2]);
      look->LightingOff();
      look->FrontfaceCullingOn();
    }
    else
    {
      look->SetColor(colour[0], colour[1], colour[2]);
      look->SetAmbient(0.45);
      look->SetDiffuse(0.65);
    }
    renderer->AddActor(actor);
  }
}
} // namespace

Status find_extrema(const std::vector<Tile>& tiles, const Colouring& colouring,
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
    const bool by_number = colouring.kind != Colouring::Kind::none && colouring.categories.empty();
    const auto shown = by_number ? colour_values(data, colouring, on_points) : nullptr;
    if (!shown || !on_points || !to_domain(data, domain, cells).ok())
    {
      continue;
    }
    any = true;
    const Eigen::VectorXd values =
      Eigen::Map<const Eigen::VectorXd>(shown->GetPointer(0), shown->GetNumberOfValues());
    if (!values.allFinite())
    {
      return Status::invalid_input(
        "extrema need finite numbers, and '" + colouring.array + "' holds one that is not");
    }
    extrema[i] = interior_extrema(vertex_graph(domain), values, points_of_handles(data));
  }
  return any ? Status()
             : Status::invalid_input(
                 "extrema are those of a point array of a surface or of tets; name it by array");
}

std::vector<Category> count_extrema(const std::vector<std::vector<Extremum>>& extrema)
{
  std::vector<Category> categories = extremum_categories();
  for (const std::vector<Extremum>& its : extrema)
  {
    for (const Extremum& extremum : its)
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
  for (const std::vector<Extremum>& its : extrema)
  {
    maxima.push_back(std::count_if(
      its.begin(), its.end(), [](const Extremum& extremum) { return extremum.maximum; }));
    minima.push_back(static_cast<std::int64_t>(its.size()) - maxima.back());
  }
  report.set("picture.extrema[].maxima", maxima);
  report.set("picture.extrema[].minima", minima);
  report.set("picture.extrema[].drawn", drawn);
}

Index add_extrema(vtkRenderer* renderer, vtkDataSet* data, const std::vector<Extremum>& extrema,
  const std::vector<char>& seen, double radius)
{
  Index count = 0;
  const Vec3 eye(renderer->GetActiveCamera()->GetPosition());
  for (const bool maximum : { false, true })
  {
    vtkNew<vtkPoints> places;
    for (const Extremum& extremum : extrema)
    {
      if (extremum.maximum == maximum && (seen.empty() || seen[extremum.vertex]))
      {
        const Vec3 place(data->GetPoint(extremum.vertex));
        places->InsertNextPoint(
          Vec3(place + rim_size * radius * (eye - place).normalized()).data());
      }
    }
    if (places->GetNumberOfPoints() > 0)
    {
      vtkNew<vtkPolyData> cloud;
      cloud->SetPoints(places);
      add_balls(renderer, cloud, radius, extremum_categories()[maximum ? 1 : 0].colour);
    }
    count += places->GetNumberOfPoints();
  }
  return count;
}

} // namespace bindpose
