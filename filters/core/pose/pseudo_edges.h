#ifndef bindpose_pose_pseudo_edges_h
#define bindpose_pose_pseudo_edges_h

// Rotations of point handles from their positions, by virtual edges between the points (Jacobson et
// al. 2011, Bounded Biharmonic Weights, section 5).

#include "base/execution.h"
#include "handles/handles.h"
#include "pose/pose.h"

#include <array>
#include <vector>

namespace bindpose
{

/// A pair of point handles (columns) that are joined by a virtual edge, called a pseudo-edge. The
/// rotation of the edge determines the rotation of its ends.
using PseudoEdge = std::array<Index, 2>;
using PseudoEdges = std::vector<PseudoEdge>;

/// Check that each edge joins two different point handles. Otherwise return invalid_input with the
/// first invalid edge.
Status check_pseudo_edges(const Handles& handles, const PseudoEdges& edges);

/// Compute the minimum spanning tree of all point handles by their distances along the mesh's
/// edges. Users expect this tree. It joins each point to its nearest neighbors inside the shape,
/// for example in a row along an arm. It never joins points across a gap, for example between two
/// arms. Edges chosen by straight distances, and Delaunay edges, would cross such gaps. The tree
/// avoids long edges, whose rotation is a poor estimate of the rotation at their ends. Each
/// connected part of the mesh has a separate tree.
///
/// Each vertex belongs to the nearest point handle (one Dijkstra run from all handles). Mesh edges
/// between vertices of two handles give paths between these handles, and the shortest paths form a
/// minimum spanning tree (Mehlhorn 1988). Cost: O(#V log #V) for any number of handles. The edges
/// are the same for any number of threads. Return invalid_input if a point is not finite. If fewer
/// than two points can be joined, `edges` is empty and a warning is added.
Status automatic_pseudo_edges(ExecutionContext& context, PointsView points, TetsView tets,
  const Handles& handles, PseudoEdges& edges);
Status automatic_pseudo_edges(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const Handles& handles, PseudoEdges& edges);

/// Rotate each handle that has pseudo-edges. For each of its edges, there is a smallest rotation
/// from the rest direction to the posed direction. The handle is rotated by the mean of these
/// rotations. (For the mean, the quaternions are aligned in sign to the first one, added and
/// normalized.) The new linear part of the handle's transform is the rotation times the old linear
/// part, about the posed pivot. The handle's mode becomes full. If the mode was position, the old
/// linear part is ignored. A free handle stays at rest. Handles without edges keep their
/// transforms.
///
/// If a rigid motion moves all pivots, the computed rotation is exact under one condition: the
/// handles are in a plane, and the rotation is within that plane. In space, a rotation about an
/// edge does not change the edge and cannot be detected.
///
/// @param stretch whether to also scale handles by the mean ratio of their edges' lengths.
void rotate_by_pseudo_edges(
  const Handles& handles, const PseudoEdges& edges, bool stretch, Pose& pose);

} // namespace bindpose

#endif
