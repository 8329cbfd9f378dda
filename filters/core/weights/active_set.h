#ifndef bindpose_weights_active_set_h
#define bindpose_weights_active_set_h

#include "weights/box_qp.h"
#include "weights/box_qp_workspace.h"
#include "weights/splitting_start.h"

namespace bindpose
{

/// Solve one column without ordered pairs, from a good guess of its active bounds. A projected
/// Newton method solves its systems with a factor of A without the vertices that were held at a
/// bound when the factor was computed. One to three factorizations are usual, each with 5 to 20
/// solves.
///
/// Hintermueller, Ito and Kunisch 2003, The primal-dual active set strategy as a semismooth Newton
/// method; Bertsekas 1982.
/// @param inverse called rarely.
/// @return not_converged, with the last iterate, if the guess was not good enough.
BoxQpSolution active_set(const SplitForm& matrices, const BoxQpOptions& options,
  const BoxQpColumn& column, const ColumnStart& start, const InverseForm& inverse,
  BoxQpWorkspace& workspace, ExecutionContext& context);

} // namespace bindpose

#endif
