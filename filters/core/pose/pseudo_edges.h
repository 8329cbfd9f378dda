#ifndef bindpose_pose_pseudo_edges_h
#define bindpose_pose_pseudo_edges_h

#include "base/execution.h"
#include "pose/pose.h"
#include "weights/handles.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Two point handles (columns) joined by a virtual edge. The rotation of the edge determines the
/// rotation of its ends.
using PseudoEdge = std::array<Index, 2>;
using PseudoEdges = std::vector<PseudoEdge>;

/// Return invalid_input, naming the first offender, unless each edge joins two different point
/// handles.
Status check_pseudo_edges(const Handles& handles, const PseudoEdges& edges);

/// Compute the minimum spanning tree of all point handles by their distances along the mesh's
/// edges. This is the tree that a person would draw. It joins each point to its nearest neighbors
/// through the shape, in a row along an arm, and never across a gap between two arms. Straight
/// distances and Delaunay edges would cross such gaps. The tree has no long edges, whose rotation
/// would be a poor estimate for their ends. Each connected part of the mesh gets its own tree.
///
/// Each vertex belongs to the nearest point handle (one Dijkstra run from all handles). Mesh edges
/// between vertices of two handles give paths between these handles, and the shortest paths form a
/// minimum spanning tree (Mehlhorn 1988). Cost: O(#V log #V) for any number of handles. The edges
/// are the same for any number of threads. invalid_input for points that are not finite. If fewer
/// than two points can be joined, there are no edges, and a warning is added.
Status automatic_pseudo_edges(ExecutionContext& context, PointsView points, TetsView tets,
  const Handles& handles, PseudoEdges& edges);
Status automatic_pseudo_edges(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const Handles& handles, PseudoEdges& edges);

/// Return the smallest rotation that takes the direction of `from` to that of `to`. For opposite
/// directions it is half a turn about an axis perpendicular to them. The axis is the projection of
/// the coordinate axis with the largest angle to them. Of several such axes the last is used, so
/// that flat shapes (z = const) turn in their plane. Return the identity for a vector of length
/// zero.
Eigen::Quaterniond least_rotation(const Vec3& from, const Vec3& to);

/// Add to each handle with pseudo-edges the rotation that the posed positions of the handles imply.
/// This is the mean of the smallest rotations that take the handle's edges from rest to their posed
/// directions (the quaternions are added with the sign of the first one and normalized). The
/// handle's new linear part is rotation * its own linear part, about its posed pivot. A handle in
/// mode position contributes its translation only, and gets mode full. A free handle stays at rest.
/// Handles without edges keep their transforms.
///
/// A rigid motion that moves all pivots is found exactly if the handles are in a plane and turn
/// within it. In space, a rotation about an edge itself does not show in the edge.
///
/// @param stretch whether to also scale handles by the mean ratio of their edges' lengths.
void turn_by_pseudo_edges(
  const Handles& handles, const PseudoEdges& edges, bool stretch, Pose& pose);

} // namespace bindpose

#endif
