#ifndef bindpose_arap_reduced_basis_h
#define bindpose_arap_reduced_basis_h

// Basis of the displacements that satisfy all handle constraints with zero right-hand sides. The
// modes of the handles determine the constraints. The global step of reduced as-rigid-as-possible
// (reduced_solver.cpp) uses this basis.

#include "arap/reduced_space.h"
#include "linear/dense_cholesky.h"
#include "linear/thin_product.h"

#include <vector>

namespace bindpose
{

/// The orthogonal factor Q = I - V T V^T of a QR decomposition, stored as reflections (Schreiber
/// and Van Loan 1989). Z denotes the columns of Q after the first `rank` columns. They span the
/// orthogonal complement of the decomposed matrix's range.
class Reflections
{
public:
  Reflections() = default;
  /// @param packed Householder vectors in the lower triangle, as LAPACK and Eigen return them.
  /// @param factors Householder coefficients, as LAPACK and Eigen return them.
  /// @param rank number of columns of `packed` to use.
  Reflections(const Eigen::MatrixXd& packed, const Eigen::VectorXd& factors, Index rank);

  Index rank() const { return this->v_.cols(); }
  /// Compute the product M Z.
  void times_tail(const Eigen::MatrixXd& m, Eigen::Ref<Eigen::MatrixXd> product) const;
  Eigen::MatrixXd times_tail(const Eigen::MatrixXd& m) const;
  /// Return the matrix Z.
  Eigen::MatrixXd tail() const;
  /// Return Q X. The next function returns Q^T X.
  Coordinates reflect(const Coordinates& x) const;
  Coordinates reflect_transposed(const Coordinates& x) const;

private:
  Eigen::MatrixXd v_, t_;
  Eigen::MatrixXd tail_; ///< T times those columns of V^T that correspond to Z
};

/// The displacements D of a ReducedSpace that are possible for a choice of modes: D = D* + B Y with
/// coordinates Y. A handle of mode `full` prescribes its block of rows of D. D* has these
/// prescribed rows and moves the constrained positions to their targets. The columns of B span the
/// displacements that change neither the prescribed rows nor the constrained positions. They are
/// orthonormal in the stiffness H (B^T H B = I).
///
/// There are two methods. The robust method (make_robust) determines the ranks for any input and
/// factors the part of H for the free rows, which no handle in mode full prescribes: O(#free^3).
/// The quick method (make_fast) factors the whole matrix H once. After each choice of modes it only
/// applies reflections to that factor: O((#columns + #clusters) #columns #constraints). The quick
/// method requires that all ranks are numerically certain; otherwise it returns false.
class ReducedBasis
{
public:
  /// Compute B by the quick method, or by the robust method if the quick method returns false.
  /// @param stiffness H; it must be the same matrix in every call.
  /// @param free_dofs indices of the rows of D that no handle in mode full prescribes, ascending.
  /// @param position_rows matrix that maps D to the displacements of the constrained positions:
  /// #positions x #rows of D.
  void make(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const std::vector<Index>& free_dofs, const Eigen::MatrixXd& position_rows);

  /// Compute B by the robust or by the quick method. make_fast returns false if a rank is not
  /// certain or if the robust method would be faster.
  bool make_fast(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const std::vector<Index>& free_dofs, const Eigen::MatrixXd& position_rows);
  void make_robust(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const std::vector<Index>& free_dofs, const Eigen::MatrixXd& position_rows);

  /// Return the indices of constrained positions that depend linearly on other positions.
  const std::vector<Index>& redundant() const { return this->redundant_; }

  /// Return the number of columns of B.
  Index coordinates() const { return this->coordinates_; }
  /// Move the covariance C = K B to `covariance`. Call this once after make().
  void extract_covariance(Eigen::Ref<Eigen::MatrixXd> covariance);

  /// D* for one pose: the minimizer of 1/2 <D, H D> - <P, D> among all D that contain the blocks
  /// prescribed by handles in mode full, and satisfy the constrained positions in the least-squares
  /// sense.
  struct UnrotatedMinimizer
  {
    double energy = 0.0; ///< value of the minimized expression at D*
    Coordinates covariance; ///< covariances K D*
    Coordinates base_displacement; ///< robust method: D*; quick method: a copy of `given_blocks`
    Coordinates z; ///< quick method: coefficients z of D*
    Eigen::RowVector3d first; ///< target of the constraint that determines the translation t
  };
  /// Compute D* for one pose.
  /// @param load P
  /// @param given_blocks the blocks of D that handles in mode full prescribe; 0 in all other rows.
  /// @param position_residual target displacements of the constrained positions minus their
  /// displacements by `given_blocks`.
  UnrotatedMinimizer unrotated_minimizer(const ReducedSpace& space,
    const Eigen::MatrixXd& stiffness, const Coordinates& load, const Coordinates& given_blocks,
    const Coordinates& position_residual) const;
  /// Return D* + B Y.
  Coordinates displacement(const UnrotatedMinimizer& from, const Coordinates& y) const;

private:
  /// Factorization H = L L^T. The unknowns are the rows of D whose column of M is not empty. Each
  /// unknown is scaled so that this column has root mean square one. If a translation u of the
  /// whole shape has no energy, H is factored without the last unknown, and D = u t + E z.
  struct FullFactorization
  {
    bool tried = false, good = false;
    std::vector<Index> rows; ///< row of D of each unknown; the last unknown is always included
    Eigen::VectorXd scale; ///< scale of each row
    Eigen::VectorXd shift; ///< translation u, scaled to norm one; empty if u has energy
    DenseCholesky cholesky; ///< Cholesky factor L
    Eigen::MatrixXd directions; ///< E = L^-T
    Eigen::MatrixXd covariance; ///< covariances K E
  };
  void factor_full_matrix(const ReducedSpace& space, const Eigen::MatrixXd& stiffness);
  UnrotatedMinimizer robust_unrotated_minimizer(const ReducedSpace& space,
    const Eigen::MatrixXd& stiffness, const Coordinates& load, const Coordinates& given_blocks,
    const Coordinates& position_residual) const;
  /// Return the translation t that satisfies the first constraint.
  /// @param first target of the first constraint
  Eigen::RowVector3d shift_of(const Coordinates& z, const Eigen::RowVector3d& first) const;
  /// Add `change` to the rows of d that no handle in mode full prescribes.
  void add_free(const Coordinates& change, Coordinates& d) const;

  std::vector<Index> free_dofs_;
  std::vector<Index> redundant_;
  Index coordinates_ = 0;
  bool is_fast_ = false;

  // ---- robust method
  /// #free x #positions: maps position errors to the smallest displacement that corrects them.
  Eigen::MatrixXd particular_;
  Eigen::MatrixXd basis_; ///< B, #free x #coordinates
  Eigen::MatrixXd covariance_; ///< covariance C = K B; empty after extract_covariance()

  // ---- quick method. The constraints are A D = g, positions first. A reflection of the
  // constraints removes the translation t from all constraints except the first one. Then the first
  // constraint is rho t + shift_coupling^T z = g_0. The others are R^T (Q^T z) = h, where h
  // contains the g_i with i > 0.
  FullFactorization factorization_;
  std::vector<Index> free_indices_; ///< indices of the free unknowns in factorization_.rows
  Index constraints_ = 0;
  Eigen::VectorXd householder_; ///< vector v of the constraints' Householder reflection I - v v^T
  Eigen::VectorXd shift_coupling_;
  double rho_ = 1.0;
  Reflections reflections_; ///< orthogonal factor Q of the constraints
  Eigen::MatrixXd inverse_; ///< inverse transpose of the constraints' triangular factor, R^-T
};

} // namespace bindpose

#endif
