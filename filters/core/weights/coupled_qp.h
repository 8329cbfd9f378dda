#ifndef bindpose_weights_coupled_qp_h
#define bindpose_weights_coupled_qp_h

#include "weights/box_qp.h"

namespace bindpose
{

struct CoupledSolution
{
  Status status; ///< as a BoxQpSolution's; invalid_input when bounds and pins leave no row
  /// One a column, certificates with the gap and the residual of the whole and the column's own
  /// energy. Rows sum to one, within the bounds.
  std::vector<BoxQpSolution> columns;
  Certificate certificate; ///< of the whole, see certify_coupled
  Eigen::VectorXd multipliers; ///< #V, of the rows' sums
  Index vertex = -1; ///< that an invalid_input is about
  int iterations = 0;
  int factorisations = 0;
  int inner_iterations = 0; ///< of conjugate gradients
};

/// min sum of 1/2 w_j' Q w_j over all columns j, subject to l <= w <= u, the columns' fixed and
/// pinned values, and rows that sum to one.
///
/// By a primal-dual interior-point method that starts from rows that nearly solve it. Each
/// iteration factors Q once a column, as BoxQp does, and finds the multipliers of the sums by
/// conjugate gradients, whose steps take a solve a column. Holds the factors of all columns at a
/// time, in double precision. Cost and size: filters/README.md.
/// @param q, fixed, columns see BoxQp; ordered pairs and starts are not used.
/// @param start #V x #columns.
/// @param prepared a solver of the same q and fixed vertices.
CoupledSolution solve_coupled_qp(const SparseMatrix& q, const std::vector<Index>& fixed,
  const std::vector<BoxQpColumn>& columns, const Eigen::MatrixXd& start, const BoxQp& prepared,
  const BoxQpOptions& options, ExecutionContext& context);

} // namespace bindpose

#endif
