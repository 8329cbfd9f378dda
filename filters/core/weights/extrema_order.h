#ifndef bindpose_weights_extrema_order_h
#define bindpose_weights_extrema_order_h

#include "base/execution.h"
#include "weights/certificate.h"
#include "weights/domain.h"

namespace bindpose
{

/// The extrema that a function may have, #V: above 0 a maximum, below 0 a minimum, 0 neither.
/// Neighbours of the same kind are one extremum (a plateau).
using ExtremaList = std::vector<signed char>;

/// The connected parts of the vertices that are not listed as the other kind, where no vertex of
/// this kind is: a function with these extrema alone can only be constant there.
/// @param taking_part #V, 0 for vertices that are left out.
/// @param kind 1: parts without a maximum, -1: without a minimum.
std::vector<std::vector<Index>> parts_without(const VertexGraph& graph,
  const std::vector<char>& taking_part, const ExtremaList& list, int kind);

/// An order of the vertices whose extrema are those of the list and no other, as near to that of
/// the values as floods can keep it: every vertex that is not listed has one neighbour that comes
/// before it and one that comes after it; neighbours of a maximum that are no maxima themselves
/// come before it, those of a minimum after it.
///
/// Tierny, Pascucci 2012, Generalized topological simplification of scalar fields on surfaces (of
/// extrema; of any dimension). Cost: a few floods, O(#E log #V) each.
/// @param list without parts_without() of either kind.
/// @param rank place of each vertex in the order; of vertices that take no part: -1.
/// @return how many floods it took; 0 when they were given up.
int order_with_extrema(const VertexGraph& graph, const std::vector<char>& taking_part,
  const ExtremaList& list, const Eigen::VectorXd& values, const ExecutionContext& context,
  std::vector<Index>& rank);

/// The order by values, ties by an order from before. When the values keep the pairs of the order
/// before, so do the extrema.
void order_again(const Eigen::VectorXd& values, std::vector<Index>& rank);

/// What makes a function have the extrema of an order: each vertex that is not listed stays above
/// its lowest and below its highest neighbour, a listed one above or below all of its neighbours.
/// @param least by how much.
std::vector<OrderedPair> pairs_of_order(
  const VertexGraph& graph, const ExtremaList& list, const std::vector<Index>& rank, double least);

} // namespace bindpose

#endif
