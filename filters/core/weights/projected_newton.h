#ifndef bindpose_weights_projected_newton_h
#define bindpose_weights_projected_newton_h

#include "base/execution.h"
#include "weights/column_problem.h"

#include <functional>
#include <vector>

namespace bindpose
{

/// r -> an approximation of A^-1 r; symmetric and positive definite.
using Preconditioner = std::function<void(const Eigen::VectorXd& r, Eigen::VectorXd& z)>;

/// Return the vertices that are held at a bound: those whose own Newton step from x, with all
/// others fixed, would reach or cross a bound. Pinned vertices are included.
/// @param gradient Ax + c.
/// @return free: 1 for held vertices.
std::vector<char> held_vertices(const SplitForm& matrices, const ColumnProblem& problem,
  const Eigen::VectorXd& gradient, const Eigen::VectorXd& x);

/// Improve a point that is already close to the minimizer of 1/2 x'Ax + c'x, l <= x <= u, by rounds
/// of a projected Newton method. Its systems are solved by a few steps of conjugate gradients. No
/// factorization is computed: the cost is 5 to 20 calls of the preconditioner. Optimality is not
/// tested; the certificate does that.
///
/// Bertsekas 1982, Projected Newton methods for optimization problems with simple constraints.
/// @param rounds largest number of rounds.
/// @param enough stop if a round moves no entry by more than this.
/// @param x free, within the bounds before and after.
/// @return the largest move of the last round.
double projected_newton(const SplitForm& matrices, const ColumnProblem& problem,
  const Preconditioner& preconditioner, int rounds, double enough, const ExecutionContext& context,
  Eigen::VectorXd& x);

} // namespace bindpose

#endif
