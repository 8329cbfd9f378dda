#ifndef bindpose_pose_rotation_fit_h
#define bindpose_pose_rotation_fit_h

// Rotations that best map rest edges to posed edges, for one or many 3 x 3 covariance matrices.

#include "geometry/mesh.h"

#include <vector>

namespace bindpose
{

/// Replace `rotation` by the rotation R (det +1) that maximizes tr(R S).
///
/// For S = sum of c e e'^T over rest edges e and posed edges e', R is the rotation that best maps
/// the rest edges to the posed edges (Kabsch, Horn). For S = U diag(s) V^T, R is V diag(1, 1, det(V
/// U^T)) U^T. If the best rotation is not unique (rank 0 or 1, some reflections), the result is the
/// best rotation that is nearest to the previous value of `rotation`. Therefore S = 0 keeps the
/// previous rotation exactly. S must be finite; its scale does not affect the result.
void fit_rotation(const Eigen::Matrix3d& s, Eigen::Matrix3d& rotation);

/// Fit many rotations. Matrices are stored in planes: entry (row i, column j) of matrix k is s[(3 *
/// i + j) * stride + k], with stride >= count. `rotations` has the same layout. The fits are
/// vectorized if the processor supports it; the bits of a result do not depend on the index of its
/// matrix. Cost: about 36 ns per matrix with AVX2, 26 ns with AVX-512, 1 µs for the rare
/// matrices near rank 1.
void fit_rotations(Index count, Index stride, const double* s, double* rotations);

/// Matrices stored in planes: entry (i, j) of matrix k is planes[i * row_stride + j * column_stride
/// + k].
template <typename Scalar>
struct MatrixPlanes
{
  Scalar* planes;
  Index row_stride, column_stride;

  Scalar* at(int i, int j) const
  {
    return this->planes + i * this->row_stride + j * this->column_stride;
  }
  /// Return a view of the matrices from index k on.
  MatrixPlanes from(Index k) const
  {
    return { this->planes + k, this->row_stride, this->column_stride };
  }
};

/// Fit many rotations and store R - I instead of R.
void fit_rotation_deltas(Index count, MatrixPlanes<const double> s, MatrixPlanes<double> deltas);
/// Fit in single precision, with an error of about 1e-6 and half the computing time.
void fit_rotation_deltas(Index count, MatrixPlanes<const float> s, MatrixPlanes<float> deltas);

/// Return the first `count` matrices that are stored in planes.
std::vector<Eigen::Matrix3d> rotation_matrices(
  Index count, Index stride, const std::vector<double>& planes);

} // namespace bindpose

#endif
