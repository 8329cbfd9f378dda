#ifndef bindpose_base_refined_solve_h
#define bindpose_base_refined_solve_h

#include "base/float_cholesky.h"

#include <functional>

namespace bindpose
{

struct RefinedSolveOptions
{
  /// Target for |residual| / |right-hand side|, in the norm of the inverse diagonal.
  double accuracy = 1e-14;
  /// Largest number of steps of conjugate gradients. One or two steps reach 1e-4; 5 to 12 steps
  /// reach the limit of double precision.
  int most_steps = 20;
  const ExecutionContext* context = nullptr; ///< checked for cancel before each step
};

/// Solve A x = b to double precision for all columns of b together. The method is conjugate
/// gradients, preconditioned with a factor in single precision.
/// @param multiply P -> A P; P contains the columns that have not converged yet
/// @param inverse_diagonal #unknowns, of A
/// @return the largest residual of a column, measured like `accuracy`; 1 if canceled.
double refined_solve(const FloatCholesky& factor,
  const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& multiply,
  const Eigen::VectorXd& inverse_diagonal, const Eigen::MatrixXd& rhs,
  const RefinedSolveOptions& options, Eigen::MatrixXd& x);

} // namespace bindpose

#endif
