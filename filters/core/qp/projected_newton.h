#ifndef bindpose_qp_projected_newton_h
#define bindpose_qp_projected_newton_h

#include "base/execution.h"
#include "qp/column_problem.h"
#include "qp/free_conjugate_gradients.h"

#include <vector>

namespace bindpose
{

/// Return the active set of a Newton step: the pinned vertices, and all vertices for which a Newton
/// step of the vertex alone, starting from x, would end near a bound or cross it.
/// @param gradient Ax + c.
/// @param bound_margin distance from a bound that counts as near. Vertices far from the handle have
/// weights that are tiny but rarely 0. For these vertices, a Newton step of each vertex alone is
/// accurate enough, and the linear system of the other vertices is much smaller.
/// @return one entry per free vertex: 1 for vertices in the active set.
std::vector<char> vertices_at_bounds(const SplitForm& matrices, const ColumnProblem& problem,
  const Eigen::VectorXd& gradient, const Eigen::VectorXd& x, double bound_margin);

/// Return the distance from a bound that counts as near, for a projected Newton method that stops
/// when no entry changes by more than `small_change`.
inline double near_bound(double small_change)
{
  return 1e-2 * small_change;
}

/// Improve a point that is already close to the minimizer of 1/2 x'Ax + c'x subject to l <= x <= u,
/// by a projected Newton method. The linear systems are solved by a few iterations of conjugate
/// gradients. No factorization is computed, so the cost is 5 to 20 calls of the preconditioner.
/// This function does not test whether x is optimal; the caller must compute the certificate.
///
/// Bertsekas 1982, Projected Newton methods for optimization problems with simple constraints.
/// @param rounds maximum number of Newton rounds.
/// @param small_change the method stops after a round in which no entry changes by more than this.
/// @param x one entry per free vertex, within the bounds before and after.
/// @return the largest change of an entry in the last round.
double projected_newton(const ExecutionContext& context, const SplitForm& matrices,
  const ColumnProblem& problem, const Preconditioner& preconditioner, int rounds,
  double small_change, Eigen::VectorXd& x);

} // namespace bindpose

#endif
