#ifndef bindpose_weights_monotone_weights_h
#define bindpose_weights_monotone_weights_h

#include "weights/column_groups.h"

namespace bindpose
{

/// Guides of monotone weights and the ordered pairs computed from them, one guide and one list of
/// pairs per column of the group. A guide is a harmonic function that has extrema only on handles
/// and on pinned vertices; it determines which neighbors of a vertex are above and below the
/// vertex. Vertices where a guide is exactly 0 or 1 (regions enclosed by one handle) are pinned in
/// the columns. The pairs are added to the columns. monotone_guide() returns invalid_input, naming
/// handle and vertex, if the bounds contradict the order.
struct MonotoneGuide
{
  Eigen::MatrixXd guide; ///< #unknowns x #columns: guides, harmonic for positive edge weights
  std::vector<std::vector<OrderedPair>> pairs;
};
Status monotone_guide(const WeightsProblem& problem, ColumnGroup& group,
  const SparseSolver::Options& solver, ExecutionContext& context, MonotoneGuide& result);

/// Compute monotone weights: bounded k-harmonic weights whose only extrema are on the handles. A
/// guide determines one neighbor above and one neighbor below each vertex, so no vertex between
/// handles can be an extremum. The certificate is defined as for bounded weights. Cost: 10 to 25
/// factorizations per handle.
/// Jacobson, Weinkauf, Sorkine 2012, Smooth shape-aware functions with controlled extrema.
Status monotone_weights(const WeightsProblem& problem, const WeightsOptions& options,
  ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
