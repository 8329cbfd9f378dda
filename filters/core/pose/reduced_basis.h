#ifndef bindpose_pose_reduced_basis_h
#define bindpose_pose_reduced_basis_h

#include "base/dense_cholesky.h"
#include "base/thin_product.h"
#include "pose/reduced_space.h"

#include <vector>

namespace bindpose
{

/// I - V T V^T, the orthogonal factor Q of a QR decomposition as its reflections (Schreiber and Van
/// Loan 1989), and Z: its columns after the first `rank`, those that the decomposed matrix leaves
/// open.
class Reflections
{
public:
  Reflections() = default;
  /// From the lower triangle and the factors that LAPACK and Eigen leave behind; all its columns,
  /// or the first `rank` of them, count.
  Reflections(const Eigen::MatrixXd& packed, const Eigen::VectorXd& factors, Index rank);

  Index rank() const { return this->v_.cols(); }
  /// product = M Z
  void times_tail(const Eigen::MatrixXd& m, Eigen::Ref<Eigen::MatrixXd> product) const;
  Eigen::MatrixXd times_tail(const Eigen::MatrixXd& m) const;
  /// Z
  Eigen::MatrixXd tail() const;
  /// Q X and Q^T X
  Coordinates turned(const Coordinates& x) const;
  Coordinates turned_back(const Coordinates& x) const;

private:
  Eigen::MatrixXd v_, t_;
  Eigen::MatrixXd tail_; ///< T V^T, the columns of Z
};

/// What a choice of modes leaves open of the displacements D of a ReducedSpace, D = D* + B Y: D*
/// has the given blocks and moves the held positions as asked, and the columns of B, which are
/// orthonormal in the stiffness H (B^T H B = I), span what changes neither.
///
/// Two ways lead there. The sturdy one decides ranks of whatever it is given and factors what is
/// open, O(#open^3). The quick one factors H as a whole once, and after each choice of modes
/// only turns that factor's columns, O((#columns + #clusters) #columns #constraints); it is for
/// matrices whose ranks are beyond doubt, and declines all others.
class ReducedBasis
{
public:
  /// @param open rows of D that no full handle gives, ascending.
  /// @param held what moves the held positions: positions x rows of D.
  /// H must be the same one whenever this is called.
  void make(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const std::vector<Index>& open, const Eigen::MatrixXd& held);

  /// The ways one by one. The quick one is false when it declines.
  bool make_quickly(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const std::vector<Index>& open, const Eigen::MatrixXd& held);
  void make_sturdily(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const std::vector<Index>& open, const Eigen::MatrixXd& held);

  /// Held positions that others determine.
  const std::vector<Index>& redundant() const { return this->redundant_; }

  /// Columns of B.
  Index coordinates() const { return this->coordinates_; }
  /// covariance = C = K B, once after make().
  void take_covariance(Eigen::Ref<Eigen::MatrixXd> covariance);

  /// D* for one pose: of what has the given blocks and meets the positions as well as can be, the
  /// least 1/2 <D, H D> - <P, D>.
  struct Unturned
  {
    double energy = 0.0; ///< that least
    Coordinates covariance; ///< K D*
    Coordinates given; ///< D*, or in the quick way the given blocks and where in its coordinates
    Coordinates z; ///<   D* is
    Eigen::RowVector3d first; ///< what the constraint that t follows from asks for
  };
  /// @param load P
  /// @param given a D of given blocks; else 0.
  /// @param missing what the held positions lack with these alone.
  Unturned unturned(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const Coordinates& load, const Coordinates& given, const Coordinates& missing) const;
  /// D* + B Y
  Coordinates displacement(const Unturned& from, const Coordinates& y) const;

private:
  /// H = L L^T for the unknowns that it sees, in units in which a column of M has size one. Where H
  /// sees no common translation u, one unknown is left out, and D = u t + E z.
  struct Whole
  {
    bool tried = false, good = false;
    std::vector<Index> rows; ///< of D; what is left out is the last
    Eigen::VectorXd scale; ///< of these
    Eigen::VectorXd shift; ///< u, of size one; empty when H sees it
    DenseCholesky cholesky; ///< L
    Eigen::MatrixXd directions; ///< E = L^-T
    Eigen::MatrixXd covariance; ///< K E
  };
  void factor_whole(const ReducedSpace& space, const Eigen::MatrixXd& stiffness);
  Unturned unturned_sturdily(const ReducedSpace& space, const Eigen::MatrixXd& stiffness,
    const Coordinates& load, const Coordinates& given, const Coordinates& missing) const;
  /// t for z when the first constraint asks for this much.
  Eigen::RowVector3d shift_of(const Coordinates& z, const Eigen::RowVector3d& first) const;
  /// d += change of the open rows.
  void add_open(const Coordinates& change, Coordinates& d) const;

  std::vector<Index> open_;
  std::vector<Index> redundant_;
  Index coordinates_ = 0;
  bool quick_ = false;

  // ---- the sturdy way
  Eigen::MatrixXd particular_; ///< open x positions: least change that meets the positions
  Eigen::MatrixXd basis_; ///< open x coordinates
  Eigen::MatrixXd covariance_; ///< C, until it is taken

  // ---- the quick way: constraints A D = g, positions first, are rho t + lever z = g_0 and
  //      R^T (Q^T z) = the other g, after a reflection that leaves t in the first alone
  Whole whole_;
  std::vector<Index> reached_; ///< places of open unknowns in whole_.rows
  Index constraints_ = 0;
  Eigen::VectorXd mirror_; ///< the reflection is I - mirror mirror^T
  Eigen::VectorXd lever_;
  double rho_ = 1.0;
  Reflections reflections_; ///< Q
  Eigen::MatrixXd inverse_; ///< R^-T
};

} // namespace bindpose

#endif
