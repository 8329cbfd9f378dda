#ifndef bindpose_base_float_cholesky_h
#define bindpose_base_float_cholesky_h

#include "base/execution.h"
#include "base/sparse_solver.h"

#include <memory>

namespace bindpose
{

/// Sparse Cholesky factorisation in single precision on the analysis of a SparseSolver: half the
/// memory and half the time of a factorisation in double precision by CHOLMOD. Its solutions are
/// good to 1e-3 or better on meshes: it is meant to be a preconditioner of conjugate gradients.
///
/// The matrix is scaled to a unit diagonal before it is rounded. As with SparseSolver, only the
/// lower triangle is read, an object factors on one thread at a time, and clones share what was
/// analysed. The bits do not depend on threads.
///
/// Duff and Reid 1983, The multifrontal solution of indefinite sparse symmetric linear equations.
class FloatCholesky
{
public:
  /// Nothing to factor yet.
  FloatCholesky();
  ~FloatCholesky();
  FloatCholesky(FloatCholesky&&) noexcept;
  FloatCholesky& operator=(FloatCholesky&&) noexcept;

  /// Takes over the solver's analysis of this matrix. unavailable when the solver has no supernodes
  /// (Eigen's backend) or when the build has no BLAS of its own (without CHOLMOD).
  Status analyse(const SparseSolver& solver, const SparseMatrix& matrix);
  /// An object with this one's analysis and no factorisation, for use on another thread.
  FloatCholesky clone() const;
  /// False before analyse() and where it is unavailable.
  bool analysed() const;

  /// Factors a matrix of the analysed pattern plus shift times its diagonal. invalid_input when
  /// that is not positive definite in single precision: the message names the unknown at whose
  /// pivot that showed. Looks at cancel between dense blocks.
  Status factor(const SparseMatrix& matrix, double shift, const ExecutionContext& context);
  /// Solves approximately with the last factorisation; several threads may do so at once.
  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const;
  /// The same for many columns: several times faster a column.
  void solve(const Eigen::MatrixXd& rhs, Eigen::MatrixXd& x) const;

  /// Gives back what only factoring needs; the factor stays.
  void release_workspace();
  /// Bytes that this object's factor will take, and what factoring takes besides.
  double factor_bytes() const;
  double workspace_bytes() const;
  /// How often this object and all its clones factored.
  Index factorisations() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace bindpose

#endif
