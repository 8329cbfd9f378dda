#ifndef bindpose_pose_rotation_fit_h
#define bindpose_pose_rotation_fit_h

#include "base/mesh.h"

#include <vector>

namespace bindpose
{

/// The rotation R (det +1) that maximises tr(R S), put where the previous rotation was.
///
/// With S = sum of c e e'^T over rest edges e and posed edges e' this is the rotation that takes
/// the rest edges nearest to the posed ones (Kabsch, Horn): for S = U diag(s) V^T it is
/// V diag(1, 1, det(V U^T)) U^T. Where the best rotation is not unique (rank 0 or 1, some
/// reflections) it is the one of the best that is nearest to the previous, so that S = 0 keeps the
/// previous rotation exactly. S must be finite; its scale does not matter.
void fit_rotation(const Eigen::Matrix3d& s, Eigen::Matrix3d& rotation);

/// The same for many. Matrices lie in planes: entry (row i, column j) of matrix k is
/// s[(3 * i + j) * stride + k], and rotations[(3 * i + j) * stride + k] likewise; stride >= count.
/// Several at once per instruction where the processor can; a matrix gives the same bits wherever
/// it lies. Cost: about 36 ns a matrix with AVX2, 26 ns with AVX-512, 1 µs for a rare one near
/// rank 1.
void fit_rotations(Index count, Index stride, const double* s, double* rotations);

/// Entry (i, j) of matrix k is planes[i * by_row + j * by_column + k].
template <typename Scalar>
struct MatrixPlanes
{
  Scalar* planes;
  Index by_row, by_column;

  Scalar* at(int i, int j) const { return this->planes + i * this->by_row + j * this->by_column; }
  /// From matrix `k` on.
  MatrixPlanes from(Index k) const { return { this->planes + k, this->by_row, this->by_column }; }
};

/// The same, and what is held are turns, R - I.
void fit_turns(Index count, MatrixPlanes<const double> s, MatrixPlanes<double> turns);
/// In single precision, to about 1e-6, for half the time.
void fit_turns(Index count, MatrixPlanes<const float> s, MatrixPlanes<float> turns);

/// The first `count` matrices of such planes, one by one.
std::vector<Eigen::Matrix3d> rotation_matrices(
  Index count, Index stride, const std::vector<double>& planes);

} // namespace bindpose

#endif
