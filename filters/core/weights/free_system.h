#ifndef bindpose_weights_free_system_h
#define bindpose_weights_free_system_h

#include "base/execution.h"
#include "base/sparse_solver.h"
#include "weights/split_form.h"

namespace bindpose
{

/// A symmetric matrix whose block of the vertices that are solved for is factored, in double
/// precision: linear systems with given values at the fixed vertices.
class FreeSystem
{
public:
  /// @param matrix #V x #V, both triangles, definite on the vertices left free.
  /// @param fixed ids of the fixed vertices, each once.
  FreeSystem(const SparseMatrix& matrix, const std::vector<Index>& fixed);

  /// Must succeed before anything is solved.
  Status factor(const SparseSolver::Options& options, ExecutionContext& context);

  /// #V x m: the minimisers of 1/2 w' A w with these values at the fixed vertices (#fixed x m).
  /// Of a matrix whose off-diagonal entries are all <= 0 they have small relative errors, even
  /// where they are tiny.
  Eigen::MatrixXd minimisers(const Eigen::MatrixXd& fixed_values) const;

  /// The free rows of w from the right-hand side (#V x m) and w's fixed rows.
  /// @return of each column the largest residual, as the change of one vertex that would mend it.
  Eigen::VectorXd solve(const Eigen::MatrixXd& rhs, Eigen::MatrixXd& w) const;

private:
  SplitForm form_;
  SparseSolver solver_;
};

} // namespace bindpose

#endif
