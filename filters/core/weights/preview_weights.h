#ifndef bindpose_weights_preview_weights_h
#define bindpose_weights_preview_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Compute a fast preview of bounded biharmonic weights: biharmonic weights without bounds, clamped
/// to [0, 1], with rows divided by their sums. No row is zero, because the vertices on handles are
/// fixed as in the final weights.
///
/// Let K be the cotangent stiffness and M the lumped mass. For the free vertices, the energy K M^-1
/// K is a product of matrices plus a term of the fixed vertices. The inverse of the product needs
/// only a factor of K. The term of the fixed vertices changes this inverse by a low-rank matrix
/// (Woodbury). Cost: one factorization of K (in volumes a fraction of the cost of factoring the
/// energy), and two solves per handle vertex that has a free neighbor. If there are many such
/// vertices, conjugate gradients with the product as preconditioner are used instead. They end when
/// an iteration changes no weight by 1e-3 or more, at the latest after 60 iterations.
///
/// The certificate bounds the difference between the energy of the clamped columns and the energy
/// of bounded biharmonic weights. The tolerance of the options is ignored.
/// Report: the keys of finish_weights(), and stage ("preview").
Status preview_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);

} // namespace bindpose

#endif
