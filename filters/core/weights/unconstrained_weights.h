#ifndef bindpose_weights_unconstrained_weights_h
#define bindpose_weights_unconstrained_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Energies that are minimized with no constraint except the values at the handles. The integer
/// values are those of vtkUnconstrainedWeights.
enum class UnconstrainedMethod : int
{
  harmonic = 1, ///< int |grad w|^2: in [0, 1] if cotangents are positive; has peaks at points
  biharmonic = 2, ///< int (Laplacian w)^2: smooth, independent of the mesh, leaves [0, 1]
  triharmonic = 3, ///< int |grad Laplacian w|^2: smoother, leaves [0, 1] further
  /// Minimizes |K w|^2 without masses (Botsch and Kobbelt 2004): depends on the density of the
  /// mesh. For comparison.
  graph_biharmonic = 4,
  /// Like biharmonic, with boundary conditions that a linear function satisfies as well (Wang,
  /// Jacobson, Barbic, Kavan, Linear Subspace Design for Real-Time Shape Deformation, 2015). Point
  /// handles then reproduce affine maps exactly: sum w_j p_j = p. This requires four points that
  /// are not in a plane (three not in a line for flat shapes). With fewer, a millionth of the
  /// biharmonic energy is added, with a warning. The method is intended for points. Bones, along
  /// which weights are constant, fit no linear function, and the extrapolation beyond them
  /// overshoots far.
  linear_subspace = 5
};

/// Return "harmonic", "biharmonic", "triharmonic", "graph-biharmonic" or "linear-subspace".
const char* to_string(UnconstrainedMethod method);

struct UnconstrainedWeightsOptions : WeightsOptions
{
  UnconstrainedMethod method = UnconstrainedMethod::biharmonic;
};

/// Compute weights without bounds: one factorization, one solve per handle. Rows sum to one without
/// normalization. The certificate contains the distance of the energy from its minimum and the
/// largest Newton step of one vertex, both relative.
Status unconstrained_weights(const WeightsProblem& problem,
  const UnconstrainedWeightsOptions& options, ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
