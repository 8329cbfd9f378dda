#ifndef bindpose_weights_surface_smoothing_h
#define bindpose_weights_surface_smoothing_h

#include "base/execution.h"
#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// Smooth functions on a surface. The result minimizes ½∫(w - given)² + ½ length⁴ ∫(Δw)², with
/// linear elements and lumped mass, so that waves shorter than about 6 lengths fade.
///
/// Each column is solved separately by conjugate gradients from the given values, until the
/// residual is reduced to 1e-6 of its initial value or for 200 iterations. Every iterate has a
/// lower energy than the one before. The preconditioner is a factorization of a second-order
/// matrix, with a correction for each fixed point; 7 or 8 iterations suffice with it. A build
/// without CHOLMOD uses the diagonal as preconditioner and usually takes all 200 iterations.
/// Triangles with an angle below 2 degrees have a reduced weight, so that the coupling of their
/// points stays within the limits of round-off. Needles and triangle soups are therefore harmless.
/// Constants do not change.
///
/// Cost: analysis and factorization, about 6 us per point; then about 1 us per point and column.
/// Memory: at most 320 MB for corrections.
/// @param points,triangles any surface whose equal points are merged; triangles without area are
/// ignored.
/// @param fixed ids of points whose values do not change, ascending.
/// @param values #V x #columns, in and out.
/// @return false if canceled.
bool smooth_on_surface(PointsView points, TrianglesView triangles, const std::vector<Index>& fixed,
  double length, Eigen::MatrixXd& values, ExecutionContext& context);

} // namespace bindpose

#endif
