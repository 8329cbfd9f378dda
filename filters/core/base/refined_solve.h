#ifndef bindpose_base_refined_solve_h
#define bindpose_base_refined_solve_h

#include "base/float_cholesky.h"

#include <functional>

namespace bindpose
{

struct RefinedSolveOptions
{
  /// |residual| / |right-hand side| that is wanted, in the norm of the inverse diagonal.
  double accuracy = 1e-14;
  /// Of conjugate gradients. One or two bring 1e-4; 5 to 12 the limit of double precision.
  int most_steps = 20;
  const ExecutionContext* context = nullptr; ///< asked before each step whether to stop
};

/// Solves A x = b to double precision with a factor in single precision, for all columns of b side
/// by side: conjugate gradients preconditioned by it.
/// @param multiply P -> A P; the columns of P are those that are not there yet.
/// @param inverse_diagonal of A, #unknowns.
/// @return the residual reached, as accuracy: the largest column's.
double refined_solve(const FloatCholesky& factor,
  const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& multiply,
  const Eigen::VectorXd& inverse_diagonal, const Eigen::MatrixXd& rhs,
  const RefinedSolveOptions& options, Eigen::MatrixXd& x);

} // namespace bindpose

#endif
