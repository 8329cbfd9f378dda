#ifndef bindpose_weights_unconstrained_weights_h
#define bindpose_weights_unconstrained_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Weights that minimize an energy with no constraint except the values at the handles. Rows sum to
/// one without normalization. The certificate contains the relative difference between the energy
/// and its minimum, and the largest change of a weight by a Newton step of a single vertex. Cost:
/// one factorization, and one solve per handle. All functions return invalid_input if the problem
/// has optional terms (see WeightTerms) or if the energy has no unique minimum.

/// Minimize int |grad w|^2. The weights have peaks at point handles. If all cotangents are
/// positive, the weights are in [0, 1].
Status harmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);
/// Minimize int (Laplacian w)^2. The weights are smooth and nearly independent of the resolution of
/// the mesh, but some of them are outside of [0, 1].
Status biharmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);
/// Minimize int |grad Laplacian w|^2. The weights are smoother than biharmonic weights, but the
/// largest distance of a weight from [0, 1] is larger.
Status triharmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);
/// Minimize |K w|^2 without masses (Botsch and Kobbelt 2004), for comparison. The weights depend on
/// the density of the mesh.
Status graph_biharmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);
/// Minimize the biharmonic energy with boundary conditions that every linear function satisfies
/// (Wang, Jacobson, Barbic, Kavan, Linear Subspace Design for Real-Time Shape Deformation, 2015).
/// Point handles then reproduce affine maps exactly: sum w_j p_j = p. This requires four points
/// that are not in a plane, or for flat shapes three points that are not on a line. If there are
/// too few points, 1e-6 times the biharmonic energy is added, with a warning. The method is
/// intended for point handles. Weights are constant along a bone, which is not compatible with
/// linear functions, so weights beyond a bone are far outside of [0, 1].
Status linear_subspace_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);

} // namespace bindpose

#endif
