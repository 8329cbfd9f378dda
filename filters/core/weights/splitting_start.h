#ifndef bindpose_weights_splitting_start_h
#define bindpose_weights_splitting_start_h

#include "base/float_cholesky.h"
#include "weights/box_qp.h"
#include "weights/split_form.h"

#include <vector>

namespace bindpose
{

/// An initial guess for the minimizer of one column.
struct ColumnStart
{
  Eigen::VectorXd x; ///< free, within the bounds; empty: no guess
  std::vector<char> held; ///< free: 1 if x is given or expected to be at a bound
  /// If above 0, x is near the minimizer with a barrier mu (-log(x - l) - log(u - x)) per vertex in
  /// place of the bounds, which is a point of the central path, and `held` is empty.
  double mu = 0.0;
};

/// Guess the minimizers of all columns and their active bounds by Douglas-Rachford splitting with
/// Anderson acceleration. One factorization in single precision serves all columns and steps; each
/// step is one solve for all columns together. The bits of the result do not depend on the number
/// of threads. Every step checks for cancel.
/// Cost: 0.5 to 1 factorization in double precision per column for eight columns, about 2 for a
/// single column.
///
/// Douglas and Rachford 1956; Eckstein and Bertsekas 1992; Walker and Ni 2011 for Anderson
/// acceleration.
/// @param barriers compute points of the central path, with a relative gap of about 1e-4.
/// @param unconstrained #V x #columns, the minimizers without bounds.
/// @param single has analyzed matrices.lower; it is factored here.
/// @return one start per column. It is empty if the factorization fails, if the call is canceled,
/// or if barriers are requested and the energy is zero.
std::vector<ColumnStart> splitting_start(const SplitForm& matrices,
  const std::vector<BoxQpColumn>& columns, bool barriers, const Eigen::MatrixXd& unconstrained,
  FloatCholesky& single, ExecutionContext& context);

} // namespace bindpose

#endif
