#ifndef bindpose_surface_triangle_predicates_h
#define bindpose_surface_triangle_predicates_h

#include "geometry/mesh.h"

namespace bindpose
{

/// Return the sign of the volume of the tet a, b, c, d, with the sign convention of tet_volume().
/// The result is exact unless an underflow occurs.
int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Report whether a, b and c are collinear. The test is exact.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// Report whether two triangles of a mesh intersect outside of the vertices and edges that they
/// share by id: they cross, touch, or overlap in one plane. The test is exact. Return false if f
/// equals g, if both triangles have the same three vertices, or if a triangle has area zero.
bool triangles_cross(PointsView points, TrianglesView triangles, Index f, Index g);

/// Report whether the segment pq and the triangle abc have a common point. The test is exact.
/// Return false for a triangle of area zero.
bool segment_meets_triangle(
  const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

/// Return the point on triangle abc whose distance from p is smallest.
Vec3 closest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace bindpose

#endif
