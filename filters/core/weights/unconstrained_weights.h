#ifndef bindpose_weights_unconstrained_weights_h
#define bindpose_weights_unconstrained_weights_h

#include "weights/weights_problem.h"

namespace bindpose
{

/// Energies that are minimised with nothing but the values at the handles. The integers are those
/// of vtkUnconstrainedWeights.
enum class UnconstrainedMethod : int
{
  harmonic = 1, ///< int |grad w|^2: within [0, 1] where cotangents are positive, peaks at points
  biharmonic = 2, ///< int (Laplacian w)^2: smooth, the same on any mesh, leaves [0, 1]
  triharmonic = 3, ///< int |grad Laplacian w|^2: smoother, leaves [0, 1] further
  /// |K w|^2 without masses (Botsch and Kobbelt 2004): depends on where the mesh is fine. To
  /// compare.
  graph_biharmonic = 4,
  /// biharmonic, but for the boundary conditions: those that a linear function meets as well (Wang,
  /// Jacobson, Barbic, Kavan, Linear Subspace Design for Real-Time Shape Deformation, 2015). Point
  /// handles then carry affine maps exactly: sum w_j p_j = p. Needs four points that are not in a
  /// plane (three not in a line for flat shapes) to tell what is linear; with less, a millionth of
  /// the biharmonic energy decides, with a warning. Made for points: bones, constant along
  /// themselves, fit no linear function, and what it extrapolates beyond them overshoots far.
  linear_subspace = 5
};

/// "harmonic", "biharmonic", "triharmonic", "graph-biharmonic", "linear-subspace"
const char* to_string(UnconstrainedMethod method);

struct UnconstrainedWeightsOptions : WeightsOptions
{
  UnconstrainedMethod method = UnconstrainedMethod::biharmonic;
};

/// Weights without bounds: one factorisation, one solve a handle. Rows sum to one by themselves.
/// The certificate: distance of the energy from its minimum, and the largest Newton step of one
/// vertex, both relative.
Status unconstrained_weights(const WeightsProblem& problem,
  const UnconstrainedWeightsOptions& options, ExecutionContext& context, WeightsResult& result);

} // namespace bindpose

#endif
