#ifndef bindpose_weights_box_qp_workspace_h
#define bindpose_weights_box_qp_workspace_h

#include "base/float_cholesky.h"
#include "base/sparse_solver.h"

#include <algorithm>
#include <functional>

namespace bindpose
{

/// The memory of one column's solve, used again for the next.
struct BoxQpWorkspace
{
  SparseSolver solver; ///< has analysed the pattern of lower
  FloatCholesky single; ///< has, too, where that is available
  SparseMatrix matrix; ///< of that pattern
};

/// r -> A^-1 r over all vertices (see certify).
using InverseForm = std::function<Eigen::VectorXd(const Eigen::VectorXd& r)>;

/// The largest move of a weight that counts as none. The gap is quadratic in the weights' error: a
/// certified iterate can be a thousand tolerances away from the minimiser.
inline double settled_move(double tolerance)
{
  return std::max(tolerance, std::min(5.0 * tolerance, 1.5e-6));
}

/// The largest last move of a projected Newton method that counts as none.
inline double settled_newton_move(double tolerance)
{
  return 0.1 * settled_move(tolerance);
}

} // namespace bindpose

#endif
