#ifndef bindpose_weights_ordered_pairs_h
#define bindpose_weights_ordered_pairs_h

#include "weights/box_qp.h"
#include "weights/domain.h"

namespace bindpose
{

/// Cotangent stiffness with every edge's weight raised to a small positive one: what is harmonic
/// for it has no extremum but where it is given, which the cotangent Laplacian of most tet meshes
/// does not promise.
/// @param pulls #V: 0 for vertices whose edges are left out.
SparseMatrix positive_stiffness(
  const SparseMatrix& stiffness, const VertexGraph& graph, const std::vector<char>& pulls);

/// Sorted, each pair once.
void sort_pairs(std::vector<OrderedPair>& pairs);

/// The vertices 0 … count - 1 so that the low end of every pair comes before its high end. Fewer
/// when pairs run in a circle.
std::vector<Index> upward_order(const std::vector<OrderedPair>& pairs, Index count);

/// The pairs in the order of their low ends: what happens along them one after another is settled
/// at a vertex before it goes on from there.
std::vector<OrderedPair> upward_pairs(
  const std::vector<OrderedPair>& pairs, const std::vector<Index>& order);

/// Whether bounds and given values leave room for the column's pairs: the least that each unknown
/// can be rises along them.
/// @return an unknown without room, or -1.
Index without_room(const BoxQpColumn& column, const std::vector<Index>& fixed, Index count);

/// Lowers and raises values the least needed so that every pair is ordered, given ones included.
/// @param upwards see upward_pairs.
/// @param is_free #V, 0 where a value is given.
/// @param highest #V, that a free one may have.
void order_values(const std::vector<OrderedPair>& upwards, const std::vector<char>& is_free,
  const Eigen::VectorXd& highest, Eigen::VectorXd& values);

} // namespace bindpose

#endif
