#ifndef bindpose_weights_extrema_order_h
#define bindpose_weights_extrema_order_h

#include "base/execution.h"
#include "domain/domain.h"
#include "qp/certificate.h"

namespace bindpose
{

/// The extrema that a function may have, #V: a positive entry lists a maximum, a negative entry
/// lists a minimum; 0: not listed. Connected vertices with the same sign are one extremum (a
/// plateau).
using ExtremaList = std::vector<signed char>;

/// Divide the mesh at all vertices that are listed as the opposite kind of extremum. Return the
/// connected parts that contain no listed extremum of the requested kind. On such a part, a
/// function that has only the listed extrema would have to be constant.
/// @param is_included #V, 0 for vertices that are ignored.
/// @param kind 1: parts without a maximum, -1: parts without a minimum.
std::vector<std::vector<Index>> parts_without_extremum(const VertexGraph& graph,
  const std::vector<char>& is_included, const ExtremaList& list, int kind);

/// Find an order of the vertices that has exactly the listed extrema and is as close to the order
/// of the values as flooding allows. Every vertex that is not listed has at least one neighbor
/// before it and one after it. All neighbors of a listed maximum come before it, except neighbors
/// that are listed maxima, too. All neighbors of a listed minimum come after it, except neighbors
/// that are listed minima, too.
///
/// Tierny, Pascucci 2012, Generalized topological simplification of scalar fields on surfaces. This
/// function differs from the paper: it prescribes only extrema, not saddles, and works on graphs of
/// any dimension. Cost: a few floods, O(#E log #V) each.
/// @param list parts_without_extremum() must return no parts for this list, for both kinds.
/// @param rank position of each vertex in the order; -1 for vertices that do not take part.
/// @return the number of floods; 0 if no order was found.
int order_with_extrema(const ExecutionContext& context, const VertexGraph& graph,
  const std::vector<char>& is_included, const ExtremaList& list, const Eigen::VectorXd& values,
  std::vector<Index>& rank);

/// Replace the order by the order of the values; vertices with equal values keep their old order.
/// If the values satisfy the ordered pairs of the old order, the new order has the same extrema.
void update_order(const Eigen::VectorXd& values, std::vector<Index>& rank);

/// Return the ordered pairs that guarantee the extrema of an order. Each vertex that is not listed
/// is above its lowest and below its highest neighbor. A listed maximum is above all neighbors that
/// are not listed maxima. A listed minimum is below all neighbors that are not listed minima.
/// @param minimum_difference smallest allowed difference between the two values of a pair.
std::vector<OrderedPair> pairs_from_order(const VertexGraph& graph, const ExtremaList& list,
  const std::vector<Index>& rank, double minimum_difference);

} // namespace bindpose

#endif
