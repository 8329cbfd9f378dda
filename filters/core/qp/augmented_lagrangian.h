#ifndef bindpose_qp_augmented_lagrangian_h
#define bindpose_qp_augmented_lagrangian_h

#include "qp/box_qp_column.h"
#include "qp/box_qp_workspace.h"
#include "qp/split_form.h"

namespace bindpose
{

/// Solve one column of bounded weights with ordered pairs by an augmented Lagrangian method. The
/// method needs single precision (workspace.single must have analyzed the pattern). Usually it
/// computes 5 to 20 factorizations of the block of vertices that are not at a bound. Each factor is
/// used for about ten solves. The interior-point method takes about 25 factorizations of the whole
/// matrix, many of them in double precision.
///
/// Hestenes 1969, Multiplier and gradient methods; Powell 1969, A method for nonlinear constraints
/// in minimization problems; Bertsekas 1982, Constrained optimization and Lagrange multiplier
/// methods.
/// @param start one entry per free vertex, the initial guess; a minimizer without ordered pairs is
/// best.
/// @param inverse multiplies a vector by A^-1, for the certificate; called rarely.
/// @return the solution. If the method does not converge, the status is not_converged, and the
/// weights are those of the last iteration.
BoxQpSolution augmented_lagrangian(ExecutionContext& context, const SplitForm& matrices,
  const BoxQpOptions& options, const BoxQpColumn& column, const Eigen::VectorXd& start,
  const InverseForm& inverse, BoxQpWorkspace& workspace);

} // namespace bindpose

#endif
