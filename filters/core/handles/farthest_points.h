#ifndef bindpose_handles_farthest_points_h
#define bindpose_handles_farthest_points_h

#include "base/execution.h"
#include "geometry/mesh.h"

namespace bindpose
{

/// Choose `count` vertices that are spread over a surface (farthest-point sampling). The first
/// point is the vertex farthest from the centroid of the used vertices. Each further point is the
/// vertex with the largest distance to its nearest chosen point, measured in space and not along
/// the surface. If several vertices have this distance, the vertex with the smallest id is chosen,
/// so the result is unique. Only vertices of triangles are chosen, and no two chosen vertices have
/// the same position.
///
/// Cost: `count` passes over the vertices. T. Gonzalez, "Clustering to minimize the maximum
/// intercluster distance", 1985: the largest distance of a vertex to its nearest chosen point is at
/// most twice the smallest possible value.
/// @param chosen  vertex ids in the order of choice
/// @return invalid_input if count < 1, or if the vertices have fewer than `count` different
/// positions
Status farthest_points(ExecutionContext& context, PointsView points, TrianglesView triangles,
  Index count, std::vector<Index>& chosen);

} // namespace bindpose

#endif
