#ifndef bindpose_qp_splitting_start_h
#define bindpose_qp_splitting_start_h

#include "linear/float_cholesky.h"
#include "qp/box_qp_column.h"
#include "qp/split_form.h"

#include <vector>

namespace bindpose
{

/// An initial guess for the minimizer of one column (see BoxQp).
struct ColumnStart
{
  Eigen::VectorXd x; ///< the guess, one entry per free vertex, within the bounds; empty: no guess
  std::vector<char> at_bound; ///< per free vertex: 1 if x is given or expected to be at a bound
  /// Barrier weight. If mu > 0, x is near a point of the central path, and `at_bound` is empty. The
  /// points of the central path minimize the energy plus a barrier instead of the bounds. The
  /// barrier of each vertex is
  ///   -mu (log(x - l) + log(u - x)).
  double mu = 0.0;
};

/// Guess the minimizers of all columns and their active bounds by Douglas-Rachford splitting with
/// Anderson acceleration. One factorization in single precision serves all columns and iterations;
/// each iteration is one solve for all columns together. The result is bitwise the same for any
/// number of threads. Every iteration checks for cancel.
/// Cost per column, in factorizations in double precision: 0.5 to 1 for eight columns, about 2 for
/// a single column.
///
/// Douglas and Rachford 1956; Eckstein and Bertsekas 1992; Walker and Ni 2011 for Anderson
/// acceleration.
/// @param barriers if true, compute points of the central path with a relative gap of about 1e-4.
/// If false, compute minimizers within the bounds.
/// @param unconstrained #V x #columns, the minimizers without bounds.
/// @param single a solver that has analyzed matrices.lower. This function uses the solver for its
/// factorization.
/// @return one start per column. A start is empty if the factorization fails, if the call is
/// canceled, or if barriers are requested and the column's energy without bounds is zero.
std::vector<ColumnStart> splitting_start(ExecutionContext& context, const SplitForm& matrices,
  const std::vector<BoxQpColumn>& columns, bool barriers, const Eigen::MatrixXd& unconstrained,
  FloatCholesky& single);

} // namespace bindpose

#endif
