#ifndef bindpose_weights_baseline_weights_h
#define bindpose_weights_baseline_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Weights of other programs, for comparison. They minimize no energy: the certificate's gap is 0,
/// and its residual is the relative residual of a linear system. Rows sum to one.
/// invalid_input: the problem has optional terms (see WeightTerms), or an option is out of range.

/// Shepard: w_j ~ 1 / d_j^power with straight-line distances, in [0, 1]. Ignores the shape.
/// Cost: O(#V #H), no factorization.
Status inverse_distance_weights(const WeightsProblem& problem, const WeightsOptions& options,
  ExecutionContext& context, WeightsResult& result);
/// Harmonic weights (Joshi et al., Harmonic Coordinates for Character Articulation, 2007), smoothed
/// over a length, which removes the peaks at point handles. They are between harmonic and
/// biharmonic weights and may leave [0, 1]. Cost: two factorizations, and two solves per handle.
Status smoothed_harmonic_weights(const WeightsProblem& problem, const WeightsOptions& options,
  ExecutionContext& context, WeightsResult& result);
/// Heat equilibrium (Baran and Popovic, Automatic Rigging and Animation of 3D Characters, 2007;
/// Blender's automatic weights). Each vertex receives heat from the nearest handle, in proportion
/// to `heat` / d^2 for the distance d, if the straight segment to the handle is inside the shape.
/// Vertices on handles are fixed, so that every handle has an influence. In [0, 1] if cotangents
/// are positive. Report in addition to WeightsResult's keys: counts.heated_vertices (vertices with
/// a line of sight). Cost: one factorization, and one solve per handle.
Status bone_heat_weights(const WeightsProblem& problem, const WeightsOptions& options,
  ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
