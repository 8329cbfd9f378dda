#ifndef bindpose_surface_back_sides_h
#define bindpose_surface_back_sides_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Find triangles that are the back sides of others. Models for viewing from both sides often
/// contain every triangle twice, with opposite orientations. Their winding number is 0 everywhere,
/// even inside.
///
/// The function examines patches of triangles whose copies cancel, connected by edges that two of
/// them use. A patch is closed if the sum of its area vectors is at most a quarter of its area. In
/// a closed patch, all copies but one are backs; the copy that faces outwards is kept. Flat
/// patches, like leaves, enclose nothing and are not changed. O(n log n).
/// @param triangles of a surface whose equal points are welded
/// @return triangle ids, ascending
std::vector<Index> back_sides(PointsView points, TrianglesView triangles);

} // namespace bindpose

#endif
