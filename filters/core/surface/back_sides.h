#ifndef bindpose_surface_back_sides_h
#define bindpose_surface_back_sides_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Find triangles that are the back sides of other triangles. Models for viewing from both sides
/// often contain every triangle twice, with opposite orientations. The winding number of such a
/// model is 0 everywhere, even inside.
///
/// A triangle is canceling if it occurs equally often in both orientations. Edges with exactly two
/// canceling triangles join these triangles into patches. A patch is closed if the norm of the sum
/// of its area vectors is at most a quarter of its area. In a closed patch, one outward-facing copy
/// of each triangle is kept; all other copies are back sides. Flat patches, like leaves, enclose
/// nothing and are not changed. Cost: O(n log n).
/// @param triangles triangles of a surface whose equal points are welded
/// @return the ids of the back sides, ascending
std::vector<Index> back_sides(PointsView points, TrianglesView triangles);

} // namespace bindpose

#endif
