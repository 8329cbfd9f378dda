#ifndef bindpose_base_sparse_solver_h
#define bindpose_base_sparse_solver_h

#include "base/laplacian.h"
#include "base/status.h"

#include <Eigen/Core>

#include <memory>
#include <string>

namespace bindpose
{

struct Supernodes;

/// Sparse Cholesky factorisation of symmetric positive definite matrices: the pattern is analysed
/// once, then any number of matrices of that pattern are factored, each solves for any number of
/// right-hand sides.
///
/// Only the lower triangle of a matrix is read. An object is used by one thread at a time; for
/// several factorisations at once take a clone() per thread: all clones share one analysis.
///
/// CHOLMOD's supernodal method (dense blocks, BLAS; GPL) when built with it, Eigen's SimplicialLDLT
/// otherwise, several times slower on meshes of volumes. Both are deterministic; METIS seeds its
/// own generator, and analyses never run at the same time.
class SparseSolver
{
public:
  enum class Backend
  {
    automatic, ///< CHOLMOD when built with it
    cholmod,
    eigen
  };
  enum class Ordering
  {
    automatic, ///< METIS above 500 unknowns, AMD below (Eigen's backend always takes AMD)
    metis, ///< nested dissection: least fill on meshes
    amd ///< minimum degree: fastest to compute
  };
  struct Options
  {
    Backend backend = Backend::automatic;
    Ordering ordering = Ordering::automatic;
    /// MiB that the whole process may hold; 0: as much as is available. What would take more is
    /// refused before it is begun.
    Index memory_limit = 0;
  };

  SparseSolver();
  explicit SparseSolver(const Options& options);
  ~SparseSolver();
  SparseSolver(SparseSolver&&) noexcept;
  SparseSolver& operator=(SparseSolver&&) noexcept;

  /// True when this build has CHOLMOD.
  static bool has_cholmod();
  /// A sentence for the user when CHOLMOD runs on a BLAS that is not known to be fast (the
  /// reference BLAS is about 17 times slower than OpenBLAS); empty otherwise.
  static std::string blas_warning();

  /// "cholmod" or "eigen".
  const char* backend_name() const;

  /// Orders the unknowns and finds the pattern of the factor. unavailable when the chosen backend
  /// is not built in; invalid_input when the matrix is not square or the factor would be too large.
  Status analyse(const SparseMatrix& matrix);
  /// Factors a matrix of the analysed pattern. invalid_input when it is not positive definite: the
  /// message names the unknown at whose pivot that showed. internal_error when the factor has no
  /// room in memory.
  Status factor(const SparseMatrix& matrix);
  /// Solves for the columns of rhs with the last factorisation.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const;
  /// The same without allocations of its own: the caller keeps x.
  void solve(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) const;

  /// A solver with this one's analysis and no factorisation, for use on another thread.
  SparseSolver clone() const;

  /// Where the factor's nonzeros are; null for Eigen's backend and before analyse(). For
  /// factorisations of another kind (see FloatCholesky).
  std::shared_ptr<const Supernodes> supernodes() const;

  /// Bytes that this object's factor will take; once it is there they are taken.
  double factor_bytes() const;
  /// Unknowns analysed, nonzeros of the factor, floating point operations of one factorisation.
  Index size() const;
  double factor_nonzeros() const;
  double factor_operations() const;
  /// How often this solver and all its clones analysed and factored.
  Index analyses() const;
  Index factorisations() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace bindpose

#endif
