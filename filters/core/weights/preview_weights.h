#ifndef bindpose_weights_preview_weights_h
#define bindpose_weights_preview_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Compute a fast preview of bounded biharmonic weights: biharmonic weights without bounds, clamped
/// to [0, 1], with rows divided by their sums. No row is zero, because the vertices on handles are
/// fixed as in the final weights.
///
/// The matrix of the energy is K M^-1 K, with the cotangent stiffness K and the lumped mass M. The
/// block of free vertices in this matrix is A + R. A is the product of the blocks of free vertices
/// in K, M^-1 and K. R is a low-rank matrix that depends on the fixed vertices. To solve a system
/// with the matrix A, only a factor of the block of K is needed. The effect of R is computed by the
/// Woodbury formula.
///
/// Cost: one factorization of K, and two solves per handle vertex that has a free neighbor. In
/// volumes, factoring K takes only a fraction of the time of factoring K M^-1 K. If many handle
/// vertices have a free neighbor, conjugate gradients with the preconditioner A are used instead.
/// The iterations end when no weight changes by 1e-3 or more, or after 60 iterations.
///
/// The certificate bounds the difference between the energy of the clamped columns and the energy
/// of bounded biharmonic weights. The tolerance of the options is ignored.
/// Report: the keys of finish_weights(), and stage ("preview").
Status preview_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);

} // namespace bindpose

#endif
