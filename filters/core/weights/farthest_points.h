#ifndef bindpose_weights_farthest_points_h
#define bindpose_weights_farthest_points_h

#include "base/execution.h"
#include "base/mesh.h"

namespace bindpose
{

/// Spreads count points over a surface's vertices: the first is the vertex farthest from the
/// centroid of the used vertices, each next one the vertex farthest (in space, not along the
/// surface) from all before it. Ties go to the smaller vertex id, so the result is unique.
/// Only vertices that a triangle uses are chosen, and no place twice.
///
/// Cost: count passes over the vertices. After T. Gonzalez, "Clustering to minimize the maximum
/// intercluster distance", 1985: the largest distance to a chosen point is at most twice the best.
/// @param chosen  vertex ids in the order of choice
/// @return invalid_input when count < 1 or there are fewer different places than count
Status farthest_points(PointsView points, TrianglesView triangles, Index count,
  ExecutionContext& context, std::vector<Index>& chosen);

} // namespace bindpose

#endif
