#ifndef bindpose_weights_monotone_weights_h
#define bindpose_weights_monotone_weights_h

#include "weights/column_groups.h"

namespace bindpose
{

struct MonotoneWeightsOptions : WeightsOptions
{
  /// Order of the energy: 2 biharmonic, 3 triharmonic.
  int order = 2;
};

/// The guides of monotone weights and their ordered pairs, a list for each column of the group. A
/// guide has its extrema on the handles and on pinned vertices only; vertices where it is exactly 0
/// or 1 (parts that one handle closes off) are pinned in the columns, which get the pairs.
/// invalid_input, naming handle and vertex, when bounds cannot be kept in that order.
struct MonotoneGuide
{
  Eigen::MatrixXd guide; ///< #unknowns x #columns, harmonic for positive weights of the edges
  std::vector<std::vector<OrderedPair>> pairs;
};
Status monotone_guide(const WeightsProblem& problem, ColumnGroup& group,
  const SparseSolver::Options& solver, ExecutionContext& context, MonotoneGuide& result);

/// Monotone weights: bounded k-harmonic weights whose only extrema are the handles. Each vertex
/// gets one neighbour above and one below it by a guide, so no vertex between can be one.
/// Certified as bounded weights are. Cost: 10 to 25 factorisations a handle.
/// Jacobson, Weinkauf, Sorkine 2012, Smooth shape-aware functions with controlled extrema.
Status monotone_weights(const WeightsProblem& problem, const MonotoneWeightsOptions& options,
  ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
