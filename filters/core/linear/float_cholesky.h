#ifndef bindpose_linear_float_cholesky_h
#define bindpose_linear_float_cholesky_h

#include "base/execution.h"
#include "linear/sparse_solver.h"

#include <memory>
#include <vector>

namespace bindpose
{

/// Sparse Cholesky factorization in single precision that reuses the analysis of a SparseSolver.
/// Compared with CHOLMOD in double precision, the factorization takes half the memory and half the
/// time. For matrices of meshes the solutions are accurate to 1e-3 or better. The intended use is
/// as a preconditioner for conjugate gradients.
///
/// The matrix is scaled to a unit diagonal before it is rounded. As with SparseSolver, only the
/// lower triangle is read, an object factors on one thread at a time, and clones share the
/// analysis. The bits do not depend on the number of threads.
///
/// Method: Duff and Reid 1983, The multifrontal solution of indefinite sparse symmetric linear
/// equations.
class FloatCholesky
{
public:
  /// Construct an object without an analysis.
  FloatCholesky();
  ~FloatCholesky();
  FloatCholesky(FloatCholesky&&) noexcept;
  FloatCholesky& operator=(FloatCholesky&&) noexcept;

  /// Reuse the analysis that the solver computed for this matrix. The status is unavailable if the
  /// solver has no supernodes (Eigen's backend, or a build without CHOLMOD).
  Status analyze(const SparseSolver& solver, const SparseMatrix& matrix);
  /// Return an object with the same analysis and no factorization, for use on another thread.
  FloatCholesky clone() const;
  /// Report whether analyze() succeeded.
  bool is_analyzed() const;

  /// Factor the sum of a matrix of the analyzed pattern and `shift` times the diagonal of this
  /// matrix. The status is invalid_input if the sum is not positive definite in single precision;
  /// the message contains the unknown whose pivot failed. A cancel request is checked between dense
  /// blocks.
  Status factor(const ExecutionContext& context, const SparseMatrix& matrix, double shift);
  /// Factor the block of the unknowns that are not excluded. solve() then ignores the rows of the
  /// right-hand side that are excluded, and returns 0 for these unknowns. Excluded unknowns take no
  /// time. The order of elimination remains that of the whole matrix.
  /// @param excluded  one entry per unknown
  Status factor_block(
    const ExecutionContext& context, const SparseMatrix& matrix, const std::vector<char>& excluded);
  /// Solve approximately with the last factorization. Several threads may call this function
  /// concurrently.
  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const;
  /// Solve for the columns of rhs. For many columns, this is several times faster than one call of
  /// solve() per column.
  void solve(const Eigen::MatrixXd& rhs, Eigen::MatrixXd& x) const;

  /// Free the memory that only factor() needs; the factor is kept.
  void release_workspace();
  /// Return the memory of this object's factor in bytes. workspace_bytes() returns the additional
  /// bytes that factor() needs.
  double factor_bytes() const;
  double workspace_bytes() const;
  /// Return the total number of factorizations by this object and all its clones.
  Index factorizations() const;

private:
  bool has_pattern_of(const SparseMatrix& matrix) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace bindpose

#endif
