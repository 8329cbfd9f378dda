#ifndef bindpose_surface_triangle_predicates_h
#define bindpose_surface_triangle_predicates_h

#include "base/mesh.h"

namespace bindpose
{

/// Sign of the volume of a, b, c, d (tet_volume's): exact but for underflow.
int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// True when a, b and c lie on one line: exact.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// True when triangles of a mesh meet in more than the vertices and edges they share by id: they
/// cross, touch, or overlap in one plane. Exact. False for a triangle with itself or a duplicate,
/// and when one of them has no area.
bool triangles_cross(PointsView points, TrianglesView triangles, Index f, Index g);

/// True when the segment pq and the triangle abc have a point in common: exact. False for a
/// triangle without area.
bool segment_meets_triangle(
  const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

/// The point of a triangle nearest to p.
Vec3 closest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace bindpose

#endif
