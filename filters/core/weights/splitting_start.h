#ifndef bindpose_weights_splitting_start_h
#define bindpose_weights_splitting_start_h

#include "base/float_cholesky.h"
#include "weights/box_qp.h"
#include "weights/split_form.h"

#include <vector>

namespace bindpose
{

/// A guess at one column's minimiser.
struct ColumnStart
{
  Eigen::VectorXd x; ///< free, within the bounds; empty: none
  std::vector<char> held; ///< free: 1 where a bound is expected to hold x, or where x is given
  /// Above 0: x is near the minimiser with a barrier mu (-log(x - l) - log(u - x)) a vertex instead
  /// of bounds, a point of the central path, and there is no `held`.
  double mu = 0.0;
};

/// Guesses the minimisers of all columns, and which bounds hold them, by Douglas-Rachford splitting
/// with Anderson acceleration: one factorisation in single precision for all columns and steps, and
/// as many solves for all columns at once as there are steps. Cost: 0.5 to 1 factorisation in
/// double precision a column when there are eight, about 2 for a single one. The same bits for any
/// number of threads. Looks at cancel in every step.
///
/// Douglas and Rachford 1956; Eckstein and Bertsekas 1992; Walker and Ni 2011 for Anderson
/// acceleration.
/// @param barriers points of the central path, with a relative gap of about 1e-4.
/// @param unconstrained #V x #columns, the minimisers without bounds.
/// @param single has analysed matrices.lower; it is factored here.
/// @return one start a column; none where the factorisation fails, where the energy is zero and
/// barriers are asked for, or where it was cancelled.
std::vector<ColumnStart> splitting_start(const SplitForm& matrices,
  const std::vector<BoxQpColumn>& columns, bool barriers, const Eigen::MatrixXd& unconstrained,
  FloatCholesky& single, ExecutionContext& context);

} // namespace bindpose

#endif
