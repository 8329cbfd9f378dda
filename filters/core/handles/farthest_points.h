#ifndef bindpose_handles_farthest_points_h
#define bindpose_handles_farthest_points_h

#include "base/execution.h"
#include "geometry/mesh.h"

namespace bindpose
{

/// Choose `count` vertices that are spread over a surface (farthest-point sampling). The first one
/// is the vertex farthest from the centroid of the used vertices. Each next one is the vertex
/// farthest (in space, not along the surface) from all earlier ones. Of equally far vertices, the
/// smallest id is chosen, so the result is unique. Only vertices of triangles are chosen, and no
/// two chosen vertices have the same position.
///
/// Cost: count passes over the vertices. After T. Gonzalez, "Clustering to minimize the maximum
/// intercluster distance", 1985: the largest distance to a chosen point is at most twice the
/// optimum.
/// @param chosen  vertex ids in the order of choice
/// @return invalid_input if count < 1 or if there are fewer than count different positions
Status farthest_points(PointsView points, TrianglesView triangles, Index count,
  ExecutionContext& context, std::vector<Index>& chosen);

} // namespace bindpose

#endif
