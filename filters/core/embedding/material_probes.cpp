// Tests of straight segments through the material (see material_probes.h). Triangles that cross a
// segment divide it into intervals. The segment is in the material if the winding number reaches
// the threshold everywhere in each interval. Near the openings of a surface, the winding number
// varies within an interval. Therefore each interval is tested at several points.
#include "embedding/material_probes.h"

#include "base/disjoint_sets.h"
#include "base/sort_unique.h"
#include "embedding/cube_samples.h"
#include "embedding/line_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace bindpose
{

namespace
{
/// Intersect the segment from a to b with a triangle; `at` is set to the position of the
/// intersection, as a fraction of the segment. Hits slightly outside of the triangle count too,
/// because an additional cut is harmless.
bool find_intersection(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t, double& at)
{
  const Vec3 u = t[1] - t[0];
  const Vec3 v = t[2] - t[0];
  const Vec3 d = b - a;
  const Vec3 n = u.cross(v);
  const double denominator = -n.dot(d);
  if (denominator == 0.0)
  {
    return false;
  }
  const Vec3 p = a - t[0];
  const Vec3 e = p.cross(d);
  constexpr double slack = 1e-9;
  const double s = v.dot(e) / denominator;
  const double r = -u.dot(e) / denominator;
  at = n.dot(p) / denominator;
  return s >= -slack && r >= -slack && s + r <= 1.0 + slack && at > 0.0 && at < 1.0;
}

/// Report whether a direction is parallel to the plane with the unit normal `normal`, up to
/// rounding errors. Return false for a zero normal.
bool is_parallel(const Vec3& normal, const Vec3& direction)
{
  constexpr double rounding = 1e-9;
  return std::abs(normal.dot(direction)) < rounding * direction.norm() && !normal.isZero(0.0);
}
} // namespace

bool MaterialProbes::stays_inside(
  const Vec3& a, const Vec3& b, const std::vector<Id>& triangles, std::vector<double>& cuts) const
{
  const double length = (b - a).norm();
  const auto inside_at = [&](double t)
  {
    const Vec3 p = this->cover_.lattice.world_point(a + t * (b - a));
    return this->winding_.evaluate_at(p) >= this->threshold_;
  };
  // Position of a test point, as a fraction of its interval. The middle (0.5) is avoided: in
  // symmetric models, it is often on a triangle or on a cap of an opening, where the evaluation of
  // a winding number takes at least a hundred times longer.
  constexpr double near_middle = 0.4717;
  // Most probes are rejected by this test.
  if (length > LineCrossing::merge_distance && !inside_at(near_middle))
  {
    return false;
  }
  cuts.assign({ 0.0, 1.0 });
  for (const Id f : triangles)
  {
    double at = 0.0;
    if (find_intersection(a, b, this->cover_.corners_of(f), at))
    {
      cuts.push_back(at);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  constexpr double tests_per_cube = 2.0 * CubeSamples::samples_per_edge;
  for (std::size_t i = 1; i < cuts.size(); ++i)
  {
    const double interval = cuts[i] - cuts[i - 1];
    if (interval * length <= LineCrossing::merge_distance)
    {
      continue;
    }
    const int tests = static_cast<int>(std::ceil(interval * length * tests_per_cube));
    for (int k = 0; k < tests; ++k)
    {
      if (!inside_at(cuts[i - 1] + interval * (k + near_middle) / tests))
      {
        return false;
      }
    }
  }
  return true;
}

bool MaterialProbes::connects(
  const End& from, const End& to, const std::vector<Id>& triangles, std::vector<double>& cuts) const
{
  const Vec3 direction = to.position - from.position;
  constexpr double shift = 1e-6;
  for (const End& end : { from, to })
  {
    if (is_parallel(end.normal, direction))
    {
      const Vec3 aside = shift * end.normal;
      return this->stays_inside(from.position - aside, to.position - aside, triangles, cuts) ||
        this->stays_inside(from.position + aside, to.position + aside, triangles, cuts);
    }
  }
  return this->stays_inside(from.position, to.position, triangles, cuts);
}

bool MaterialProbes::connects(const std::vector<End>& from, const std::vector<End>& to,
  const std::vector<Id>& triangles, std::vector<double>& cuts) const
{
  struct Probe
  {
    double squared_length;
    std::size_t from, to;
    bool operator<(const Probe& other) const
    {
      return std::tie(this->squared_length, this->from, this->to) <
        std::tie(other.squared_length, other.from, other.to);
    }
  };
  std::vector<Probe> lines;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    for (std::size_t j = 0; j < to.size(); ++j)
    {
      lines.push_back({ (from[i].position - to[j].position).squaredNorm(), i, j });
    }
  }
  constexpr std::size_t maximum_probes = 12;
  const std::size_t count = std::min(lines.size(), maximum_probes);
  std::partial_sort(lines.begin(), lines.begin() + static_cast<Index>(count), lines.end());
  lines.resize(count);
  return std::any_of(lines.begin(), lines.end(),
    [&](const Probe& line)
    { return this->connects(from[line.from], to[line.to], triangles, cuts); });
}

void MaterialProbes::connect(
  std::vector<Side> sides, std::vector<Id> triangles, std::vector<std::pair<Id, Id>>& joined) const
{
  sort_unique(triangles);
  constexpr std::size_t maximum_ends = 40;
  for (Side& side : sides)
  {
    const std::size_t count = side.ends.size();
    for (std::size_t i = 0; i < maximum_ends && count > maximum_ends; ++i)
    {
      side.ends[i] = side.ends[i * count / maximum_ends];
    }
    side.ends.resize(std::min(count, maximum_ends));
  }
  std::vector<double> cuts;
  DisjointSets<Id> sides_joined(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    for (std::size_t j = i + 1; j < sides.size(); ++j)
    {
      const auto a = static_cast<Id>(i);
      const auto b = static_cast<Id>(j);
      if (sides_joined.find(a) != sides_joined.find(b) &&
        this->connects(sides[i].ends, sides[j].ends, triangles, cuts))
      {
        sides_joined.unite(a, b);
        joined.emplace_back(sides[i].root, sides[j].root);
      }
    }
  }
}

} // namespace bindpose
