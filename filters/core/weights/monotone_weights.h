#ifndef bindpose_weights_monotone_weights_h
#define bindpose_weights_monotone_weights_h

#include "weights/column_groups.h"

namespace bindpose
{

/// Guides of monotone weights and the ordered pairs computed from the guides: one guide and one
/// list of pairs per column of the group. A guide is a harmonic function that has extrema only on
/// handles and on pinned vertices. Each vertex that is not fixed or pinned forms one pair with the
/// neighbor at which the guide is largest, and one pair with the neighbor at which the guide is
/// smallest. monotone_guide() adds the pairs to the columns, and pins vertices at which a guide is
/// exactly 0 or 1 (regions enclosed by one handle). The function returns invalid_input, naming
/// handle and vertex, if bounds or pinned values contradict the pairs.
struct MonotoneGuide
{
  Eigen::MatrixXd guide; ///< #unknowns x #columns, computed with positive edge weights
  std::vector<std::vector<OrderedPair>> pairs; ///< one list per column
};
Status monotone_guide(ExecutionContext& context, const WeightsProblem& problem, ColumnGroup& group,
  const SparseSolver::Options& solver, MonotoneGuide& result);

/// Compute monotone weights: bounded k-harmonic weights whose only extrema are on the handles. A
/// guide (see MonotoneGuide) determines one neighbor above and one neighbor below each vertex, so
/// no vertex between handles can be an extremum. The certificate is defined as for bounded weights.
/// Cost: 5 to 20 factorizations per handle, in single precision.
/// Jacobson, Weinkauf, Sorkine 2012, Smooth shape-aware functions with controlled extrema.
Status monotone_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);

} // namespace bindpose

#endif
