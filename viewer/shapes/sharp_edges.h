#ifndef bindpose_shapes_sharp_edges_h
#define bindpose_shapes_sharp_edges_h

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Vertices that are split along sharp edges.
struct SplitVertices
{
  std::vector<Index> originals; ///< original vertex of each new vertex, ascending
  Index normal_count = 0;
  /// Index of the normal of each new vertex. Vertices on both sides of a smooth seam share one.
  /// Empty: normal v belongs to vertex v.
  std::vector<Index> normals;
};

/// Duplicate the vertices along sharp edges, so that normals can be averaged at each vertex without
/// smoothing across these edges. The triangles at a vertex form groups: two triangles are in one
/// group if they share an edge at the vertex, no third triangle has this edge, and their normals
/// differ by less than the feature angle. Each group gets a vertex of its own. Vertices that no
/// triangle uses are dropped. vtkPolyDataNormals splits in the same way, on one core.
///
/// A seam is an edge that occurs twice, with different vertices at the same positions and one
/// triangle each, for example at the border of a texture. Its vertices are not merged. They share a
/// normal unless the edge is sharp.
///
/// @param feature_angle  degrees, in (0, 180]
/// @param triangles      #F x 3, input and output: vertex ids; on output, ids of the new vertices
/// @return the new vertices. Cost: O(#V + #F), on all cores, and a sort of the vertices of edges
/// with one triangle.
SplitVertices split_sharp_edges(PointsView points, double feature_angle, Triangles& triangles);

} // namespace bindpose

#endif
