#ifndef bindpose_weights_baseline_weights_h
#define bindpose_weights_baseline_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Weights that minimize no energy: methods of other programs, for comparison. The integer values
/// are those of vtkUnconstrainedWeights.
enum class BaselineMethod : int
{
  /// Shepard: w_j ~ 1 / d_j^power with straight-line distances. Ignores the shape.
  inverse_distance = 6,
  /// Harmonic weights (Joshi et al., Harmonic Coordinates for Character Articulation, 2007),
  /// smoothed over a length, which removes the peaks at points. They are between harmonic and
  /// biharmonic weights and may leave [0, 1].
  smoothed_harmonic = 7,
  /// Heat equilibrium (Baran and Popovic, Automatic Rigging and Animation of 3D Characters, 2007;
  /// Blender's automatic weights). Each vertex is heated by the nearest handle with heat / d^2, if
  /// the straight segment to the handle is inside the shape. Vertices on handles are fixed, so that
  /// every handle has an influence.
  bone_heat = 8
};

/// Return "inverse-distance", "smoothed-harmonic" or "bone-heat".
const char* to_string(BaselineMethod method);

struct BaselineWeightsOptions : WeightsOptions
{
  BaselineMethod method = BaselineMethod::inverse_distance;
  double power = 2.0; ///< inverse_distance: > 0
  /// smoothed_harmonic: smoothing length as a fraction of the diagonal, >= 0.
  double smoothing = 0.05;
  double heat = 1.0; ///< bone_heat: > 0; larger values make the transition between handles sharper
};

/// Compute baseline weights. Rows sum to one. Inverse distances are in [0, 1]; so is bone heat if
/// cotangents are positive. No energy is minimized: the certificate's gap is 0, and its residual is
/// the relative residual of the linear system.
/// Cost: one factorization and one solve per handle (two factorizations with smoothing); none for
/// inverse distances.
/// Report in addition to WeightsResult's keys, for bone_heat: counts.heated_vertices (vertices with
/// a line of sight).
Status baseline_weights(const WeightsProblem& problem, const BaselineWeightsOptions& options,
  ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
