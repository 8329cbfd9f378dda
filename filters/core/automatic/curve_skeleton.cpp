// Curve skeletons by mean curvature flow (see curve_skeleton.h). The helper process contracts the
// surface (mesher/skeleton_job.cpp), in coordinates that are centered at the origin. This file
// computes the closed surface that the helper needs, and checks the result. It also computes the
// distance of each skeleton point from the surface, the point's component, and the component's
// centroid.
#include "automatic/curve_skeleton.h"

#include "base/number_text.h"
#include "helper/child_process.h"
#include "helper/mesher_process.h"
#include "inside/prepared_surface.h"
#include "inside/thick_solid.h"
#include "surface/surface_repair.h"
#include "surface/triangle_tree.h"
#include "surface/unit_frame.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

namespace bindpose
{

namespace
{
Status check_options(const CurveSkeletonOptions& options)
{
  constexpr Index minimum = 100;
  constexpr Index maximum = 1000000;
  if (options.triangles < minimum || options.triangles > maximum)
  {
    return Status::invalid_input(
      "skeleton_triangles must be from 100 to 1000000, not " + std::to_string(options.triangles));
  }
  return check_limits(options.time_limit, options.memory_limit);
}

/// A clean surface with more triangles than this factor times CurveSkeletonOptions::triangles is
/// replaced by a closed surface that is built from a lattice. For such surfaces the lattice is
/// faster than decimation.
constexpr Index dense_factor = 10;

/// Compute a closed surface around the volume that the given surface encloses. Hollows are not
/// filled here.
Status close_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const CurveSkeletonOptions& options, TriangleMesh& solid)
{
  PreparedSurface prepared;
  Status status;
  {
    const ProgressRange range(context, 0.0, 0.6);
    status = prepare_surface(context, points, triangles, options.winding_threshold, prepared);
  }
  if (!status.ok())
  {
    return status;
  }
  RepairedSurface& surface = prepared.surface;
  const bool is_clean = surface.is_clean() && surface.found.nonmanifold_edges == 0;
  if (is_clean && surface.triangles.rows() <= dense_factor * options.triangles)
  {
    status.report.set("surface", "clean");
    solid.points = std::move(surface.points);
    solid.triangles = std::move(surface.triangles);
    return status;
  }
  status.warnings = prepared.warnings;
  status.report.merge(prepared.report);
  status.report.set("surface", "lattice");
  ThickSolidOptions thick_options;
  thick_options.winding_threshold = options.winding_threshold;
  // If the surface has defects, join parts that touch or almost touch. If it is clean, keep the
  // gaps between its parts.
  thick_options.join_near_parts = !is_clean;
  thick_options.triangles = (is_clean ? 4 : 2) * options.triangles;
  const ProgressRange range(context, 0.6, 1.0);
  Status solid_status = thick_solid(
    context, surface.points, surface.triangles, prepared.inside.winding(), thick_options, solid);
  status.report.merge(solid_status.report);
  status.code = solid_status.code;
  status.message = solid_status.message;
  return status;
}

/// A component of the closed surface that encloses a positive volume, and the centroid of
/// this volume.
struct Solid
{
  Triangles triangles;
  Vec3 centroid = Vec3::Zero();
};

/// Return the centroid of the volume inside a closed surface. Each triangle, together with one
/// fixed vertex of the surface, forms a tetrahedron. The signed volumes and moments of these
/// tetrahedra are added up.
Vec3 centroid_of_mass(PointsView points, TrianglesView triangles)
{
  const Vec3 apex = points.row(triangles(0, 0));
  Vec3 moment = Vec3::Zero();
  double volume = 0.0;
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    const Vec3 a = points.row(triangles(f, 0)).transpose() - apex;
    const Vec3 b = points.row(triangles(f, 1)).transpose() - apex;
    const Vec3 c = points.row(triangles(f, 2)).transpose() - apex;
    const double cone = a.dot(b.cross(c));
    volume += cone;
    moment += cone * (a + b + c) / 4.0;
  }
  return volume != 0.0 ? Vec3(apex + moment / volume) : apex;
}

/// Return the surface components that enclose a positive volume. Hollows have a negative volume and
/// are omitted.
std::vector<Solid> solids_of(const TriangleMesh& surface)
{
  const Components components =
    connected_components(surface.points.rows(), TrianglesView(surface.triangles));
  std::vector<std::vector<Index>> faces(static_cast<std::size_t>(components.count));
  for (Index f = 0; f < surface.triangles.rows(); ++f)
  {
    faces[components.component_of_vertex[surface.triangles(f, 0)]].push_back(f);
  }
  std::vector<Solid> solids;
  for (const std::vector<Index>& list : faces)
  {
    Solid solid;
    solid.triangles.resize(static_cast<Index>(list.size()), 3);
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      solid.triangles.row(static_cast<Index>(i)) = surface.triangles.row(list[i]);
    }
    if (signed_volume(surface.points, solid.triangles) > 0.0)
    {
      solid.centroid = centroid_of_mass(surface.points, solid.triangles);
      solids.push_back(std::move(solid));
    }
  }
  return solids;
}

/// Return the component of each skeleton point. Components are numbered in the order of their first
/// points.
std::vector<Index> find_parts(const CurveSkeleton& skeleton, Index& count)
{
  std::vector<std::vector<Index>> next(static_cast<std::size_t>(skeleton.points.rows()));
  for (Index s = 0; s < skeleton.segments.rows(); ++s)
  {
    next[skeleton.segments(s, 0)].push_back(skeleton.segments(s, 1));
    next[skeleton.segments(s, 1)].push_back(skeleton.segments(s, 0));
  }
  std::vector<Index> part(next.size(), -1);
  count = 0;
  for (std::size_t first = 0; first < next.size(); ++first)
  {
    if (part[first] >= 0)
    {
      continue;
    }
    std::vector<Index> open{ static_cast<Index>(first) };
    part[first] = count;
    while (!open.empty())
    {
      const Index v = open.back();
      open.pop_back();
      for (const Index w : next[v])
      {
        if (part[w] < 0)
        {
          part[w] = count;
          open.push_back(w);
        }
      }
    }
    ++count;
  }
  return part;
}

/// Compute radii, part_of_point and centroids of the skeleton. For each component of the skeleton,
/// take the point with the largest radius, and find the component of the closed surface nearest to
/// this point. The centroid of this surface component is stored for the skeleton component.
void measure(const TriangleMesh& surface, CurveSkeleton& skeleton)
{
  const double unlimited = std::numeric_limits<double>::infinity();
  const TriangleTree tree(surface.points, surface.triangles);
  skeleton.radii.resize(skeleton.points.rows());
  for (Index v = 0; v < skeleton.points.rows(); ++v)
  {
    skeleton.radii[v] = tree.distance(skeleton.points.row(v), unlimited);
  }
  Index count = 0;
  skeleton.part_of_point = find_parts(skeleton, count);
  std::vector<Index> widest_vertex(static_cast<std::size_t>(count), -1);
  for (Index v = 0; v < skeleton.points.rows(); ++v)
  {
    Index& w = widest_vertex[skeleton.part_of_point[v]];
    w = w < 0 || skeleton.radii[v] > skeleton.radii[w] ? v : w;
  }
  std::vector<double> nearest(widest_vertex.size(), unlimited);
  skeleton.centroids.assign(widest_vertex.size(), Vec3::Zero());
  for (const Solid& solid : solids_of(surface))
  {
    const TriangleTree solid_tree(surface.points, solid.triangles);
    for (std::size_t part = 0; part < widest_vertex.size(); ++part)
    {
      const double distance =
        solid_tree.distance(skeleton.points.row(widest_vertex[part]), unlimited);
      if (distance < nearest[part])
      {
        nearest[part] = distance;
        skeleton.centroids[part] = solid.centroid;
      }
    }
  }
}

/// Remove duplicate segments and segments with two equal ends.
Segments unique_segments(const Segments& segments)
{
  std::set<std::array<Index, 2>> pairs;
  for (Index s = 0; s < segments.rows(); ++s)
  {
    const Index a = segments(s, 0);
    const Index b = segments(s, 1);
    if (a != b)
    {
      pairs.insert({ std::min(a, b), std::max(a, b) });
    }
  }
  Segments result(static_cast<Index>(pairs.size()), 2);
  Index s = 0;
  for (const std::array<Index, 2>& pair : pairs)
  {
    result.row(s++) << pair[0], pair[1];
  }
  return result;
}
} // namespace

Status curve_skeleton(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const CurveSkeletonOptions& options, CurveSkeleton& skeleton, TriangleMesh& solid)
{
  skeleton = CurveSkeleton();
  solid = TriangleMesh();
  Status status = check_options(options);
  if (status.ok())
  {
    status = check_frame(points, triangles);
  }
  if (!status.ok())
  {
    return status;
  }
  const double start = context.elapsed_seconds();
  {
    const Phase phase(context, "close", 0.0, 0.25);
    status = close_surface(context, points, triangles, options, solid);
  }
  if (!status.ok())
  {
    return status;
  }
  const UnitFrame frame(bounding_box(solid.points, solid.triangles));
  MesherRequest request;
  request.arguments = { "skeleton", "--triangles", std::to_string(options.triangles) };
  constexpr double least_seconds = 1.0;
  request.time_limit =
    std::max(options.time_limit - (context.elapsed_seconds() - start), least_seconds);
  request.memory_limit = options.memory_limit;
  MesherResult answer;
  Status contracted;
  {
    const Phase phase(context, "contract", 0.25, 0.98);
    MesherData data;
    data.points = frame.to_frame(solid.points);
    data.triangles = solid.triangles;
    contracted = run_mesher(context, request, data, answer);
  }
  if (!contracted.ok())
  {
    return contracted;
  }
  if (answer.data.points.rows() == 0)
  {
    return Status::failure(StatusCode::internal_error, "the skeleton is empty");
  }
  const Phase phase(context, "measure", 0.98, 1.0);
  skeleton.points = frame.from_frame(answer.data.points);
  skeleton.segments = unique_segments(answer.data.segments);
  measure(solid, skeleton);
  const auto reported = [&](const char* key)
  { return static_cast<Index>(answer.report.number(key, 0.0)); };
  const Index omitted = reported("crumbs") + reported("open");
  status.report.set("counts.parts", reported("parts"));
  status.report.set("counts.contracted_triangles", reported("triangles"));
  status.report.set("counts.iterations", reported("iterations"));
  status.report.set("counts.left_out_parts", omitted);
  if (omitted > 0)
  {
    status.warnings.push_back(std::to_string(omitted) +
      (omitted == 1 ? " component has" : " components have") +
      " no skeleton because a component must be closed and not much smaller than the largest one");
  }
  return status;
}

} // namespace bindpose
