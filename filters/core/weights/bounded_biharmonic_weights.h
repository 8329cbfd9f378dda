#ifndef bindpose_weights_bounded_biharmonic_weights_h
#define bindpose_weights_bounded_biharmonic_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

struct BoundedWeightsOptions : WeightsOptions
{
  /// Order of the energy: 2 biharmonic, 3 triharmonic (oscillates within the bounds).
  int order = 2;
};

/// Bounded biharmonic weights: for each handle the minimiser of the k-harmonic energy between 0 and
/// 1 that is 1 on the handle and 0 on all others; rows are divided by their sums afterwards.
/// Converged, with a certificate a column. Cost: see BoxQp.
/// Jacobson et al. 2011, Bounded biharmonic weights for real-time deformation.
Status bounded_biharmonic_weights(const WeightsProblem& problem,
  const BoundedWeightsOptions& options, ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
