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
/// the one before. The preconditioner is a factorization of a matrix of second order, with a
/// correction for each fixed point, with which 7 or 8 iterations are enough; a build without
/// CHOLMOD takes the diagonal and most often all 200. Triangles with an angle below 2 degrees count
/// for less, so that none couples its points by more than round-off allows: needles and soups do no
/// harm. Constants stay as they are.
/// @param points,triangles any surface whose equal points are one; triangles without an area count
/// as nothing.
/// @param fixed ids of points whose values stay, ascending.
/// @param values #V x #columns, in and out.
/// @return false when cancelled.
/// Cost: analysis and factorization, about 6 us per point; then about 1 us per point and column.
/// Memory: of corrections at most 320 MB.
bool smooth_on_surface(PointsView points, TrianglesView triangles, const std::vector<Index>& fixed,
  double length, Eigen::MatrixXd& values, ExecutionContext& context);

} // namespace bindpose

#endif
