#ifndef bindpose_winding_boundary_caps_h
#define bindpose_winding_boundary_caps_h

#include "geometry/mesh.h"

namespace bindpose
{

/// Return triangles, called caps, that close a surface. The surface and its caps together use every
/// edge equally often in both directions. The winding number of the surface is then an integer
/// minus the winding number of the caps.
///
/// @param edges edges of the surface's triangles, as mesh_edges() returns them
/// @return #C x 3 vertex ids of the surface; no vertices are added. A boundary loop of n edges gets
///   n - 2 triangles. The cap of an isolated triangle is the same triangle with reversed
///   orientation. Cost: O(#open edges log #open edges).
Triangles boundary_caps(const std::vector<Edge>& edges);

/// For each connected component, return the smaller of two closures: the caps from `boundary_caps`,
/// or the component itself with reversed orientation. The size of a closure is the sum over its
/// triangles of the squared longest edge. The DipoleField of a smaller closure takes less time. The
/// caps of a long strip or of a leaf-shaped surface can be larger than the component itself.
/// @param points #V x 3
/// @param triangles #F x 3; the caps close the open edges of these triangles
/// @param caps #C x 3
Triangles smaller_caps(const Points& points, const Triangles& triangles, const Triangles& caps);

} // namespace bindpose

#endif
