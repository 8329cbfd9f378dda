#ifndef bindpose_weights_free_system_h
#define bindpose_weights_free_system_h

#include "base/execution.h"
#include "base/sparse_solver.h"
#include "weights/split_form.h"

namespace bindpose
{

/// Linear systems with given values at the fixed vertices. The block of the free vertices of a
/// symmetric matrix is factored in double precision.
class FreeSystem
{
public:
  /// @param matrix #V x #V, both triangles, positive definite on the free vertices.
  /// @param fixed ids of the fixed vertices, each once.
  FreeSystem(const SparseMatrix& matrix, const std::vector<Index>& fixed);

  /// Factor the matrix. This must succeed before any solve.
  Status factor(const SparseSolver::Options& options, ExecutionContext& context);

  /// Return the minimizers (#V x m) of 1/2 w' A w with these values at the fixed vertices (#fixed x
  /// m). If all off-diagonal entries of the matrix are <= 0, the relative errors are small even for
  /// tiny values.
  Eigen::MatrixXd minimizers(const Eigen::MatrixXd& fixed_values) const;

  /// Solve for the free rows of w, given the right-hand side (#V x m) and w's fixed rows.
  /// @return the largest residual of each column, as the change of a single vertex that would
  /// eliminate it (residual / diagonal entry).
  Eigen::VectorXd solve(const Eigen::MatrixXd& rhs, Eigen::MatrixXd& w) const;

private:
  SplitForm form_;
  SparseSolver solver_;
};

} // namespace bindpose

#endif
