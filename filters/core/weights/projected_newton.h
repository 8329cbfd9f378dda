#ifndef bindpose_weights_projected_newton_h
#define bindpose_weights_projected_newton_h

#include "weights/interior_point.h"

#include <functional>

namespace bindpose
{

/// r -> an approximation of A^-1 r, symmetric and positive definite.
using Preconditioner = std::function<void(const Eigen::VectorXd& r, Eigen::VectorXd& z)>;

/// Brings a point that is already close to the minimiser of 1/2 x'Ax + c'x, l <= x <= u, closer, by
/// rounds of a projected Newton method whose systems are solved by a few steps of conjugate
/// gradients. Makes no factorisation: the cost is 5 to 20 calls of the preconditioner.
/// Says nothing about optimality: that is the certificate's business.
///
/// Bertsekas 1982, Projected Newton methods for optimization problems with simple constraints.
/// @param pinned free: 1 where x must stay as it is.
/// @param lower, upper free: the bounds l and u.
/// @param rounds at most so many.
/// @param enough stop when a round moves no entry by more than that.
/// @param x free, within the bounds before and after.
/// @return the largest move of the last round.
double projected_newton(const SplitForm& matrices, const Eigen::VectorXd& c,
  const std::vector<char>& pinned, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
  const Preconditioner& preconditioner, int rounds, double enough, const ExecutionContext& context,
  Eigen::VectorXd& x);

} // namespace bindpose

#endif
