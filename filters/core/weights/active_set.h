#ifndef bindpose_weights_active_set_h
#define bindpose_weights_active_set_h

#include "weights/box_qp.h"
#include "weights/box_qp_workspace.h"
#include "weights/splitting_start.h"

namespace bindpose
{

/// Solves for one column without ordered pairs, from a good guess at the bounds that hold it: a
/// projected Newton method whose systems are solved with a factor of A without the vertices that
/// were held when it was made. One to three factorisations are usual, each with 5 to 20 solves.
///
/// Hintermueller, Ito and Kunisch 2003, The primal-dual active set strategy as a semismooth Newton
/// method; Bertsekas 1982.
/// @param inverse asked for seldom.
/// @return not_converged where the guess was not good enough, with what it came to.
BoxQpSolution active_set(const SplitForm& matrices, const BoxQpOptions& options,
  const BoxQpColumn& column, const ColumnStart& start, const InverseForm& inverse,
  BoxQpWorkspace& workspace, ExecutionContext& context);

} // namespace bindpose

#endif
