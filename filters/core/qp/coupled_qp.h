#ifndef bindpose_qp_coupled_qp_h
#define bindpose_qp_coupled_qp_h

#include "qp/box_qp.h"

namespace bindpose
{

/// The result of solve_coupled_qp(): bounded weights whose rows sum to one as a constraint.
struct CoupledSolution
{
  /// See BoxQpSolution; invalid_input if bounds and pins admit no row that sums to one.
  Status status;
  /// One solution per column. The certificate of a column contains the gap and the residual of the
  /// whole problem, but the energy of that column. Rows sum to one, and weights are within the
  /// bounds.
  std::vector<BoxQpSolution> columns;
  Certificate certificate; ///< certificate of the whole problem, as described in coupled_qp.cpp
  Eigen::VectorXd multipliers; ///< #V, Lagrange multipliers of the row sums
  Index vertex = -1; ///< the vertex that caused invalid_input; -1: no such vertex
  int iterations = 0;
  int factorizations = 0;
  int inner_iterations = 0; ///< iterations of conjugate gradients
};

/// Minimize the sum of 1/2 w_j' Q w_j over all columns j, where w_j has one entry per vertex. The
/// constraints are:
/// - l <= w_j <= u for each column;
/// - fixed vertices have given values in every column;
/// - vertices that are pinned in column j have given values in this column only;
/// - each row, which contains the weights of one vertex, sums to one.
///
/// The method is a primal-dual interior-point method that starts from nearly optimal rows. Each
/// iteration computes one factorization per column, as in BoxQp, and finds the multipliers of the
/// row sums by conjugate gradients. Each step of conjugate gradients takes one solve per column.
/// The factors of all columns are in memory at the same time, in double precision. Cost and size:
/// filters/README.md.
/// @param q, fixed, columns see BoxQp. The members `pairs` and `start` of the columns are ignored.
/// @param start #V x #columns, weights whose rows nearly sum to one.
/// @param prepared a BoxQp for the same q and fixed vertices, after prepare().
CoupledSolution solve_coupled_qp(ExecutionContext& context, const SparseMatrix& q,
  const std::vector<Index>& fixed, const std::vector<BoxQpColumn>& columns,
  const Eigen::MatrixXd& start, const BoxQp& prepared, const BoxQpOptions& options);

} // namespace bindpose

#endif
