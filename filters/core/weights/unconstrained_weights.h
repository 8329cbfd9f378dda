#ifndef bindpose_weights_unconstrained_weights_h
#define bindpose_weights_unconstrained_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

struct UnconstrainedWeightsOptions : WeightsOptions
{
  /// Order of the energy: 1 harmonic, 2 biharmonic, 3 triharmonic.
  int order = 2;
};

/// k-harmonic weights without bounds: one factorisation, one solve a handle. Rows sum to one by
/// themselves. Harmonic weights peak at points; orders 2 and 3 are smooth and overshoot [0, 1].
/// The certificate: distance of the energy from its minimum, and the largest Newton step of one
/// vertex, both relative.
Status unconstrained_weights(const WeightsProblem& problem,
  const UnconstrainedWeightsOptions& options, ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
