#ifndef bindpose_shapes_ray_cast_h
#define bindpose_shapes_ray_cast_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// The ray from the eye through a pixel.
struct ViewRay
{
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ(); ///< unit vector
};

/// Transform points to the coordinates of a ray: two coordinates perpendicular to the ray, which
/// are 0 on the ray, and the distance along the ray.
Points to_ray_coordinates(const ViewRay& ray, PointsView points);

/// Report whether the line of the ray goes through a triangle, in front of or behind the origin of
/// the ray. In the two coordinates perpendicular to the ray, areas[k] is twice the signed area of
/// the triangle whose corners are the origin and the ends of the edge opposite corner k.
/// @param a, b, c  corners of the triangle, in ray coordinates
bool surrounds_ray(const double* a, const double* b, const double* c, Vec3& areas);

/// The first intersection of a ray with a mesh.
struct RayHit
{
  double distance = 0.0; ///< distance from the ray's origin
  Index element = -1; ///< index of the triangle or tet
  Vec3 barycentric = Vec3::Zero(); ///< barycentric coordinates in the triangle; zero for tets
};

/// Find the first triangle that a ray intersects, from either side. Return false if there is none.
/// No search structure is built, so that the shape may change in every call. Each point and each
/// triangle is processed once: 100,000 triangles in 0.4 milliseconds. A ray cannot pass between
/// triangles that share an edge.
bool first_triangle(const ViewRay& ray, PointsView points, TrianglesView triangles, RayHit& hit);

/// Find the first tet that a ray enters, among the tets with wanted[t] = 1 (#T). Each tet is scaled
/// about its center by `size`. 100,000 tets take about 1 millisecond.
bool first_tet(const ViewRay& ray, PointsView points, TetsView tets,
  const std::vector<char>& is_candidate, double size, RayHit& hit);

} // namespace bindpose

#endif
