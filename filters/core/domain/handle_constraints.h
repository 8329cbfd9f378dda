#ifndef bindpose_domain_handle_constraints_h
#define bindpose_domain_handle_constraints_h

#include "domain/handle_insertion.h"

namespace bindpose
{

/// The source of a vertex's weights, one role per vertex.
enum class VertexRole : unsigned char
{
  solved, ///< a vertex whose weights are the result of the minimization
  handle, ///< a vertex on a handle or cage, with given weights
  /// A vertex in a component without handles; it copies the weights of the nearest handle.
  without_handle,
  follower, ///< a vertex that is only in elements without area; it copies the weights of a neighbor
  unreferenced ///< a vertex in no element; its row is zero
};

/// The Dirichlet conditions of all weights, computed from the handles by constrain_handles().
struct HandleConstraints
{
  std::vector<VertexRole> roles; ///< #V
  std::vector<Index> vertices; ///< ids of the vertices on handles and cages, ascending
  Weights values; ///< #vertices x #handles: the weights of these vertices; rows sum to one
  std::vector<Index> counts; ///< number of constrained vertices per handle
  /// Connected components of the elements of positive measure; -1 for followers and unreferenced
  /// vertices.
  Components components;
  /// For each component, the handle whose weights it copies; -1: the component has handles.
  std::vector<Index> nearest_handle;
  /// #V: for a follower, the vertex whose weights it copies; -1: not a follower.
  std::vector<Index> leader;
  std::vector<std::string> warnings;
};

/// Find the vertices on the handles and the given weights of these vertices, which are the boundary
/// conditions of all weights.
///
/// A vertex on an edge or face of a cage gets weights that are linear along the edge or face.
///
/// A vertex on several handles gets equal weights (a joint of two bones: 1/2, 1/2). If the handles
/// do not touch, a warning names them. If every vertex of a handle is also on other handles, one of
/// these vertices is assigned to that handle alone. A handle with Ownership::optional is skipped if
/// no vertex can be assigned to it alone. The column of a skipped handle is zero, and one warning
/// names all skipped handles. The column of every other handle contains a one.
///
/// A component without any handle copies the weights of the handle nearest to the component, with a
/// warning.
///
/// @param region_ids region label of every original vertex, or empty if there are no regions.
/// @param part_labels label of every vertex, or empty. Components that contain vertices with the
/// same label > 0 count as one component.
/// @return the errors of check_regions(). Also invalid_input, naming the handle, if a required
/// handle constrains no vertex or cannot have a vertex of its own.
Status constrain_handles(const HandleInsertion& mesh, const Handles& handles,
  const std::vector<Index>& region_ids, HandleConstraints& result,
  const std::vector<Index>& part_labels = {});

} // namespace bindpose

#endif
