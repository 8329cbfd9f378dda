#ifndef bindpose_weights_baseline_weights_h
#define bindpose_weights_baseline_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Weight methods of other programs, for comparison. These methods do not minimize an energy. The
/// gap of the certificate is therefore 0, and the residual of the certificate is the relative
/// residual of a linear system. Rows sum to one. All functions return invalid_input if the problem
/// has optional terms (see WeightTerms) or an option is out of range.

/// Shepard weights: w_j is proportional to 1 / d_j^power, where d_j is the straight-line distance
/// from handle j. The weights are in [0, 1] and do not depend on the shape. Cost: O(#V x #handles),
/// no factorization.
Status inverse_distance_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);
/// Harmonic weights (Joshi et al., Harmonic Coordinates for Character Articulation, 2007), smoothed
/// over the length WeightsOptions::smoothing. The smoothing removes the peaks at point handles. The
/// larger this length, the closer the weights are to biharmonic weights. The weights may be outside
/// of [0, 1]. Cost: two factorizations, and two solves per handle.
Status smoothed_harmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);
/// Heat equilibrium (Baran and Popovic, Automatic Rigging and Animation of 3D Characters, 2007;
/// Blender's automatic weights). Each vertex receives heat from the nearest handle if the straight
/// segment to the handle is inside the shape. The heat is proportional to `heat` / d^2 for the
/// distance d. Vertices on handles are fixed, so that every handle has an influence. The weights
/// are in [0, 1] if cotangents are positive. Additional report key: counts.heated_vertices (number
/// of vertices that receive heat). Cost: one factorization, and one solve per handle.
Status bone_heat_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result);

} // namespace bindpose

#endif
