// Intersections of rays with a surface (see surface_probe.h). A ray is represented by a segment
// that ends outside the surface's bounding box. The intersection test is exact, so a ray cannot
// pass between adjacent triangles. The position of the intersection is computed in double
// precision.
#include "surface/surface_probe.h"

#include "surface/triangle_predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{
namespace
{
/// Hits count as one if their distance is at most this fraction of the segment's length.
constexpr double same_hit = 1e-9;
} // namespace

SurfaceProbe::SurfaceProbe(PointsView points, TrianglesView triangles)
  : points_(points), triangles_(triangles), tree_(points, triangles), box_(bounding_box(points))
{
}

std::vector<SurfaceProbe::Hit> SurfaceProbe::hits(const Vec3& origin, const Vec3& direction) const
{
  std::vector<Hit> all;
  const double speed = direction.norm();
  if (this->box_.empty() || !(speed > 0.0) || !origin.allFinite() || !direction.allFinite())
  {
    return all;
  }
  const double end_parameter =
    1.01 * ((this->box_.center() - origin).norm() + this->box_.diagonal()) / speed;
  const Vec3 end = origin + end_parameter * direction;
  const auto add_hit = [&](Index f)
  {
    const auto t = this->triangles_.row(f);
    const Vec3 a = this->points_.row(t[0]);
    const Vec3 b = this->points_.row(t[1]);
    const Vec3 c = this->points_.row(t[2]);
    const Vec3 normal = (b - a).cross(c - a);
    const double slope = normal.dot(direction);
    const double distance = normal.dot(a - origin) / slope;
    if (slope != 0.0 && std::isfinite(distance) && segment_meets_triangle(origin, end, a, b, c))
    {
      all.push_back({ std::max(distance, 0.0), f, slope < 0.0 });
    }
    return false; // false: continue with the next triangle
  };
  this->tree_.segment_meets(origin, end, add_hit);
  std::sort(all.begin(), all.end(),
    [](const Hit& a, const Hit& b)
    { return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle; });
  // At a shared edge or vertex, several triangles report the same intersection.
  std::vector<Hit> unique_hits;
  for (const Hit& hit : all)
  {
    const bool is_duplicate = std::any_of(unique_hits.rbegin(), unique_hits.rend(),
      [&](const Hit& other)
      {
        return other.enters == hit.enters &&
          hit.distance - other.distance <= same_hit * end_parameter;
      });
    if (!is_duplicate)
    {
      unique_hits.push_back(hit);
    }
  }
  return unique_hits;
}

bool SurfaceProbe::first_inside(const Vec3& origin, const Vec3& direction, LineSpan& span) const
{
  const std::vector<Hit> all = this->hits(origin, direction);
  if (all.empty())
  {
    return false;
  }
  const auto set = [&](const Hit& from, const Hit& to)
  {
    span.entry = origin + from.distance * direction;
    span.exit = origin + to.distance * direction;
    span.triangle = from.triangle;
  };
  const double same_hit_distance = same_hit * std::max(all.back().distance, 1.0);
  int depth = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (depth == 0)
    {
      first = i;
    }
    depth += all[i].enters ? 1 : -1;
    // At a silhouette edge, entry and exit coincide and enclose no interval.
    if (depth == 0 && all[i].distance - all[first].distance > same_hit_distance)
    {
      set(all[first], all[i]);
      return true;
    }
  }
  set(all[0], all[all.size() > 1 ? 1 : 0]);
  return true;
}

bool SurfaceProbe::nearest(const Vec3& p, Vec3& nearest_point) const
{
  return std::isfinite(
    this->tree_.distance(p, std::numeric_limits<double>::infinity(), &nearest_point));
}

} // namespace bindpose
