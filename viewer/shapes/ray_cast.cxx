// Finds the first triangle or tet that a ray through a pixel intersects. In the coordinates of the
// ray, a triangle is hit if it contains the origin. The signs of three areas decide this. Triangles
// that share an edge compute the area for this edge from the same coordinates with opposite signs,
// so that a ray through the edge hits at least one of them.
#include "shapes/ray_cast.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{
namespace
{
/// Return twice the signed area of the triangle with corners at the origin, `a` and `b`.
double area(const double* a, const double* b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/// Report whether the ray hits a triangle of transformed points. If so, set the barycentric
/// coordinates and the distance of the hit.
bool hits_triangle(
  const double* a, const double* b, const double* c, Vec3& barycentric, double& distance)
{
  Vec3 areas;
  const bool inside = surrounds_ray(a, b, c, areas);
  const double total_area = areas[0] + areas[1] + areas[2];
  if (!inside || total_area == 0.0)
  {
    return false;
  }
  barycentric = areas / total_area;
  distance = barycentric[0] * a[2] + barycentric[1] * b[2] + barycentric[2] * c[2];
  return distance >= 0.0;
}
} // namespace

bool surrounds_ray(const double* a, const double* b, const double* c, Vec3& areas)
{
  areas = Vec3(area(b, c), area(c, a), area(a, b));
  return (areas.array() >= 0.0).all() || (areas.array() <= 0.0).all();
}

Points to_ray_coordinates(const ViewRay& ray, PointsView points)
{
  const Vec3 across = ray.direction.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << across, ray.direction.cross(across), ray.direction;
  Points ray_points(points.rows(), 3);
  ray_points.noalias() = (points.rowwise() - ray.origin.transpose()) * axes;
  return ray_points;
}

bool first_triangle(const ViewRay& ray, PointsView points, TrianglesView triangles, RayHit& hit)
{
  const Points ray_points = to_ray_coordinates(ray, points);
  hit.element = -1;
  hit.distance = std::numeric_limits<double>::infinity();
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Index* corners = triangles.data() + 3 * t;
    Vec3 barycentric;
    double distance = 0.0;
    if (hits_triangle(ray_points.data() + 3 * corners[0], ray_points.data() + 3 * corners[1],
          ray_points.data() + 3 * corners[2], barycentric, distance) &&
      distance < hit.distance)
    {
      hit = { distance, t, barycentric };
    }
  }
  return hit.element >= 0;
}

bool first_tet(const ViewRay& ray, PointsView points, TetsView tets,
  const std::vector<char>& is_candidate, double size, RayHit& hit)
{
  const Points ray_points = to_ray_coordinates(ray, points);
  hit.element = -1;
  hit.distance = std::numeric_limits<double>::infinity();
  for (Index t = 0; t < tets.rows(); ++t)
  {
    if (!is_candidate[static_cast<std::size_t>(t)])
    {
      continue;
    }
    const Index* corners = tets.data() + 4 * t;
    const double* p[4] = { ray_points.data() + 3 * corners[0], ray_points.data() + 3 * corners[1],
      ray_points.data() + 3 * corners[2], ray_points.data() + 3 * corners[3] };
    const auto misses_ray = [&p](int axis)
    {
      const auto [low, high] = std::minmax({ p[0][axis], p[1][axis], p[2][axis], p[3][axis] });
      return low > 0.0 || high < 0.0;
    };
    if (misses_ray(0) || misses_ray(1))
    {
      // The ray misses this tet, and therefore also the shrunk tet, which is inside of it.
      continue;
    }
    Eigen::Matrix<double, 3, 4> vertices;
    for (int k = 0; k < 4; ++k)
    {
      vertices.col(k) = Eigen::Map<const Vec3>(p[k]);
    }
    const Vec3 middle = vertices.rowwise().mean();
    vertices = (size * (vertices.colwise() - middle)).colwise() + middle;
    for (int k = 0; k < 4; ++k)
    {
      Vec3 barycentric;
      double distance = 0.0;
      if (hits_triangle(vertices.col(k).data(), vertices.col((k + 1) % 4).data(),
            vertices.col((k + 2) % 4).data(), barycentric, distance) &&
        distance < hit.distance)
      {
        hit = { distance, t, Vec3::Zero() };
      }
    }
  }
  return hit.element >= 0;
}

} // namespace bindpose
