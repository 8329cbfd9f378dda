#ifndef bindpose_pose_pseudo_edges_h
#define bindpose_pose_pseudo_edges_h

#include "base/execution.h"
#include "pose/pose.h"
#include "weights/handles.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Two handles (columns) between which an edge is thought, though nothing is there: how it turns
/// tells how its ends turn.
using PseudoEdge = std::array<Index, 2>;
using PseudoEdges = std::vector<PseudoEdge>;

/// invalid_input, naming the first offender, unless each edge joins two different point handles.
Status check_pseudo_edges(const Handles& handles, const PseudoEdges& edges);

/// The minimum spanning tree of all point handles by their distances along the mesh's edges: what a
/// person would draw. A tree joins each point to what is nearest through the shape, an arm in a row
/// and never across a gap between two arms, where straight distances and Delaunay edges go; and it
/// has no long edges whose turns say little about their ends. Points on parts that do not hang
/// together have a tree each.
///
/// Each vertex belongs to the nearest point handle (one Dijkstra run from all of them); edges
/// between vertices of two handles are ways between these, and the shortest ways make a minimum
/// spanning tree (Mehlhorn 1988): O(#V log #V), however many handles. The same edges for any number
/// of threads. invalid_input for points that are not finite; a warning, and no edges, where less
/// than two points can be joined.
Status automatic_pseudo_edges(ExecutionContext& context, PointsView points, TetsView tets,
  const Handles& handles, PseudoEdges& edges);
Status automatic_pseudo_edges(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const Handles& handles, PseudoEdges& edges);

/// The least rotation that takes the direction of `from` to that of `to`. Opposite directions: half
/// a turn about the coordinate axis that is farthest from them (the last of equals, so that plane
/// shapes, z = const, turn in their plane), made perpendicular. No rotation for a vector of length
/// zero.
Eigen::Quaterniond least_rotation(const Vec3& from, const Vec3& to);

/// Gives handles with pseudo-edges the rotation that where handles go implies: the mean of the
/// least rotations that take each of a handle's edges from rest to where its ends are posed
/// (quaternions added with the sign of the first's and normalised). It turns what a handle's own
/// transform does, about its posed pivot: rotation * transform. A handle in mode position has its
/// translation only, and is in mode full afterwards; a free one rests. Handles without edges keep
/// theirs.
///
/// A rigid motion that moves all pivots is found exactly by handles in a plane; in space an edge
/// does not see a turn about itself.
///
/// @param stretch whether handles are scaled, too: by the mean ratio of their edges' lengths.
void turn_by_pseudo_edges(
  const Handles& handles, const PseudoEdges& edges, bool stretch, Pose& pose);

} // namespace bindpose

#endif
