#ifndef bindpose_weights_preview_weights_h
#define bindpose_weights_preview_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Compute a fast preview: biharmonic weights without bounds, clamped to [0, 1], with rows divided
/// by their sums. No row is zero, because the handles' own vertices are fixed as always.
///
/// Biharmonic weights do not need a factorization of their energy K M^-1 K. Except in the rows of
/// the fixed vertices it is a product of matrices, which can be inverted with the factor of the
/// Laplacian. Those rows change the inverse by a low-rank matrix (Woodbury).
/// Cost: one factorization of the Laplacian, a fraction of that of the energy in volumes, and two
/// solves per handle vertex that has a free neighbor. If there are many such vertices, conjugate
/// gradients with the product as preconditioner are used instead (to 1e-3).
///
/// The certificate bounds the distance of the clamped columns to bounded biharmonic weights. The
/// tolerance is not used.
/// Report in addition to WeightsResult's keys: stage ("preview").
Status preview_weights(const WeightsProblem& problem, const WeightsOptions& options,
  ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
