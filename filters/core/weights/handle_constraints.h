#ifndef bindpose_weights_handle_constraints_h
#define bindpose_weights_handle_constraints_h

#include "weights/handle_insertion.h"

namespace bindpose
{

/// What a vertex's weights come from.
enum class VertexRole : unsigned char
{
  solved, ///< the minimiser
  handle, ///< on a handle: its row is given
  tethered, ///< in a connected part without handles: the weights of the nearest handle
  follower, ///< only in elements without area: the weights of a neighbour
  unreferenced ///< in no element: a row of zeros
};

struct HandleConstraints
{
  std::vector<VertexRole> roles; ///< #V
  std::vector<Index> vertices; ///< b, ascending: the vertices on handles and cages
  Weights values; ///< bc, #b x #handles: rows sum to one
  std::vector<Index> counts; ///< constrained vertices of every handle
  Components components; ///< by elements that have a measure; -1 for followers and unreferenced
  std::vector<Index> tether; ///< of every component: the handle that it follows, -1: has handles
  std::vector<Index> leader; ///< #V: whom a follower follows, -1 for all others
  std::vector<std::string> warnings;
};

/// Fixed vertices and their rows (the discrete boundary conditions) from where the handles lie.
///
/// A vertex on a cage's edge or face gets what is linear there.
///
/// A vertex on several handles gets equal shares (a joint of two bones: 1/2, 1/2); where that
/// happens although the handles do not touch, a warning names them. A handle that shares all of its
/// vertices gets one for itself, so that every column has a one. A connected part without any
/// handle follows the handle nearest to it, with a warning. invalid_input for check_regions()'s
/// reasons and, naming the handle, when one constrains no vertex or can have none of its own. A
/// handle that needs no vertex (see Ownership) is skipped instead: its column is zero, and one
/// warning names such handles.
///
/// @param region_ids label of every original vertex, or empty when there are no regions.
/// @param joined label of every vertex, or empty: parts with a label > 0 in common count as one.
Status constrain_handles(const HandleInsertion& mesh, const Handles& handles,
  const std::vector<Index>& region_ids, HandleConstraints& result,
  const std::vector<Index>& joined = {});

} // namespace bindpose

#endif
