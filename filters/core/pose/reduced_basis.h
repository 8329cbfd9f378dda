#ifndef bindpose_pose_reduced_basis_h
#define bindpose_pose_reduced_basis_h

#include "base/dense_cholesky.h"
#include "base/thin_product.h"
#include "pose/reduced_space.h"

#include <vector>

namespace bindpose
{

/// The orthogonal factor Q = I - V T V^T of a QR decomposition, stored as its reflections
/// (Schreiber and Van Loan 1989). Z is the columns of Q after the first `rank`: they span the
/// orthogonal complement of the decomposed matrix's range.
class Reflections
{
public:
  Reflections() = default;
  /// @param packed lower triangle as LAPACK and Eigen return it.
  /// @param factors factors as LAPACK and Eigen return them.
  /// @param rank number of columns to use, at most all of `packed`.
  Reflections(const Eigen::MatrixXd& packed, const Eigen::VectorXd& factors, Index rank);

  Index rank() const { return this->v_.cols(); }
  /// Compute product = M Z.
  void times_tail(const Eigen::MatrixXd& m, Eigen::Ref<Eigen::MatrixXd> product) const;
  Eigen::MatrixXd times_tail(const Eigen::MatrixXd& m) const;
  /// Return Z.
  Eigen::MatrixXd tail() const;
  /// Return Q X or Q^T X.
  Coordinates turned(const Coordinates& x) const;
  Coordinates turned_back(const Coordinates& x) const;

private:
  Eigen::MatrixXd v_, t_;
  Eigen::MatrixXd tail_; ///< T times the rows of V^T for the columns of Z
};

/// The displacements D of a ReducedSpace that a choice of modes leaves open, D = D* + B Y. D* has
/// the given blocks and moves the constrained positions to their targets. The columns of B span the
/// displacements that change neither. They are orthonormal in the stiffness H (B^T H B = I).
///
/// There are two methods. The robust method (make_sturdily) determines the ranks of any input and
/// factors the open part, O(#open^3). The quick method (make_quickly) factors H as a whole once.
/// After each choice of modes it only rotates the columns of that factor,
/// O((#columns + #clusters) #columns #constraints). It requires that all ranks are numerically
/// certain; otherwise it returns false.
class ReducedBasis
{
public:
  /// Use the quick method, and the robust method if the quick one returns false.
  /// @param stiffness H; it must be the same matrix in every call.
  /// @param open rows of D that no full handle gives, ascending.
  /// @param held maps D to the displacements of the constrained positions: #positions x #rows of D.
  void make(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const std::vector<Index>& open, const Eigen::MatrixXd& held);

  /// Use one of the two methods. make_quickly returns false if a rank is not certain or if the
  /// robust method would be faster.
  bool make_quickly(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const std::vector<Index>& open, const Eigen::MatrixXd& held);
  void make_sturdily(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const std::vector<Index>& open, const Eigen::MatrixXd& held);

  /// Constrained positions that depend linearly on other positions.
  const std::vector<Index>& redundant() const { return this->redundant_; }

  /// Number of columns of B.
  Index coordinates() const { return this->coordinates_; }
  /// Move the covariance C = K B out; call once after make().
  void take_covariance(Eigen::Ref<Eigen::MatrixXd> covariance);

  /// D* for one pose: the minimizer of 1/2 <D, H D> - <P, D> among all D that have the given blocks
  /// and meet the positions in the least-squares sense.
  struct Unturned
  {
    double energy = 0.0; ///< that minimum
    Coordinates covariance; ///< K D*
    Coordinates given; ///< D*; in the quick method the given blocks only
    Coordinates z; ///< quick method: coordinates z of D*
    Eigen::RowVector3d first; ///< target of the constraint that determines t
  };
  /// @param load P
  /// @param given a D with the given blocks; 0 in all other rows.
  /// @param missing differences between the targets of the constrained positions and those of
  /// `given`.
  Unturned unturned(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const Coordinates& load, const Coordinates& given, const Coordinates& missing) const;
  /// Return D* + B Y.
  Coordinates displacement(const Unturned& from, const Coordinates& y) const;

private:
  /// H = L L^T for the unknowns that affect the energy, in units in which a column of M has size
  /// one. If a common translation u does not affect H, one unknown is left out, and D = u t + E z.
  struct Whole
  {
    bool tried = false, good = false;
    std::vector<Index> rows; ///< rows of D; the last one may be left out
    Eigen::VectorXd scale; ///< scale of these rows
    Eigen::VectorXd shift; ///< u, of size one; empty if it affects H
    DenseCholesky cholesky; ///< L
    Eigen::MatrixXd directions; ///< E = L^-T
    Eigen::MatrixXd covariance; ///< K E
  };
  void factor_whole(const ReducedSpace& space, const Eigen::MatrixXd& stiffness);
  Unturned unturned_sturdily(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const Coordinates& load, const Coordinates& given, const Coordinates& missing) const;
  /// Return t for z, given the target of the first constraint.
  Eigen::RowVector3d shift_of(const Coordinates& z, const Eigen::RowVector3d& first) const;
  /// Add `change` to the open rows of d.
  void add_open(const Coordinates& change, Coordinates& d) const;

  std::vector<Index> open_;
  std::vector<Index> redundant_;
  Index coordinates_ = 0;
  bool quick_ = false;

  // ---- robust method
  Eigen::MatrixXd particular_; ///< open x positions: smallest change that meets the positions
  Eigen::MatrixXd basis_; ///< B, open x coordinates
  Eigen::MatrixXd covariance_; ///< C, until take_covariance()

  // ---- quick method. The constraints are A D = g, positions first. After a reflection that leaves
  // t in the first constraint only, they are rho t + lever z = g_0 and R^T (Q^T z) = the other g.
  Whole whole_;
  std::vector<Index> reached_; ///< indices of open unknowns in whole_.rows
  Index constraints_ = 0;
  Eigen::VectorXd mirror_; ///< the reflection is I - mirror mirror^T
  Eigen::VectorXd lever_;
  double rho_ = 1.0;
  Reflections reflections_; ///< Q
  Eigen::MatrixXd inverse_; ///< R^-T
};

} // namespace bindpose

#endif
