// Tests whether triangles bound the region {winding number >= threshold}, by winding numbers at
// points on both sides of a triangle. The thickness of the region is measured by sampling along the
// normal.
#include "segmentation/region_boundary.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

RegionBoundary::RegionBoundary(
  PointsView points, TrianglesView triangles, const WindingNumber& winding, double threshold)
  : points_(points), triangles_(triangles), winding_(winding), threshold_(threshold),
    box_(bounding_box(points, triangles)), step_(1e-6 * box_.diagonal()),
    closed_(winding.status().report.number("counts.open_edges", 1.0) == 0.0)
{
}

bool RegionBoundary::contains(const Vec3& p) const
{
  return (p.array() >= this->box_.lower.array()).all() &&
    (p.array() <= this->box_.upper.array()).all() &&
    this->winding_.evaluate_at(p) >= this->threshold_;
}

Vec3 RegionBoundary::normal(Index f) const
{
  const Vec3 a = this->corner(f, 0);
  const Vec3 n = (this->corner(f, 1) - a).cross(this->corner(f, 2) - a);
  const double length = n.norm();
  return length > 0.0 ? Vec3(n / length) : Vec3::Zero();
}

bool RegionBoundary::bounds_region_at(Index f, const Vec3& p) const
{
  const Vec3 step = this->step_ * this->normal(f);
  return this->contains(p + step) != this->contains(p - step);
}

bool RegionBoundary::bounded_at_corner(Index f, int k) const
{
  // The test point is far enough inside the triangle to be clearly on one side of the triangle's
  // edges, and near enough to the corner to represent it.
  constexpr double inward_fraction = 0.02;
  const Vec3 center = (this->corner(f, 0) + this->corner(f, 1) + this->corner(f, 2)) / 3.0;
  return this->bounds_region_at(
    f, (1.0 - inward_fraction) * this->corner(f, k) + inward_fraction * center);
}

double RegionBoundary::thickness(Index f, const Vec3& p, double smallest, double largest) const
{
  const Vec3 n = this->normal(f);
  const bool is_inside_behind = this->contains(p - this->step_ * n);
  constexpr double growth = 1.5;
  for (double distance = smallest; distance < largest; distance *= growth)
  {
    if (this->contains(p - distance * n) != is_inside_behind ||
      this->contains(p + distance * n) == is_inside_behind)
    {
      return distance;
    }
  }
  return largest;
}

bool RegionBoundary::project_to_boundary(Vec3& p, const Vec3& n, double reach, int bisections) const
{
  double inside = -reach;
  double outside = reach;
  if (!this->contains(p + inside * n) || this->contains(p + outside * n))
  {
    return false;
  }
  for (int k = 0; k < bisections; ++k)
  {
    const double middle = 0.5 * (inside + outside);
    (this->contains(p + middle * n) ? inside : outside) = middle;
  }
  p += 0.5 * (inside + outside) * n;
  return true;
}

namespace
{
struct Site
{
  Vec3 point;
  double length, area, thickness;
};

/// Place points on a triangle, at most about `spacing` apart, in rows parallel to its shortest
/// edge.
template <typename Visit>
void sample_triangle(const RegionBoundary& region, Index f, double spacing, const Visit& found)
{
  int shortest = 0;
  double shortest_length = 0.0, longest = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const double length = (region.corner(f, (k + 1) % 3) - region.corner(f, (k + 2) % 3)).norm();
    if (k == 0 || length < shortest_length)
    {
      shortest_length = length;
      shortest = k;
    }
    longest = std::max(longest, length);
  }
  const Vec3 apex = region.corner(f, shortest);
  const Vec3 a = region.corner(f, (shortest + 1) % 3) - apex;
  const Vec3 b = region.corner(f, (shortest + 2) % 3) - apex;
  constexpr double maximum_subdivisions = 100.0;
  const double rows = std::min(std::ceil(longest / spacing), maximum_subdivisions);
  const double area = 0.5 * a.cross(b).norm();
  for (double row = 0.0; row < rows; ++row)
  {
    // Points are on the center line of the row. If there is only one row, they are at two thirds of
    // the triangle's height, so that a single point is the triangle's centroid.
    const double t = rows > 1.0 ? (row + 0.5) / rows : 2.0 / 3.0;
    const double columns =
      std::clamp(std::ceil(t * shortest_length / spacing), 1.0, maximum_subdivisions);
    const double point_area = area * (2.0 * row + 1.0) / (rows * rows * columns);
    for (double column = 0.0; column < columns; ++column)
    {
      const double s = (column + 0.5) / columns;
      found(Vec3(apex + t * ((1.0 - s) * a + s * b)), shortest_length, point_area);
    }
  }
}
} // namespace

bool sample_boundary(ExecutionContext& context, const RegionBoundary& region,
  const BoundarySampling& options, BoundarySites& sites)
{
  const TrianglesView triangles = region.triangles();
  const Index block = 64;
  const Index blocks = (triangles.rows() + block - 1) / block;
  std::vector<std::vector<Site>> sites_of_block(static_cast<std::size_t>(blocks));
  std::vector<std::array<double, 3>> corner_lengths(static_cast<std::size_t>(triangles.rows()));
  const bool completed = parallel_for(context, triangles.rows(), block,
    [&](Index begin, Index end)
    {
      for (Index f = begin; f < end; ++f)
      {
        double edge = options.largest;
        sample_triangle(region, f, options.largest,
          [&](const Vec3& p, double shortest, double area)
          {
            edge = shortest;
            if (region.bounds_region_at(f, p))
            {
              const double thickness = region.thickness(f, p, options.smallest, options.largest);
              sites_of_block[begin / block].push_back(
                { p, std::clamp(std::min(edge, thickness), options.smallest, options.largest), area,
                  thickness });
            }
          });
        for (int k = 0; k < 3; ++k)
        {
          corner_lengths[f][k] = region.bounded_at_corner(f, k) ? edge : -1.0;
        }
      }
    });
  if (!completed)
  {
    return false;
  }
  std::vector<double> sum(static_cast<std::size_t>(region.points().rows()), 0.0);
  std::vector<double> count(sum.size(), 0.0);
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      if (corner_lengths[f][k] >= 0.0)
      {
        sum[triangles(f, k)] += corner_lengths[f][k];
        count[triangles(f, k)] += 1.0;
      }
    }
  }
  std::vector<Site> all;
  sites.vertices.clear();
  for (Index v = 0; v < region.points().rows(); ++v)
  {
    if (count[v] > 0.0)
    {
      const double length = std::clamp(sum[v] / count[v], options.smallest, options.largest);
      all.push_back({ region.points().row(v), length, 0.0, options.largest });
      sites.vertices.push_back(v);
    }
  }
  for (const auto& block_sites : sites_of_block)
  {
    all.insert(all.end(), block_sites.begin(), block_sites.end());
  }
  const auto n = static_cast<Index>(all.size());
  sites.points.resize(n, 3);
  sites.lengths.resize(n);
  sites.areas.resize(n);
  sites.thickness.resize(n);
  for (Index i = 0; i < n; ++i)
  {
    sites.points.row(i) = all[i].point;
    sites.lengths[i] = all[i].length;
    sites.areas[i] = all[i].area;
    sites.thickness[i] = all[i].thickness;
  }
  return true;
}

} // namespace bindpose
