#ifndef bindpose_weights_coupled_qp_h
#define bindpose_weights_coupled_qp_h

#include "weights/box_qp.h"

namespace bindpose
{

struct CoupledSolution
{
  /// As in BoxQpSolution; invalid_input if bounds and pins allow no row that sums to one.
  Status status;
  /// One solution per column. Its certificate contains the gap and the residual of the whole
  /// problem and the energy of the column. Rows sum to one, within the bounds.
  std::vector<BoxQpSolution> columns;
  Certificate certificate; ///< of the whole problem, as described in coupled_qp.cpp
  Eigen::VectorXd multipliers; ///< #V, of the row sums
  Index vertex = -1; ///< the vertex that an invalid_input refers to
  int iterations = 0;
  int factorizations = 0;
  int inner_iterations = 0; ///< iterations of conjugate gradients
};

/// Solve min sum of 1/2 w_j' Q w_j over all columns j, subject to l <= w <= u, the columns' fixed
/// and pinned values, and rows that sum to one.
///
/// The method is a primal-dual interior-point method that starts from nearly optimal rows. Each
/// iteration factors Q once per column, as BoxQp does, and computes the multipliers of the row sums
/// by conjugate gradients, whose steps take one solve per column. The factors of all columns are in
/// memory at the same time, in double precision. Cost and size: filters/README.md.
/// @param q, fixed, columns see BoxQp; ordered pairs and starts are not used.
/// @param start #V x #columns.
/// @param prepared a solver of the same q and fixed vertices.
CoupledSolution solve_coupled_qp(const SparseMatrix& q, const std::vector<Index>& fixed,
  const std::vector<BoxQpColumn>& columns, const Eigen::MatrixXd& start, const BoxQp& prepared,
  const BoxQpOptions& options, ExecutionContext& context);

} // namespace bindpose

#endif
