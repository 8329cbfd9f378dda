#ifndef bindpose_weights_baseline_weights_h
#define bindpose_weights_baseline_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Weights that minimise no energy: what others use, to compare with. The integers are those of
/// vtkUnconstrainedWeights.
enum class BaselineMethod : int
{
  /// Shepard: w_j ~ 1 / d_j^power by straight distances. Knows nothing of the shape.
  inverse_distance = 6,
  /// Harmonic weights (Joshi et al., Harmonic Coordinates for Character Articulation, 2007),
  /// smoothed over a length: no peaks at points. Between harmonic and biharmonic ones; may leave
  /// [0, 1].
  smoothed_harmonic = 7,
  /// Heat equilibrium (Baran and Popovic, Automatic Rigging and Animation of 3D Characters, 2007;
  /// Blender's automatic weights): each vertex is heated by the handle nearest to it, where the
  /// straight line to that lies inside, by heat / d^2. Vertices on handles are fixed, so that
  /// something is bound always.
  bone_heat = 8
};

/// "inverse-distance", "smoothed-harmonic", "bone-heat"
const char* to_string(BaselineMethod method);

struct BaselineWeightsOptions : WeightsOptions
{
  BaselineMethod method = BaselineMethod::inverse_distance;
  double power = 2.0; ///< inverse_distance: > 0
  /// smoothed_harmonic: over what length, as a fraction of the diagonal, >= 0.
  double smoothing = 0.05;
  double heat = 1.0; ///< bone_heat: > 0; more makes weights switch faster between handles
};

/// Rows sum to one; inverse distances are within [0, 1], bone heat where cotangents are positive.
/// Nothing is minimised:
/// the certificate's gap is 0 and its residual is that of the linear system, relative. One
/// factorisation and one solve a handle (two when smoothed), none for inverse distances.
/// Report besides WeightsResult's keys, of bone_heat: counts.heated_vertices (with a line of
/// sight).
Status baseline_weights(const WeightsProblem& problem, const BaselineWeightsOptions& options,
  ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
