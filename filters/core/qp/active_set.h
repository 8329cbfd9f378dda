#ifndef bindpose_qp_active_set_h
#define bindpose_qp_active_set_h

#include "qp/box_qp_column.h"
#include "qp/box_qp_workspace.h"
#include "qp/splitting_start.h"

namespace bindpose
{

/// Solve one column of bounded weights without ordered pairs. The start must be a good guess of the
/// vertices whose weight is at a bound. The method is a projected Newton method. Let A be the block
/// of the free vertices in the quadratic form. The factored matrix is A without the rows and
/// columns of the vertices at a bound. One to three factorizations are usual, each with 5 to 20
/// solves.
///
/// Hintermueller, Ito and Kunisch 2003, The primal-dual active set strategy as a semismooth Newton
/// method; Bertsekas 1982.
/// @param inverse multiplies a vector by A^-1, for the certificate; called rarely.
/// @return the solution. If the guess was not good enough, the status is not_converged, and the
/// weights are those of the last iteration.
BoxQpSolution active_set(ExecutionContext& context, const SplitForm& matrices,
  const BoxQpOptions& options, const BoxQpColumn& column, const ColumnStart& start,
  const InverseForm& inverse, BoxQpWorkspace& workspace);

} // namespace bindpose

#endif
