// Delaunay refinement of the enclosed region in the helper executable (mesher/remesh_job.cpp). This
// file checks the resulting mesh, finds the input's vertices in the mesh by their coordinates,
// improves the worst tets, and measures the distance from the surface.
#include "inside/remesh_tets.h"

#include "base/number_text.h"
#include "base/range_check.h"
#include "helper/child_process.h"
#include "helper/mesher_process.h"
#include "tets/tet_improvement.h"
#include "tets/tet_quality.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace bindpose
{

namespace
{
Status check_input(PointsView points, TrianglesView triangles, const RemeshOptions& options)
{
  Status status = check_mesh(points, triangles);
  if (!status.ok())
  {
    return status;
  }
  const auto out_of_range = [](const char* name, const char* range, double value)
  {
    return Status::invalid_input(
      std::string(name) + " must be " + range + ", not " + short_number(value));
  };
  constexpr double minimum = 1e-4;
  const Status threshold = check_positive("winding_threshold", options.winding_threshold);
  if (!threshold.ok())
  {
    return threshold;
  }
  if (!(options.smallest_edge >= minimum && options.smallest_edge <= 1.0))
  {
    return out_of_range("smallest_edge", "from 0.0001 to 1", options.smallest_edge);
  }
  if (!(options.largest_edge >= options.smallest_edge && options.largest_edge <= 1.0))
  {
    return out_of_range("largest_edge", "from smallest_edge to 1", options.largest_edge);
  }
  if (!(options.tet_limit >= 1000.0))
  {
    return out_of_range("tet_limit", "at least 1000", options.tet_limit);
  }
  if (!(options.maximum_thin_fraction >= 0.0 && options.maximum_thin_fraction <= 1.0))
  {
    return out_of_range("maximum_thin_fraction", "from 0 to 1", options.maximum_thin_fraction);
  }
  Status limits = check_limits(options.time_limit, options.memory_limit);
  if (!limits.ok())
  {
    return limits;
  }
  if (triangles.rows() == 0)
  {
    return Status::invalid_input("the surface has no triangles");
  }
  if (!(bounding_box(points, triangles).diagonal() > 0.0))
  {
    return Status::invalid_input("all points of the surface coincide");
  }
  return {};
}

using IdsByPosition = std::map<std::array<double, 3>, Index>;

/// Map coordinates to vertex ids. If several vertices have the same coordinates, the lowest id is
/// used.
IdsByPosition ids_by_position(PointsView points, TrianglesView triangles)
{
  IdsByPosition ids;
  for (Index k = 0; k < triangles.size(); ++k)
  {
    const Index v = triangles.data()[k];
    const auto [entry, is_new] =
      ids.emplace(std::array<double, 3>{ points(v, 0), points(v, 1), points(v, 2) }, v);
    entry->second = std::min(entry->second, v);
  }
  return ids;
}

bool improve(ExecutionContext& context, const IdsByPosition& ids, const RegionBoundary& region,
  MesherResult& answer)
{
  MesherData& data = answer.data;
  for (Index t = 0; t < data.tets.rows(); ++t)
  {
    if (tet_volume(data.points.row(data.tets(t, 0)), data.points.row(data.tets(t, 1)),
          data.points.row(data.tets(t, 2)), data.points.row(data.tets(t, 3))) < 0.0)
    {
      std::swap(data.tets(t, 0), data.tets(t, 1));
    }
  }
  std::vector<char> fixed(static_cast<std::size_t>(data.points.rows()));
  for (Index v = 0; v < data.points.rows(); ++v)
  {
    fixed[v] = ids.count({ data.points(v, 0), data.points(v, 1), data.points(v, 2) }) > 0;
  }
  const Phase phase(context, "improve", 0.8, 0.9);
  TetMesh mesh{ std::move(data.points), std::move(data.tets) };
  Improvement improvement;
  const bool completed = improve_tets(
    context, mesh, std::move(fixed),
    [&](Vec3& p, const Vec3& n, double reach) { return region.project_to_boundary(p, n, reach); },
    ImproveOptions(), improvement);
  data.points = std::move(mesh.points);
  data.tets = std::move(mesh.tets);
  return completed;
}

/// Remove unused vertices and renumber the others so that the input's vertices come first.
void number_vertices(const IdsByPosition& ids, const MesherData& data, RemeshResult& result)
{
  constexpr Index unused = -2;
  std::vector<Index> original(static_cast<std::size_t>(data.points.rows()), unused);
  for (Index k = 0; k < data.tets.size(); ++k)
  {
    const Index v = data.tets.data()[k];
    const auto entry = ids.find({ data.points(v, 0), data.points(v, 1), data.points(v, 2) });
    original[v] = entry == ids.end() ? -1 : entry->second;
  }
  std::vector<Index> order(original.size());
  std::iota(order.begin(), order.end(), Index(0));
  order.erase(
    std::remove_if(order.begin(), order.end(), [&](Index v) { return original[v] == unused; }),
    order.end());
  std::stable_sort(order.begin(), order.end(),
    [&](Index a, Index b)
    {
      const bool a_is_original = original[a] >= 0;
      const bool b_is_original = original[b] >= 0;
      return a_is_original != b_is_original ? a_is_original
                                            : a_is_original && original[a] < original[b];
    });
  std::vector<Index> number(original.size(), -1);
  result.mesh.points.resize(static_cast<Index>(order.size()), 3);
  result.original_vertices.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    number[order[i]] = static_cast<Index>(i);
    result.mesh.points.row(static_cast<Index>(i)) = data.points.row(order[i]);
    result.original_vertices[i] = original[order[i]];
  }
  result.mesh.tets.resize(data.tets.rows(), 4);
  for (Index k = 0; k < data.tets.size(); ++k)
  {
    result.mesh.tets.data()[k] = number[data.tets.data()[k]];
  }
}
} // namespace

Status remesh_tets(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const WindingNumber& winding, const RemeshOptions& options, RemeshResult& result)
{
  result = RemeshResult();
  Status status = check_input(points, triangles, options);
  if (!status.ok())
  {
    return status;
  }
  const RegionBoundary region(points, triangles, winding, options.winding_threshold);
  const double diagonal = region.box().diagonal();
  MesherRequest request;
  request.arguments = { "remesh", "--threshold", exact_number(options.winding_threshold),
    "--smallest", exact_number(options.smallest_edge * diagonal), "--largest",
    exact_number(options.largest_edge * diagonal), "--tets", exact_number(options.tet_limit),
    "--thin", exact_number(options.maximum_thin_fraction) };
  request.time_limit = options.time_limit;
  request.memory_limit = options.memory_limit;
  MesherResult answer;
  {
    const Phase phase(context, "remesh", 0.0, 0.8);
    MesherData data;
    data.points = points;
    data.triangles = triangles;
    status = run_mesher(context, request, data, answer);
  }
  if (!status.ok())
  {
    status.report = answer.report; // contains thin_fraction
    return status;
  }
  if (answer.data.tets.rows() == 0)
  {
    return Status::invalid_input(
      "the surface encloses nothing: no triangle separates winding numbers above and below the "
      "threshold of " +
      short_number(options.winding_threshold) +
      " (tested 1e-6 bounding-box diagonals from each triangle)");
  }
  const IdsByPosition ids = ids_by_position(points, triangles);
  if (!improve(context, ids, region, answer))
  {
    return Status::canceled();
  }
  number_vertices(ids, answer.data, result);
  status = check_tets(result.mesh.points, result.mesh.tets);
  if (!status.ok())
  {
    result = RemeshResult();
    return status;
  }
  status.report = answer.report;
  result.boundary_vertices =
    static_cast<Index>(answer.report.number("counts.boundary_vertices", 0.0));
  status.report.set("counts.boundary_vertices", Report::Value(result.boundary_vertices));
  const Phase phase(context, "distance", 0.9, 1.0);
  if (!measure_distance(context, result.mesh, region, result.distance))
  {
    result = RemeshResult();
    return Status::canceled();
  }
  status.report.set("distance_max", Report::Value(100.0 * result.distance.maximum / diagonal));
  status.report.set("distance_mean", Report::Value(100.0 * result.distance.mean / diagonal));
  return status;
}

} // namespace bindpose
