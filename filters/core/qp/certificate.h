#ifndef bindpose_qp_certificate_h
#define bindpose_qp_certificate_h

#include "geometry/laplacian.h"

#include <functional>
#include <string>
#include <vector>

namespace bindpose
{

/// The constraint w[low] + minimum_difference <= w[high] on the values of two vertices.
struct OrderedPair
{
  Index low = 0;
  Index high = 0;
  double minimum_difference = 0.0;
};

/// An optimality certificate of a column w: the residual of w, and an upper bound (the gap) on the
/// difference between the energy of w and the minimum energy.
///
/// Let ' denote the transpose. With ordered pairs G w >= h and their multipliers lambda >= 0, let
/// d = Q w - G' lambda. Without ordered pairs, let d = Q w. The dual of the quadratic program
/// bounds the minimum from below, so that
///   gap = lambda' (G w - h) + sum over free vertices of max(d (w - l), -d (u - w))
/// is a rigorous bound on E(w) - min E, independent of the method that computed w and lambda.
///
/// On needle-shaped elements, and for triharmonic energies, the round-off of Q w (1e-16 of Q's
/// entries) makes this sum large even if w is optimal. A second bound is equally rigorous, but its
/// error is only the square of the round-off. For any set R of vertices, with r = d in R and r = 0
/// at all other vertices,
///   gap = lambda' (G w - h) + (the sum above over all vertices not in R) + 1/2 r' A^-1 r
/// where A is Q's block of free vertices. If A^-1 is given, the smaller of the two bounds is used.
/// If w has no bounds, only the second bound is finite.
struct Certificate
{
  double relative_gap = 0.0; ///< gap / E (see certify for E = 0)
  /// Natural residual: max over free vertices of |w - clip(w - d / diag Q, l, u)|.
  double kkt_residual = 0.0;
  double energy = 0.0; ///< E = 1/2 w' Q w
  /// Largest violation of an ordered pair, w[low] + minimum_difference - w[high]; 0 if all pairs
  /// are satisfied.
  double order_violation = 0.0;
  double bounds_violation = 0.0; ///< largest distance of an entry of w from [l, u]
};

/// Bounds l <= w <= u with one value per vertex. Infinite values mean that there is no bound.
struct Bounds
{
  Eigen::VectorXd lower; ///< #V; empty: 0 everywhere
  Eigen::VectorXd upper; ///< #V; empty: 1 everywhere

  double low(Index v) const { return this->lower.size() ? this->lower[v] : 0.0; }
  double high(Index v) const { return this->upper.size() ? this->upper[v] : 1.0; }
};

/// The quadratic program min 1/2 w' Q w subject to l <= w <= u, where w is given at the vertices
/// that are not free.
struct BoundedEnergy
{
  const SparseMatrix& q; ///< symmetric, #V x #V
  const std::vector<char>& free; ///< #V: 1 for vertices that are solved for
  Bounds bounds = {};
};

/// Compute the certificate of w (#V) from the problem's data alone. The relative gap is gap /
/// max(E, 1e-12 * mean diagonal of Q / 2), because E is zero for a constant column.
/// @param pairs, multipliers the ordered pairs and their lambda >= 0, of equal length.
/// @param inverse r -> A^-1 r. The argument r has one entry per vertex (#V) and is zero at vertices
/// with given values.
Certificate certify(const BoundedEnergy& problem, const Eigen::VectorXd& w,
  const std::vector<OrderedPair>& pairs = {},
  const Eigen::VectorXd& multipliers = Eigen::VectorXd(),
  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& inverse = {});

/// Return "are not certified (relative gap …, residual …, tolerance …)", for use in a message.
std::string certificate_message(double relative_gap, double kkt_residual, double tolerance);

} // namespace bindpose

#endif
