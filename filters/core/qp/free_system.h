#ifndef bindpose_qp_free_system_h
#define bindpose_qp_free_system_h

#include "base/execution.h"
#include "linear/sparse_solver.h"
#include "qp/split_form.h"

namespace bindpose
{

/// A solver of linear systems with given values at the fixed vertices. It factors the block of the
/// free vertices of a symmetric matrix, in double precision.
class FreeSystem
{
public:
  /// @param matrix #V x #V, both triangular halves stored, positive definite on the free vertices.
  /// @param fixed ids of the fixed vertices, each once.
  FreeSystem(const SparseMatrix& matrix, const std::vector<Index>& fixed);

  /// Factor the matrix. This must succeed before any solve.
  Status factor(ExecutionContext& context, const SparseSolver::Options& options);

  /// Let A be the matrix. Return the minimizers w (#V x m) of 1/2 w' A w with the given values at
  /// the fixed vertices. If all off-diagonal entries of A are <= 0, the relative errors are small
  /// even for tiny values.
  /// @param fixed_values #fixed x m.
  Eigen::MatrixXd minimizers(const Eigen::MatrixXd& fixed_values) const;

  /// Solve A w = rhs for the free rows of w, given rhs (#V x m) and the fixed rows of w.
  /// @return for each column, the largest quotient of residual and diagonal entry. The quotient of
  /// a vertex is the change of its value that would make its residual zero.
  Eigen::VectorXd solve(const Eigen::MatrixXd& rhs, Eigen::MatrixXd& w) const;

private:
  SplitForm form_;
  SparseSolver solver_;
};

} // namespace bindpose

#endif
