#ifndef bindpose_winding_boundary_caps_h
#define bindpose_winding_boundary_caps_h

#include "geometry/mesh.h"

namespace bindpose
{

/// Return triangles that close a surface. With these caps, every edge is used equally often in both
/// directions. The winding number of the surface is then an integer minus the winding number of the
/// caps.
///
/// @param edges edges of the surface's triangles, as mesh_edges() returns them
/// @return #C x 3 vertex ids of the surface; no vertices are added. A boundary loop of n edges gets
///   n - 2 triangles. The cap of an isolated triangle is the same triangle with reversed
///   orientation. Cost: O(#open edges log #open edges).
Triangles boundary_caps(const std::vector<Edge>& edges);

/// Return the smaller closure of each connected component: its caps from `boundary_caps`, or the
/// component itself with reversed orientation. The smaller closure is better for sums whose cost
/// grows with the size of the triangles. The caps of a long strip or of a leaf-shaped surface can
/// be larger than the component itself.
/// @param points #V x 3
/// @param triangles #F x 3; the caps close the open edges of these triangles
/// @param caps #C x 3
Triangles smaller_caps(const Points& points, const Triangles& triangles, const Triangles& caps);

} // namespace bindpose

#endif
