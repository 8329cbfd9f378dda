#ifndef bindpose_weights_bounded_biharmonic_weights_h
#define bindpose_weights_bounded_biharmonic_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Compute bounded biharmonic weights. The weights of a handle minimize the k-harmonic energy
/// subject to 0 <= w <= 1. The weights are 1 on the handle and 0 on all other handles. Afterward
/// each row is divided by its sum. Every column has an optimality certificate (see Certificate).
/// Cost: see BoxQp.
/// Jacobson et al. 2011, Bounded biharmonic weights for real-time deformation.
Status bounded_biharmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);

} // namespace bindpose

#endif
