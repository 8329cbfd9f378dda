#ifndef bindpose_qp_ordered_pairs_h
#define bindpose_qp_ordered_pairs_h

#include "domain/domain.h"
#include "qp/box_qp.h"

namespace bindpose
{

/// Return the cotangent stiffness, in which edge weights below a small positive minimum are raised
/// to this minimum. A function that is harmonic for this matrix has extrema only at vertices with
/// given values. The unchanged cotangent Laplacian of most tet meshes does not guarantee this
/// property.
/// @param is_used #V: 0 for vertices whose edges are ignored.
SparseMatrix positive_stiffness(
  const SparseMatrix& stiffness, const VertexGraph& graph, const std::vector<char>& is_used);

/// Sort the pairs by `low`, then by `high`, and remove duplicates.
void sort_pairs(std::vector<OrderedPair>& pairs);

/// Return the vertices 0 … count - 1 in an order in which the `low` vertex of every pair comes
/// before its `high` vertex. Fewer vertices are returned if the pairs have a cycle.
std::vector<Index> topological_order(const std::vector<OrderedPair>& pairs, Index count);

/// Sort the pairs by the position of `low` in the order. In the sorted list, all pairs (a, b) come
/// before all pairs (b, c).
std::vector<OrderedPair> sort_pairs_by_order(
  const std::vector<OrderedPair>& pairs, const std::vector<Index>& order);

/// Test whether bounds and given values are compatible with the column's pairs, by propagating
/// lower bounds along the pairs.
/// @return a vertex that has no feasible value; -1: there is no such vertex.
Index find_infeasible_vertex(
  const BoxQpColumn& column, const std::vector<Index>& fixed, Index count);

/// Change values as little as necessary to satisfy every ordered pair. Given values do not change.
/// @param sorted_pairs all ordered pairs, sorted by sort_pairs_by_order().
/// @param is_free #V, 0 for given values.
/// @param highest #V, upper bounds of free values.
void enforce_order(const std::vector<OrderedPair>& sorted_pairs, const std::vector<char>& is_free,
  const Eigen::VectorXd& highest, Eigen::VectorXd& values);

} // namespace bindpose

#endif
