#ifndef bindpose_weights_preview_weights_h
#define bindpose_weights_preview_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Something to look at, soon: biharmonic weights without bounds, then clamped to [0, 1], rows
/// divided by their sums. Never nothing: the handles' own vertices are fixed as always.
///
/// Biharmonic weights need no factorisation of their energy K M^-1 K: but for the rows of the fixed
/// vertices it is a product of matrices that the Laplacian's factor solves for, and those rows
/// change its inverse by a matrix of low rank (Woodbury). Cost: one factorisation of the Laplacian,
/// a fraction of F in volumes, and two solves a vertex on handles with a neighbour that is not;
/// where those are many, conjugate gradients with the product as preconditioner instead (to 1e-3).
///
/// The certificate is that of the clamped columns as bounded biharmonic weights: how far they are
/// from them at most. The tolerance is not asked for.
/// Report besides WeightsResult's keys: stage ("preview").
Status preview_weights(const WeightsProblem& problem, const WeightsOptions& options,
  ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
