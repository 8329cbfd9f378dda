// Sides of triangles are sorted by the places of their ends; those of one edge then lie next to
// each other. Where more than two meet, each is compared with the next.
#include "scene/silhouette.h"

#include "surface/vertex_order.h"

#include <algorithm>
#include <tuple>

namespace bindpose
{

Silhouette::Silhouette(PointsView points, TrianglesView triangles) : triangles_(triangles)
{
  const std::vector<char> all(static_cast<std::size_t>(points.rows()), 1);
  const std::vector<Index> place = lowest_at_place(points, all);
  struct Half
  {
    Index low, high; ///< lowest points at the places of its ends
    Index triangle;
    Edge points;
    bool upwards;
  };
  std::vector<Half> halves;
  halves.reserve(static_cast<std::size_t>(3 * triangles.rows()));
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Edge ends{ triangles(t, k), triangles(t, (k + 1) % 3) };
      const Index a = place[static_cast<std::size_t>(ends[0])];
      const Index b = place[static_cast<std::size_t>(ends[1])];
      if (a != b)
      {
        halves.push_back({ std::min(a, b), std::max(a, b), t, ends, a < b });
      }
    }
  }
  std::sort(halves.begin(), halves.end(),
    [](const Half& a, const Half& b)
    { return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle); });
  const auto together = [](const Half& a, const Half& b)
  { return a.low == b.low && a.high == b.high; };
  for (std::size_t k = 0; k < halves.size(); ++k)
  {
    const Half& half = halves[k];
    const bool begins = k == 0 || !together(halves[k - 1], half);
    const bool ends = k + 1 == halves.size() || !together(half, halves[k + 1]);
    if (!ends)
    {
      const Half& next = halves[k + 1];
      this->sides_.push_back(
        { half.points, half.triangle, next.triangle, half.upwards == next.upwards });
    }
    else if (begins)
    {
      this->sides_.push_back({ half.points, half.triangle, -1, false });
    }
  }
  this->facing_.resize(static_cast<std::size_t>(triangles.rows()));
}

void Silhouette::find(PointsView points, const Eye& eye, std::vector<Edge>& edges)
{
  const double* place = points.data();
  const auto at = [place](Index v) { return Eigen::Map<const Vec3>(place + 3 * v); };
  for (Index t = 0; t < this->triangles_.rows(); ++t)
  {
    const auto a = at(this->triangles_(t, 0));
    const Vec3 normal = (at(this->triangles_(t, 1)) - a).cross(at(this->triangles_(t, 2)) - a);
    const double towards = eye.parallel ? -normal.dot(eye.direction) : normal.dot(eye.place - a);
    this->facing_[static_cast<std::size_t>(t)] = towards >= 0.0 ? 1 : -1;
  }
  edges.clear();
  for (const Side& side : this->sides_)
  {
    const int one = this->facing_[static_cast<std::size_t>(side.triangle)];
    const int other = side.other < 0 ? -one
      : side.same_way                ? -this->facing_[static_cast<std::size_t>(side.other)]
                                     : this->facing_[static_cast<std::size_t>(side.other)];
    if (one != other)
    {
      edges.push_back(side.points);
    }
  }
}

} // namespace bindpose
