#ifndef bindpose_domain_surface_smoothing_h
#define bindpose_domain_surface_smoothing_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Smooth functions along a surface. The result w minimizes ½∫(w - given)² + ½ length⁴ ∫(Δw)²,
/// where `given` is the input. The discretization uses linear elements and lumped mass. Wavelengths
/// below about 6 times `length` are damped.
///
/// Each column is solved separately by conjugate gradients, starting from the input values. The
/// iterations end when the residual is 1e-6 of its initial value, at the latest after 200
/// iterations. Every iteration lowers the energy. The preconditioner is a factorization of a
/// second-order matrix, with a correction for each fixed point. With this preconditioner, 7 or 8
/// iterations suffice. A build without CHOLMOD uses the diagonal as preconditioner and usually
/// takes all 200 iterations. Triangles with an angle below 2 degrees get smaller weights in the
/// matrix, because their large matrix entries would cause large round-off. Needle triangles and
/// triangle soups are therefore valid input. Constant functions do not change.
///
/// Cost: about 6 microseconds per point for analysis and factorization, then about 1 microsecond
/// per point and column. Memory: at most 480 MB for the corrections.
/// @param points,triangles any surface. Equal points must be merged. Triangles without area are
/// ignored.
/// @param fixed ids of points whose values do not change, ascending.
/// @param length smoothing length, in the unit of the points.
/// @param values #V x #columns, in and out.
/// @return false if canceled.
bool smooth_on_surface(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& fixed, double length, Eigen::MatrixXd& values);

} // namespace bindpose

#endif
