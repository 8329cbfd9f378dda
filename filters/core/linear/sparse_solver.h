#ifndef bindpose_linear_sparse_solver_h
#define bindpose_linear_sparse_solver_h

#include "base/mesh_types.h"
#include "base/status.h"
#include "linear/sparse_matrix.h"

#include <Eigen/Core>

#include <memory>
#include <string>

namespace bindpose
{

struct Supernodes;

/// Sparse Cholesky factorization of symmetric positive definite matrices. The pattern is analyzed
/// once. Then any number of matrices of that pattern can be factored, and each factor solves for
/// any number of right-hand sides.
///
/// Only the lower triangle of a matrix is read. An object may be used by one thread at a time. For
/// concurrent factorizations, use one clone() per thread; all clones share one analysis.
///
/// The backend is CHOLMOD's supernodal method (dense blocks, BLAS; GPL) if it is built in.
/// Otherwise it is Eigen's SimplicialLDLT, which is several times slower on volume meshes. Both
/// backends are deterministic: METIS seeds its random generator itself, and analyses never run
/// concurrently.
class SparseSolver
{
public:
  enum class Backend
  {
    automatic, ///< CHOLMOD if it is built in, otherwise Eigen
    cholmod,
    eigen
  };
  enum class Ordering
  {
    automatic, ///< METIS above 500 unknowns, AMD below (Eigen's backend always uses AMD)
    metis, ///< nested dissection: smallest factor on meshes
    amd ///< approximate minimum degree: fastest to compute
  };
  struct Options
  {
    Backend backend = Backend::automatic;
    Ordering ordering = Ordering::automatic;
    /// MiB that the whole process may use; 0: all available memory. A factorization that needs more
    /// memory is rejected before it begins.
    Index memory_limit = 0;
  };

  SparseSolver();
  explicit SparseSolver(const Options& options);
  ~SparseSolver();
  SparseSolver(SparseSolver&&) noexcept;
  SparseSolver& operator=(SparseSolver&&) noexcept;

  /// Report whether this build has CHOLMOD.
  static bool has_cholmod();
  /// Return a warning for the user if CHOLMOD uses a BLAS that is not known to be fast (the
  /// reference BLAS is about 17 times slower than OpenBLAS), otherwise an empty string.
  static std::string blas_warning();

  /// Return "cholmod" or "eigen".
  const char* backend_name() const;

  /// Order the unknowns and find the pattern of the factor. The status is unavailable if the chosen
  /// backend is not built in. It is invalid_input if the matrix is not square or the factor would
  /// be too large.
  Status analyze(const SparseMatrix& matrix);
  /// Factor a matrix of the analyzed pattern. The status is invalid_input if the matrix is not
  /// positive definite; the message contains the unknown whose pivot failed. The status is
  /// internal_error if the factor does not fit into memory.
  Status factor(const SparseMatrix& matrix);
  /// Solve for the columns of rhs with the last factorization.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const;
  /// Solve for one column. If x already has the right size, the memory of x is reused.
  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const;

  /// Return a solver with the same analysis and no factorization, for use on another thread.
  SparseSolver clone() const;

  /// Return the positions of the factor's nonzeros, which other factorizations reuse (see
  /// FloatCholesky). The result is null for Eigen's backend and before analyze().
  std::shared_ptr<const Supernodes> supernodes() const;

  /// Return the memory of this object's factor in bytes, which is known after analyze().
  double factor_bytes() const;
  /// Return the number of unknowns. factor_nonzeros() returns the number of nonzeros of the factor,
  /// and factor_operations() the number of floating-point operations of one factorization.
  Index size() const;
  double factor_nonzeros() const;
  double factor_operations() const;
  /// Return the total number of analyses by this solver and all its clones. factorizations()
  /// returns the total number of their factorizations.
  Index analyses() const;
  Index factorizations() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace bindpose

#endif
