#ifndef bindpose_weights_extrema_order_h
#define bindpose_weights_extrema_order_h

#include "base/execution.h"
#include "weights/certificate.h"
#include "weights/domain.h"

namespace bindpose
{

/// The extrema that a function may have, #V: above 0 a maximum, below 0 a minimum, 0 neither.
/// Neighboring vertices with the same sign are one extremum (a plateau).
using ExtremaList = std::vector<signed char>;

/// Remove the vertices listed as the other kind of extremum. Return the connected parts of the rest
/// that contain no extremum of this kind. A function whose only extrema are the listed ones must be
/// constant there.
/// @param taking_part #V, 0 for vertices that are left out.
/// @param kind 1: parts without a maximum, -1: without a minimum.
std::vector<std::vector<Index>> parts_without(const VertexGraph& graph,
  const std::vector<char>& taking_part, const ExtremaList& list, int kind);

/// Find an order of the vertices that has exactly the listed extrema and is as close to the order
/// of the values as flooding allows. Every vertex that is not listed has one neighbor before it and
/// one after it. Neighbors of a maximum that are not maxima themselves come before it, those of a
/// minimum after it.
///
/// Tierny, Pascucci 2012, Generalized topological simplification of scalar fields on surfaces
/// (extrema only, in any dimension). Cost: a few floods, O(#E log #V) each.
/// @param list must have no parts_without() of either kind.
/// @param rank position of each vertex in the order; -1 for vertices that do not take part.
/// @return the number of floods; 0 if no order was found.
int order_with_extrema(const VertexGraph& graph, const std::vector<char>& taking_part,
  const ExtremaList& list, const Eigen::VectorXd& values, const ExecutionContext& context,
  std::vector<Index>& rank);

/// Replace the order by the order of the values; ties are broken by the old order. If the values
/// satisfy the pairs of the old order, the new order has the same extrema.
void order_again(const Eigen::VectorXd& values, std::vector<Index>& rank);

/// Return the pairs that guarantee the extrema of an order. Each vertex that is not listed is above
/// its lowest and below its highest neighbor. A listed vertex is above or below all of its
/// neighbors.
/// @param least minimum difference.
std::vector<OrderedPair> pairs_of_order(
  const VertexGraph& graph, const ExtremaList& list, const std::vector<Index>& rank, double least);

} // namespace bindpose

#endif
