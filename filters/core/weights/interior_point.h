#ifndef bindpose_weights_interior_point_h
#define bindpose_weights_interior_point_h

#include "base/float_cholesky.h"
#include "weights/box_qp.h"
#include "weights/split_form.h"

namespace bindpose
{

/// What one column's solve needs and the next can use again.
struct BoxQpWorkspace
{
  SparseSolver solver; ///< has analysed the pattern of lower
  FloatCholesky single; ///< has, too, where that is available
  SparseMatrix matrix; ///< of that pattern
};

/// A point nearly on the central path: multipliers are mu / slack.
struct CentralStart
{
  Eigen::VectorXd x; ///< free
  double mu = 0.0; ///< 0: none
};

/// Solves for one column (see BoxQp).
/// @param unconstrained #V, the minimiser without bounds.
/// @param start used unless its mu is 0.
/// @param inverse r -> A^-1 r over all vertices (see certify), asked for seldom.
BoxQpSolution interior_point(const SplitForm& matrices, const BoxQpOptions& options,
  const BoxQpColumn& column, const Eigen::VectorXd& unconstrained, const CentralStart& start,
  const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& inverse, BoxQpWorkspace& workspace,
  ExecutionContext& context);

} // namespace bindpose

#endif
