#ifndef bindpose_weights_interior_point_h
#define bindpose_weights_interior_point_h

#include "weights/box_qp.h"
#include "weights/box_qp_workspace.h"
#include "weights/splitting_start.h"

namespace bindpose
{

/// Solves for one column (see BoxQp).
/// @param unconstrained #V, the minimiser without bounds.
/// @param start a point nearly on the central path, used unless its mu is 0.
/// @param inverse asked for seldom.
BoxQpSolution interior_point(const SplitForm& matrices, const BoxQpOptions& options,
  const BoxQpColumn& column, const Eigen::VectorXd& unconstrained, const ColumnStart& start,
  const InverseForm& inverse, BoxQpWorkspace& workspace, ExecutionContext& context);

} // namespace bindpose

#endif
