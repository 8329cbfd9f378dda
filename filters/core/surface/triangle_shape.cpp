// Angles of triangles (see triangle_shape.h).
#include "surface/triangle_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bindpose
{

double smallest_triangle_angle(const Vec3& a, const Vec3& b, const Vec3& c)
{
  constexpr double degrees = 57.295779513082320877;
  const std::array<Vec3, 3> p{ a, b, c };
  double smallest = 180.0;
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 u = p[(k + 1) % 3] - p[k];
    const Vec3 v = p[(k + 2) % 3] - p[k];
    smallest = std::min(smallest, degrees * std::atan2(u.cross(v).norm(), u.dot(v)));
  }
  return smallest;
}

Index count_needles(PointsView points, TrianglesView triangles, double angle)
{
  Index count = 0;
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    count += smallest_triangle_angle(points.row(triangles(t, 0)), points.row(triangles(t, 1)),
               points.row(triangles(t, 2))) < angle;
  }
  return count;
}

} // namespace bindpose
