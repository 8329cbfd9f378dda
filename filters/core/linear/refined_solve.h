#ifndef bindpose_linear_refined_solve_h
#define bindpose_linear_refined_solve_h

// Solutions in double precision by conjugate gradients, preconditioned with a factor in single
// precision.

#include "linear/float_cholesky.h"

#include <functional>

namespace bindpose
{

/// Options of refined_solve().
struct RefinedSolveOptions
{
  /// Target for |residual| / |right-hand side|, in the norm weighted by the inverse diagonal of A.
  double accuracy = 1e-14;
  /// Maximum number of conjugate gradient steps. One or two steps reach 1e-4; 5 to 12 steps reach
  /// the limit of double precision.
  int most_steps = 20;
  /// Source of cancel requests, checked before each step; may be null.
  const ExecutionContext* context = nullptr;
};

/// Solve A x = b to double precision for all columns of b together. The method is conjugate
/// gradients, preconditioned with a factor in single precision.
/// @param multiply returns A P for a matrix P. P has one column for each column of b that has not
/// converged yet.
/// @param inverse_diagonal #unknowns, inverse of the diagonal of A
/// @return the largest relative residual of all columns, in the same norm as `accuracy`; 1 if
/// canceled.
double refined_solve(const FloatCholesky& factor,
  const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& multiply,
  const Eigen::VectorXd& inverse_diagonal, const Eigen::MatrixXd& rhs,
  const RefinedSolveOptions& options, Eigen::MatrixXd& x);

} // namespace bindpose

#endif
