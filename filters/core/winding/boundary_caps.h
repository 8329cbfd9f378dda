#ifndef bindpose_winding_boundary_caps_h
#define bindpose_winding_boundary_caps_h

#include "base/mesh.h"

namespace bindpose
{

/// Triangles that close a surface: with them added, every edge is used as often in one direction as
/// in the other, and the surface's winding number is a whole number less the caps' own.
///
/// @param edges of the surface's triangles, as mesh_edges() counts them
/// @return #C x 3 ids of the surface's vertices, no new ones: n - 2 triangles for a boundary loop
///   of n edges. A triangle that is all on its own gets itself, turned over, as its cap.
/// Cost: O(#open edges log #open edges).
Triangles boundary_caps(const std::vector<Edge>& edges);

/// The caps of `boundary_caps` where they are smaller than the connected part that they close;
/// elsewhere that part itself, turned over, which closes it as well. For sums whose cost goes with
/// the size of the triangles: the caps of long strips and of leaves reach far from them.
/// @param points #V x 3
/// @param triangles #F x 3, those whose net boundary the caps close
/// @param caps #C x 3
Triangles smaller_caps(const Points& points, const Triangles& triangles, const Triangles& caps);

} // namespace bindpose

#endif
