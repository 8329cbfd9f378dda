#ifndef bindpose_weights_barrier_start_h
#define bindpose_weights_barrier_start_h

#include "base/float_cholesky.h"
#include "weights/interior_point.h"

namespace bindpose
{

/// For every column nearly the minimiser of
///   1/2 x'Ax + c'x - mu sum (log(x - l) + log(u - x))
/// with a mu that leaves a relative gap of about 1e-4, by Douglas-Rachford splitting with Anderson
/// acceleration: one factorisation in single precision for all columns and steps, and as many
/// solves for all columns at once as there are steps. Cost: 0.5 to 1 factorisation in double
/// precision a column when there are eight, about 2 for a single one. The same bits for any number
/// of threads. Looks at cancel in every step.
///
/// Douglas and Rachford 1956; Eckstein and Bertsekas 1992; Walker and Ni 2011 for Anderson
/// acceleration.
/// @param unconstrained #V x #columns, the minimisers without bounds.
/// @param single has analysed matrices.lower; it is factored here.
/// @return one start a column; a mu of 0 where there is none: the energy is zero, the factorisation
/// fails, or it was cancelled.
std::vector<CentralStart> barrier_start(const SplitForm& matrices,
  const std::vector<BoxQpColumn>& columns, const Eigen::MatrixXd& unconstrained,
  FloatCholesky& single, ExecutionContext& context);

} // namespace bindpose

#endif
