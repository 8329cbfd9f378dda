#ifndef bindpose_surface_triangle_shape_h
#define bindpose_surface_triangle_shape_h

#include "geometry/mesh.h"

namespace bindpose
{

/// Return the smallest angle of a triangle, in degrees.
double smallest_corner(const Vec3& a, const Vec3& b, const Vec3& c);

/// Count the badly shaped triangles, with an angle of less than `angle` degrees: needles and caps.
Index count_needles(PointsView points, TrianglesView triangles, double angle);

} // namespace bindpose

#endif
