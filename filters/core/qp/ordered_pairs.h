#ifndef bindpose_qp_ordered_pairs_h
#define bindpose_qp_ordered_pairs_h

#include "domain/domain.h"
#include "qp/box_qp.h"

namespace bindpose
{

/// Return the cotangent stiffness with every edge weight raised to a small positive value. A
/// function that is harmonic for this matrix has extrema only at vertices with given values. The
/// unchanged cotangent Laplacian of most tet meshes does not guarantee that.
/// @param pulls #V: 0 for vertices whose edges are ignored.
SparseMatrix positive_stiffness(
  const SparseMatrix& stiffness, const VertexGraph& graph, const std::vector<char>& pulls);

/// Sort the pairs by `low`, then by `high`, and remove duplicates.
void sort_pairs(std::vector<OrderedPair>& pairs);

/// Return the vertices 0 … count - 1 in an order in which the `low` vertex of every pair comes
/// before its `high` vertex. Fewer vertices are returned if the pairs have a cycle.
std::vector<Index> upward_order(const std::vector<OrderedPair>& pairs, Index count);

/// Sort the pairs by the position of `low` in the order. A pass over the sorted pairs visits a pair
/// only after all pairs whose `high` is its `low`.
std::vector<OrderedPair> upward_pairs(
  const std::vector<OrderedPair>& pairs, const std::vector<Index>& order);

/// Test whether bounds and given values are compatible with the column's pairs, by propagating
/// lower bounds along the pairs.
/// @return an unknown that has no feasible value, or -1.
Index without_room(const BoxQpColumn& column, const std::vector<Index>& fixed, Index count);

/// Change values as little as necessary to satisfy every ordered pair. Given values do not change.
/// @param upwards the pairs, sorted by upward_pairs().
/// @param is_free #V, 0 for given values.
/// @param highest #V, upper bounds of free values.
void order_values(const std::vector<OrderedPair>& upwards, const std::vector<char>& is_free,
  const Eigen::VectorXd& highest, Eigen::VectorXd& values);

} // namespace bindpose

#endif
