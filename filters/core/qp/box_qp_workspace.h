#ifndef bindpose_qp_box_qp_workspace_h
#define bindpose_qp_box_qp_workspace_h

#include "linear/float_cholesky.h"
#include "linear/sparse_solver.h"

#include <algorithm>
#include <functional>

namespace bindpose
{

/// The memory for solving one column (see BoxQp), reused for the next column.
struct BoxQpWorkspace
{
  SparseSolver solver; ///< solver in double precision; has analyzed the pattern of SplitForm::lower
  /// Solver in single precision. If single precision is available, this solver has also analyzed
  /// the pattern of SplitForm::lower.
  FloatCholesky single;
  SparseMatrix matrix; ///< the matrix to factor, with the pattern of SplitForm::lower
};

/// The map r -> A^-1 r. Vectors have one entry per vertex (see certify).
using InverseForm = std::function<Eigen::VectorXd(const Eigen::VectorXd& r)>;

/// Return the maximum change of a weight in one iteration at which a column counts as converged.
/// The certificate alone is not a sufficient criterion, because the gap is quadratic in the error
/// of the weights. The weights of a certified iterate can differ from the minimizer by a thousand
/// times the tolerance.
inline double converged_change(double tolerance)
{
  return std::max(tolerance, std::min(5.0 * tolerance, 1.5e-6));
}

/// Return the maximum change of a weight in one round at which a projected Newton method counts as
/// converged.
inline double converged_newton_change(double tolerance)
{
  return 0.1 * converged_change(tolerance);
}

} // namespace bindpose

#endif
