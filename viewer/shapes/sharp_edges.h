#ifndef bindpose_shapes_sharp_edges_h
#define bindpose_shapes_sharp_edges_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Duplicate the vertices along sharp edges, so that normals can be averaged at each vertex without
/// smoothing across these edges. The triangles at a vertex form groups: two triangles are in one
/// group if they share an edge at the vertex, no third triangle has this edge, and their normals
/// differ by less than the feature angle. Each group gets a vertex of its own. Vertices that no
/// triangle uses are dropped. vtkPolyDataNormals splits in the same way, on one core.
///
/// @param feature_angle  degrees, in (0, 180]
/// @param triangles      #F x 3, input and output: vertex ids; on output, ids of the new vertices
/// @return the original vertex of each new vertex, ascending. Cost: O(#V + #F), on all cores.
std::vector<Index> split_sharp_edges(PointsView points, double feature_angle, Triangles& triangles);

} // namespace bindpose

#endif
