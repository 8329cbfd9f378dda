#ifndef bindpose_weights_extrema_order_h
#define bindpose_weights_extrema_order_h

#include "base/execution.h"
#include "domain/domain.h"
#include "qp/certificate.h"

namespace bindpose
{

/// The extrema that a function may have, #V: a positive entry is a maximum, a negative entry a
/// minimum, 0 neither. Connected vertices with the same sign are one extremum (a plateau).
using ExtremaList = std::vector<signed char>;

/// Remove the vertices that are listed as the opposite kind of extremum. Return the connected parts
/// of the rest that contain no extremum of the requested kind. A function that has only the listed
/// extrema must be constant on these parts.
/// @param taking_part #V, 0 for vertices that are ignored.
/// @param kind 1: parts without a maximum, -1: parts without a minimum.
std::vector<std::vector<Index>> parts_without(const VertexGraph& graph,
  const std::vector<char>& taking_part, const ExtremaList& list, int kind);

/// Find an order of the vertices that has exactly the listed extrema and is as close to the order
/// of the values as flooding allows. Every vertex that is not listed has at least one neighbor
/// before it and one after it. All neighbors of a listed maximum that are not maxima themselves
/// come before it, and all neighbors of a minimum that are not minima come after it.
///
/// Tierny, Pascucci 2012, Generalized topological simplification of scalar fields on surfaces (only
/// the extrema, but in any dimension). Cost: a few floods, O(#E log #V) each.
/// @param list must leave no parts in parts_without() for either kind.
/// @param rank position of each vertex in the order; -1 for vertices that do not take part.
/// @return the number of floods; 0 if no order was found.
int order_with_extrema(const VertexGraph& graph, const std::vector<char>& taking_part,
  const ExtremaList& list, const Eigen::VectorXd& values, const ExecutionContext& context,
  std::vector<Index>& rank);

/// Replace the order by the order of the values; equal values keep the old order. If the values
/// satisfy the pairs of the old order, the new order has the same extrema.
void order_again(const Eigen::VectorXd& values, std::vector<Index>& rank);

/// Return the ordered pairs that guarantee the extrema of an order. Each vertex that is not listed
/// is above its lowest and below its highest neighbor. A listed maximum is above all its neighbors,
/// a listed minimum is below them.
/// @param least minimum difference of each pair.
std::vector<OrderedPair> pairs_of_order(
  const VertexGraph& graph, const ExtremaList& list, const std::vector<Index>& rank, double least);

} // namespace bindpose

#endif
