// Distance between the boundary of tets and a surface, measured in both directions from sample
// points by nearest-point queries.
#include "inside/surface_distance.h"

#include "base/parallel.h"
#include "surface/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
/// A sample point and its weight, which is the area that it represents. Samples with weight 0 are
/// skipped.
struct Sample
{
  Vec3 point = Vec3::Zero();
  double weight = 0.0;
};

/// Collect the center and the corners of each triangle as samples. The center represents two thirds
/// of the triangle's area, and the three corners together represent one third.
template <typename AtCenter, typename AtCorner>
bool collect_samples(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const AtCenter& at_center, const AtCorner& at_corner, std::vector<Sample>& samples)
{
  const Index n = triangles.rows();
  samples.assign(static_cast<std::size_t>(n + points.rows()), Sample());
  std::vector<std::array<bool, 3>> corners(static_cast<std::size_t>(n));
  constexpr Index block = 64;
  const bool completed = parallel_for(context, n, block,
    [&](Index begin, Index end)
    {
      for (Index f = begin; f < end; ++f)
      {
        const Vec3 a = points.row(triangles(f, 0));
        const Vec3 b = points.row(triangles(f, 1));
        const Vec3 c = points.row(triangles(f, 2));
        const Vec3 center = (a + b + c) / 3.0;
        const bool is_counted = at_center(f, center);
        samples[f] = { center, is_counted ? (b - a).cross(c - a).norm() / 3.0 : 0.0 };
        for (int k = 0; k < 3; ++k)
        {
          corners[f][k] = at_corner(f, k, is_counted);
        }
      }
    });
  for (Index f = 0; f < n && completed; ++f)
  {
    const Vec3 a = points.row(triangles(f, 0));
    const Vec3 b = points.row(triangles(f, 1));
    const Vec3 c = points.row(triangles(f, 2));
    for (int k = 0; k < 3; ++k)
    {
      Sample& sample = samples[n + triangles(f, k)];
      sample.point = points.row(triangles(f, k));
      sample.weight += corners[f][k] ? (b - a).cross(c - a).norm() / 18.0 : 0.0;
    }
  }
  return completed;
}

bool measure(ExecutionContext& context, const std::vector<Sample>& samples,
  const TriangleTree& tree, SurfaceDistance& distance)
{
  std::vector<double> distances(samples.size(), 0.0);
  constexpr Index block = 64;
  const bool completed = parallel_for(context, static_cast<Index>(samples.size()), block,
    [&](Index begin, Index end)
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      double limit = infinity;
      Vec3 last = Vec3::Zero();
      for (Index i = begin; i < end; ++i)
      {
        if (samples[i].weight > 0.0)
        {
          // The distance to the surface increases by at most the distance between this sample and
          // the last one. This gives a limit for the search. If rounding errors exclude the nearest
          // triangle, search without a limit.
          limit += (samples[i].point - last).norm();
          distances[i] = tree.distance(samples[i].point, limit);
          if (distances[i] == infinity)
          {
            distances[i] = tree.distance(samples[i].point, infinity);
          }
          limit = distances[i];
          last = samples[i].point;
        }
      }
    });
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    sum += samples[i].weight > 0.0 ? samples[i].weight * distances[i] : 0.0;
    weights += samples[i].weight;
    distance.samples += samples[i].weight > 0.0;
    distance.maximum = std::max(distance.maximum, distances[i]);
  }
  distance.mean = std::max(distance.mean, weights > 0.0 ? sum / weights : 0.0);
  return completed;
}

/// Finds the parts of the tets' boundary that close holes of the surface ("caps").
class HoleCaps
{
public:
  HoleCaps(const RegionBoundary& region, const TriangleTree& tree) : region_(region), tree_(tree) {}

  /// Report whether p is on a cap: the region ends within the distance `reach` of p along the
  /// normal n, and there is no triangle at this end.
  bool is_on_cap(const Vec3& p, const Vec3& n, double reach) const
  {
    const double maximum_distance = 1e-4 * this->region_.box().diagonal();
    constexpr double error_fraction = 0.1;
    const double bisections = std::log2(std::max(1.0, reach / (error_fraction * maximum_distance)));
    Vec3 end = p;
    if (!this->region_.project_to_boundary(end, n, reach, static_cast<int>(std::ceil(bisections))))
    {
      return false;
    }
    return !this->tree_.is_within(end, maximum_distance);
  }

private:
  const RegionBoundary& region_;
  const TriangleTree& tree_;
};
} // namespace

bool measure_distance(ExecutionContext& context, const TetMesh& mesh, const RegionBoundary& region,
  SurfaceDistance& distance)
{
  distance = SurfaceDistance();
  const Triangles boundary = boundary_triangles(mesh.tets);
  if (boundary.rows() == 0 || region.triangles().rows() == 0)
  {
    distance.maximum = distance.mean = std::numeric_limits<double>::infinity();
    return true;
  }
  const TriangleTree surface_tree(region.points(), region.triangles());
  const TriangleTree boundary_tree(mesh.points, boundary);
  std::vector<Sample> samples;
  {
    const ProgressRange range(context, 0.0, 0.5);
    if (!collect_samples(
          context, region.points(), region.triangles(),
          [&](Index f, const Vec3& center) { return region.bounds_region_at(f, center); },
          [&](Index f, int k, bool) { return region.bounded_at_corner(f, k); }, samples) ||
      !measure(context, samples, boundary_tree, distance))
    {
      return false;
    }
  }
  const ProgressRange range(context, 0.5, 1.0);
  const HoleCaps hole_caps(region, surface_tree);
  const bool may_have_caps = !region.closed();
  const auto on_surface = [&](Index f, const Vec3& center)
  {
    if (!may_have_caps)
    {
      return true;
    }
    const Vec3 a = mesh.points.row(boundary(f, 0));
    const Vec3 b = mesh.points.row(boundary(f, 1));
    const Vec3 c = mesh.points.row(boundary(f, 2));
    const double size = std::sqrt(std::max((b - a).squaredNorm(), (c - a).squaredNorm()));
    return !hole_caps.is_on_cap(center, (b - a).cross(c - a).normalized(), 0.5 * size);
  };
  // A vertex is a sample if one of its triangles is not part of a cap. This includes the vertices
  // at the border of a cap, which is acceptable because the surface is near them.
  return collect_samples(
           context, mesh.points, boundary, on_surface,
           [](Index, int, bool is_counted) { return is_counted; }, samples) &&
    measure(context, samples, surface_tree, distance);
}

} // namespace bindpose
