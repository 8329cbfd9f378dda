#ifndef bindpose_surface_triangle_shape_h
#define bindpose_surface_triangle_shape_h

#include "geometry/mesh.h"

namespace bindpose
{

/// Return the smallest angle of a triangle, in degrees.
double smallest_triangle_angle(const Vec3& a, const Vec3& b, const Vec3& c);

/// Count the triangles whose smallest angle is below `angle` degrees: needles (one short edge) and
/// caps (one angle near 180 degrees).
Index count_needles(PointsView points, TrianglesView triangles, double angle);

} // namespace bindpose

#endif
