#ifndef bindpose_qp_interior_point_h
#define bindpose_qp_interior_point_h

#include "qp/box_qp_column.h"
#include "qp/box_qp_workspace.h"
#include "qp/splitting_start.h"

namespace bindpose
{

/// Solve one column of bounded weights by a primal-dual interior-point method (see BoxQp).
/// @param unconstrained #V, the minimizer without bounds.
/// @param start a point near the central path; ignored if start.mu (see ColumnStart) is 0.
/// @param inverse multiplies a vector by A^-1, for the certificate; called rarely.
BoxQpSolution interior_point(ExecutionContext& context, const SplitForm& matrices,
  const BoxQpOptions& options, const BoxQpColumn& column, const Eigen::VectorXd& unconstrained,
  const ColumnStart& start, const InverseForm& inverse, BoxQpWorkspace& workspace);

} // namespace bindpose

#endif
