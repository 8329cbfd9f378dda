#ifndef bindpose_weights_surface_smoothing_h
#define bindpose_weights_surface_smoothing_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Smooths functions on a surface: the minimizer of ½∫(w - given)² + ½ length⁴ ∫(Δw)², with linear
/// elements and lumped mass, so that waves shorter than about 6 lengths fade.
///
/// Solved by conjugate gradients from the given values, each column by itself, until the residual
/// has fallen to 1e-6 of its start, or for 200 iterations: every iterate has a lower energy than
/// the one before, so needle triangles and soups do no harm. Angles below 2 degrees count as 2:
/// smaller ones would couple their points by more than round-off allows. Constants stay as they
/// are.
/// @param points,triangles any surface whose equal points are one; triangles without an area count
/// as nothing.
/// @param fixed ids of points whose values stay, ascending.
/// @param values #V x #columns, in and out.
/// @return false when cancelled.
/// Cost: about 0.1 us per point, column and iteration; a few iterations where edges are as long as
/// `length`, 50 where they are a seventh of it.
bool smooth_on_surface(PointsView points, TrianglesView triangles, const std::vector<Index>& fixed,
  double length, Eigen::MatrixXd& values, ExecutionContext& context);

} // namespace bindpose

#endif
