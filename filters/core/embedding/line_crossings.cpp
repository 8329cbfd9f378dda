// Crossings of a triangle with the lines between samples (see line_crossings.h). The triangle is
// projected along the axis and processed row by row. For every line in the projection's range, the
// exact signs of three areas determine whether the line crosses the triangle.
#include "embedding/line_crossings.h"

#include "geometry/exact.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
using Key = LineCrossing::Key;

Key line_key(int axis, const CubeSamples::Sample& s)
{
  return ((static_cast<Key>(axis) << 20 | static_cast<Key>(s[2])) << 20 | static_cast<Key>(s[1]))
    << 20 |
    static_cast<Key>(s[0]);
}
} // namespace

Vec3 LineCrossing::position(double along_line) const
{
  const Sample s = this->sample();
  Vec3 position = CubeSamples::lattice_position(s);
  position[this->axis()] = (s[this->axis()] + along_line + CubeSamples::shift[this->axis()]) /
    CubeSamples::samples_per_edge;
  return position;
}

void add_line_crossings(
  LatticeCover::Id triangle, std::array<Vec3, 3> corner, int axis, std::vector<LineCrossing>& list)
{
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  for (Vec3& p : corner)
  {
    p = CubeSamples::samples_per_edge * p -
      Vec3(CubeSamples::shift[0], CubeSamples::shift[1], CubeSamples::shift[2]);
  }
  const int orientation = orientation_2d(
    corner[0][u], corner[0][v], corner[1][u], corner[1][v], corner[2][u], corner[2][v]);
  if (orientation == 0)
  {
    // The triangle is parallel to the axis: the lines cross the neighboring triangles instead.
    return;
  }
  const auto range = [&](int k) {
    return std::minmax({ corner[0][k], corner[1][k], corner[2][k] });
  };
  const auto [lowest, highest] = range(v);
  const auto [left, right] = range(u);
  const auto [near, far] = range(axis);
  constexpr double slack = 1e-6;
  for (double y = std::ceil(lowest); y <= highest; y += 1.0)
  {
    double from = right;
    double to = left;
    for (int k = 0; k < 3; ++k)
    {
      const Vec3& p = corner[k];
      const Vec3& q = corner[(k + 1) % 3];
      if (std::min(p[v], q[v]) <= y && y <= std::max(p[v], q[v]))
      {
        const double t = p[v] == q[v] ? 0.0 : (y - p[v]) / (q[v] - p[v]);
        const double x = p[u] + t * (q[u] - p[u]);
        from = std::min({ from, x, p[v] == q[v] ? q[u] : x });
        to = std::max({ to, x, p[v] == q[v] ? q[u] : x });
      }
    }
    for (double x = std::ceil(from - slack); x <= to + slack; x += 1.0)
    {
      bool hit = true;
      double depth = 0.0;
      double area = 0.0;
      for (int k = 0; k < 3 && hit; ++k)
      {
        const Vec3& p = corner[(k + 1) % 3];
        const Vec3& q = corner[(k + 2) % 3];
        hit = orientation * orientation_2d(p[u], p[v], q[u], q[v], x, y) >= 0;
        const double part = std::abs((p[u] - x) * (q[v] - y) - (q[u] - x) * (p[v] - y));
        area += part;
        depth += part * corner[k][axis];
      }
      if (hit)
      {
        const double z = area > 0.0 ? std::clamp(depth / area, near, far) : near;
        CubeSamples::Sample s{};
        s[axis] = static_cast<LatticeCover::Id>(std::floor(z));
        s[u] = static_cast<LatticeCover::Id>(x);
        s[v] = static_cast<LatticeCover::Id>(y);
        list.push_back({ line_key(axis, s), z - std::floor(z), triangle });
      }
    }
  }
}

} // namespace bindpose
