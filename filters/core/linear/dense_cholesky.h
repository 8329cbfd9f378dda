#ifndef bindpose_linear_dense_cholesky_h
#define bindpose_linear_dense_cholesky_h

#include "base/mesh_types.h"

namespace bindpose
{

/// Factorization A = L L^T of a dense symmetric matrix. It uses LAPACK if the build contains it.
/// Cost: n^3 / 6 multiply-adds.
class DenseCholesky
{
public:
  /// Factor A; only the lower triangle of the matrix is read. Return false if A is not positive
  /// definite to round-off.
  bool factor(Eigen::MatrixXd a);
  /// Return an estimate of the reciprocal condition number 1 / (|A| |A^-1|) in the one-norm.
  double reciprocal_condition() const;
  /// Replace X by X L^-T.
  void solve_right(Eigen::MatrixXd& x) const;

private:
  Eigen::MatrixXd l_;
  double norm_ = 0.0; ///< one-norm of A
};

} // namespace bindpose

#endif
