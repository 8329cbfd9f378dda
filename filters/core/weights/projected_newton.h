#ifndef bindpose_weights_projected_newton_h
#define bindpose_weights_projected_newton_h

#include "base/execution.h"
#include "weights/column_problem.h"

#include <functional>
#include <vector>

namespace bindpose
{

/// r -> an approximation of A^-1 r, symmetric and positive definite.
using Preconditioner = std::function<void(const Eigen::VectorXd& r, Eigen::VectorXd& z)>;

/// The vertices that a bound holds at x: those whose own Newton step, with all others fixed, would
/// cross a bound. Pinned ones, too.
/// @param gradient Ax + c.
/// @return free: 1 where it does.
std::vector<char> held_vertices(const SplitForm& matrices, const ColumnProblem& problem,
  const Eigen::VectorXd& gradient, const Eigen::VectorXd& x);

/// Brings a point that is already close to the minimiser of 1/2 x'Ax + c'x, l <= x <= u, closer, by
/// rounds of a projected Newton method whose systems are solved by a few steps of conjugate
/// gradients. Makes no factorisation: the cost is 5 to 20 calls of the preconditioner.
/// Says nothing about optimality: that is the certificate's business.
///
/// Bertsekas 1982, Projected Newton methods for optimization problems with simple constraints.
/// @param rounds at most so many.
/// @param enough stop when a round moves no entry by more than that.
/// @param x free, within the bounds before and after.
/// @return the largest move of the last round.
double projected_newton(const SplitForm& matrices, const ColumnProblem& problem,
  const Preconditioner& preconditioner, int rounds, double enough, const ExecutionContext& context,
  Eigen::VectorXd& x);

} // namespace bindpose

#endif
