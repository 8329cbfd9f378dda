#ifndef bindpose_surface_back_sides_h
#define bindpose_surface_back_sides_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Triangles that are the back of others. Models that are to be seen from both sides often have
/// every triangle twice, once each way; their winding number is 0 everywhere, whatever they
/// enclose.
///
/// Looked at are patches of triangles whose copies cancel, joined by edges that two of them use. If
/// a patch closes around something (the sum of its area vectors is at most a quarter of its area),
/// all copies but one are backs, and those that stay are the ones that look outwards. Flat patches,
/// like leaves, enclose nothing and stay as they are. O(n log n).
/// @param triangles of a surface whose equal points are welded
/// @return triangle ids, ascending
std::vector<Index> back_sides(PointsView points, TrianglesView triangles);

} // namespace bindpose

#endif
