// Flux of piecewise linear functions through sides of triangles.
#include "geometry/side_flux.h"

#include <cmath>

namespace bindpose
{

SparseMatrix side_flux(
  PointsView points, TrianglesView triangles, const std::vector<TriangleSide>& sides)
{
  std::vector<Eigen::Triplet<double, int>> entries;
  for (const TriangleSide& side : sides)
  {
    const Index t = side.triangle;
    const int k = (side.corner + 2) % 3; // corner opposite to the edge
    const Vec3 p[3] = { points.row(triangles(t, 0)), points.row(triangles(t, 1)),
      points.row(triangles(t, 2)) };
    // The length of the normal is twice the area.
    const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
    const double squared = normal.squaredNorm();
    if (!(squared > 0.0))
    {
      continue;
    }
    const Vec3 unit = normal / std::sqrt(squared);
    // The length of `outwards` is the length of the edge.
    const Vec3 outwards = (p[(k + 2) % 3] - p[(k + 1) % 3]).cross(unit);
    for (Index c = 0; c < 3; ++c)
    {
      const Vec3 gradient = normal.cross(p[(c + 2) % 3] - p[(c + 1) % 3]) / squared;
      const double half = 0.5 * outwards.dot(gradient);
      for (const int end : { (k + 1) % 3, (k + 2) % 3 })
      {
        entries.emplace_back(
          static_cast<int>(triangles(t, end)), static_cast<int>(triangles(t, c)), half);
      }
    }
  }
  SparseMatrix flux(points.rows(), points.rows());
  flux.setFromTriplets(entries.begin(), entries.end());
  return flux;
}

} // namespace bindpose
