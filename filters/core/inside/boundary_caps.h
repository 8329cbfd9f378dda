#ifndef bindpose_inside_boundary_caps_h
#define bindpose_inside_boundary_caps_h

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

} // namespace bindpose

#endif
