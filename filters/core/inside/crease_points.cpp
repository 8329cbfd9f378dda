// Creases of a surface, and points along long creases. A crease is an edge that bounds the enclosed
// region and is sharp, open or non-manifold.
#include "inside/crease_points.h"

#include "geometry/triangle_sides.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
double cosine(double degrees)
{
  return std::cos(degrees / 57.295779513082320877);
}

/// Report whether a triangle bounds the region at the edge that `side` specifies. The test point is
/// near the middle of the edge, inside the triangle.
bool is_boundary_side(const RegionBoundary& region, const TriangleSide& side)
{
  const Vec3 middle = 0.5 *
    (region.corner(side.triangle, side.corner) +
      region.corner(side.triangle, (side.corner + 1) % 3));
  const Vec3 apex = region.corner(side.triangle, (side.corner + 2) % 3);
  constexpr double inward_fraction = 0.02;
  return region.bounds_region_at(
    side.triangle, (1.0 - inward_fraction) * middle + inward_fraction * apex);
}
} // namespace

CreasePoints find_creases(const RegionBoundary& region, const SizingField& field, double angle)
{
  const std::vector<TriangleSide> sides = sides_by_edge(region.triangles());
  const double smooth = cosine(angle);
  // The crease edges as pairs of vertex ids. Each edge is stored in both directions.
  std::vector<std::pair<Index, Index>> ends;
  std::vector<Vec3> edge_points;
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j)
  {
    j = end_of_edge(sides, i);
    if (j - i == 2 &&
      region.normal(sides[i].triangle).dot(region.normal(sides[i + 1].triangle)) > smooth)
    {
      continue;
    }
    if (std::none_of(sides.begin() + static_cast<std::ptrdiff_t>(i),
          sides.begin() + static_cast<std::ptrdiff_t>(j),
          [&](const TriangleSide& side) { return is_boundary_side(region, side); }))
    {
      continue;
    }
    ends.emplace_back(sides[i].a, sides[i].b);
    ends.emplace_back(sides[i].b, sides[i].a);
    const Vec3 a = region.points().row(sides[i].a);
    const Vec3 b = region.points().row(sides[i].b);
    constexpr double maximum = 1000.0;
    // The spacing is smaller than the requested length, so that few facets of the tets cross the
    // crease.
    constexpr double spacing_factor = 0.7;
    const double length =
      spacing_factor * std::min({ field.at(a), field.at(b), field.at(0.5 * (a + b)) });
    const double parts = std::min(std::ceil((b - a).norm() / length), maximum);
    for (double part = 1.0; part < parts; ++part)
    {
      edge_points.emplace_back(a + part / parts * (b - a));
    }
  }
  CreasePoints creases;
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0, j = 0; i < ends.size(); i = j)
  {
    const Index v = ends[i].first;
    while (j < ends.size() && ends[j].first == v)
    {
      ++j;
    }
    bool straight = j - i == 2;
    if (straight)
    {
      const Vec3 p = region.points().row(v);
      const Vec3 before = region.points().row(ends[i].second);
      const Vec3 after = region.points().row(ends[i + 1].second);
      straight = (p - before).normalized().dot((after - p).normalized()) > smooth;
    }
    (straight ? creases.vertices : creases.corners).push_back(v);
  }
  creases.edge_points.resize(static_cast<Index>(edge_points.size()), 3);
  for (std::size_t i = 0; i < edge_points.size(); ++i)
  {
    creases.edge_points.row(static_cast<Index>(i)) = edge_points[i];
  }
  return creases;
}

} // namespace bindpose
