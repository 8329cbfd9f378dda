// Best rotations of many 3 x 3 matrices by Horn's quaternion method.
//
// For the rotation R with the unit quaternion q, tr(R S) = q^T N q, where N is a symmetric
// traceless 4x4 matrix that is a linear function of S. The best rotation is therefore the
// eigenvector of N's largest eigenvalue.
//
// The fast path has no branches, so that several matrices are processed in parallel. The largest
// eigenvalue is the largest root of N's characteristic quartic, whose roots are all real.
// Laguerre's iteration converges to this root from above with third order, starting from an upper
// bound. For a simple eigenvalue lambda, the adjugate of N - lambda is -p'(lambda) q q^T, so each
// nonzero column of the adjugate is an eigenvector. One more step with the Rayleigh quotient
// removes the error due to round-off in the coefficients of the quartic.
//
// p'(lambda) is the product of the differences between lambda and the other eigenvalues. If
// p'(lambda) is small, the best rotation is not unique or almost not unique (S has rank 1, or is a
// reflection with equal singular values). An eigenvalue solver then finds the whole eigenspace of
// the largest eigenvalue, and the previous quaternion is projected on it.
#include "pose/rotation_fit.h"

#include "base/simd.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace bindpose
{

namespace
{
/// An eigenvalue counts as equal to the largest eigenvalue if their difference is at most this
/// fraction of |S|.
constexpr double same_eigenvalue = 1e-12;

/// Parameters of the fast path, for each scalar type.
template <typename Scalar>
struct FitLimits;
template <>
struct FitLimits<double>
{
  static constexpr int lanes = 8; ///< number of matrices that are processed in parallel
  static constexpr int steps = 5; ///< number of iterations of Laguerre's method
  /// If the last step is longer than this, the iteration has not converged.
  static constexpr double last_step = 1e-5;
  /// A result of the fast path is used only if p'(lambda) / |S|^3 is larger than this.
  static constexpr double slope = 1e-3;
  static constexpr double tiny = 1e-300; ///< added to denominators, to keep quotients finite
  static constexpr double minimum_norm2 = 1e-200,
                          maximum_norm2 = 1e200; ///< range of |S|^2 for the fast path
};
template <>
struct FitLimits<float>
{
  static constexpr int lanes = 16;
  static constexpr int steps = 4;
  static constexpr float last_step = 1e-3F;
  static constexpr float slope = 3e-2F;
  static constexpr float tiny = 1e-36F;
  static constexpr float minimum_norm2 = 1e-25F, maximum_norm2 = 1e25F;
};

/// The ten entries of the symmetric matrix N over (w, x, y, z).
template <typename Scalar>
struct HornMatrix
{
  Scalar ww, wx, wy, wz, xx, xy, xz, yy, yz, zz;
};

template <typename Scalar>
struct Quaternion
{
  Scalar w, x, y, z;
};

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE HornMatrix<Scalar> horn(Scalar s00, Scalar s01, Scalar s02, Scalar s10,
  Scalar s11, Scalar s12, Scalar s20, Scalar s21, Scalar s22)
{
  return { s00 + s11 + s22, s12 - s21, s20 - s02, s01 - s10, s00 - s11 - s22, s01 + s10, s02 + s20,
    s11 - s00 - s22, s12 + s21, s22 - s00 - s11 };
}

/// Return the column of the adjugate of N - lambda whose diagonal entry is the largest.
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE Quaternion<Scalar> eigenvector(const HornMatrix<Scalar>& n, Scalar lambda)
{
  const Scalar a = n.ww - lambda, b = n.xx - lambda, c = n.yy - lambda, d = n.zz - lambda;
  const Scalar p = n.wx, q = n.wy, r = n.wz, s = n.xy, t = n.xz, u = n.yz;
  const Scalar cd = c * d - u * u, sd = s * d - u * t, qd = q * d - u * r;
  const Scalar su = s * u - c * t, qu = q * u - c * r, qt = q * t - s * r;
  const Scalar pt = p * t - b * r;
  const Scalar ww = b * cd - s * sd + t * su;
  const Scalar wx = -(p * cd - s * qd + t * qu);
  const Scalar wy = p * sd - b * qd + t * qt;
  const Scalar wz = -(p * su - b * qu + s * qt);
  const Scalar xx = a * cd - q * qd + r * qu;
  const Scalar xy = -(a * sd - p * qd + r * qt);
  const Scalar xz = a * su - p * qu + q * qt;
  const Scalar yy = a * (b * d - t * t) - p * (p * d - t * r) + r * pt;
  const Scalar yz = -(a * (b * u - s * t) - p * (p * u - s * r) + q * pt);
  const Scalar zz = a * (b * c - s * s) - p * (p * c - s * q) + q * (p * s - b * q);
  // Conditional expressions select the column without branches, so that the compiler can vectorize
  // the loops that call this function.
  Scalar w0 = ww, x0 = wx, y0 = wy, z0 = wz, size = std::abs(ww);
  const bool use_x = std::abs(xx) > size;
  w0 = use_x ? wx : w0;
  x0 = use_x ? xx : x0;
  y0 = use_x ? xy : y0;
  z0 = use_x ? xz : z0;
  size = use_x ? std::abs(xx) : size;
  const bool use_y = std::abs(yy) > size;
  w0 = use_y ? wy : w0;
  x0 = use_y ? xy : x0;
  y0 = use_y ? yy : y0;
  z0 = use_y ? yz : z0;
  size = use_y ? std::abs(yy) : size;
  const bool use_z = std::abs(zz) > size;
  w0 = use_z ? wz : w0;
  x0 = use_z ? xz : x0;
  y0 = use_z ? yz : y0;
  z0 = use_z ? zz : z0;
  return { w0, x0, y0, z0 };
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE Scalar square_of(const Quaternion<Scalar>& v)
{
  return v.w * v.w + v.x * v.x + v.y * v.y + v.z * v.z + FitLimits<Scalar>::tiny;
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE Scalar rayleigh(const HornMatrix<Scalar>& n, const Quaternion<Scalar>& v)
{
  return (n.ww * v.w * v.w + n.xx * v.x * v.x + n.yy * v.y * v.y + n.zz * v.z * v.z +
           2 *
             (v.w * (n.wx * v.x + n.wy * v.y + n.wz * v.z) + v.x * (n.xy * v.y + n.xz * v.z) +
               n.yz * v.y * v.z)) /
    square_of(v);
}

/// Number of groups of lanes that each step of the fast path processes together. The latency of
/// square roots and divisions of one group overlaps with the work on the other groups.
constexpr int groups_per_block = 4;

/// Data that one step of the fast path passes to the next step.
template <typename Scalar>
struct FitBlock
{
  static constexpr int lanes = FitLimits<Scalar>::lanes;
  int groups; ///< number of groups in use
  Index begin[groups_per_block]; ///< first matrix of each group
  /// Number of lanes at the start of each group that are skipped, because their matrices are
  /// padding or are fitted by the previous group.
  int skipped[groups_per_block];
  Scalar horn[10][groups_per_block * lanes];
  /// Coefficients of the quartic.
  Scalar linear[groups_per_block * lanes], constant[groups_per_block * lanes];
  Scalar norm2[groups_per_block * lanes];
  Scalar eigenvalue[groups_per_block * lanes];
  /// The derivative p'(lambda) of each lane; 0 if the fast path has failed, see find_eigenvalues().
  Scalar slope[groups_per_block * lanes];
  Scalar rotation[9][groups_per_block * lanes];

  BINDPOSE_ALWAYS_INLINE HornMatrix<Scalar> horn_of(int k) const
  {
    return { this->horn[0][k], this->horn[1][k], this->horn[2][k], this->horn[3][k],
      this->horn[4][k], this->horn[5][k], this->horn[6][k], this->horn[7][k], this->horn[8][k],
      this->horn[9][k] };
  }
};

/// Compute N and its quartic p(x) = x^4 - 2 x^2 + c1 x + c0 for S of norm 1: c1 = -8 det S and
/// c0 = 1 - 4 |cofactors of S|^2.
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void set_quartics(
  const MatrixPlanes<const Scalar>& s, FitBlock<Scalar>& __restrict block)
{
  constexpr int lanes = FitLimits<Scalar>::lanes;
  for (int g = 0; g < block.groups; ++g)
  {
    const MatrixPlanes<const Scalar> from = s.from(block.begin[g]);
    const Scalar *const p00 = from.at(0, 0), *const p01 = from.at(0, 1), *const p02 = from.at(0, 2);
    const Scalar *const p10 = from.at(1, 0), *const p11 = from.at(1, 1), *const p12 = from.at(1, 2);
    const Scalar *const p20 = from.at(2, 0), *const p21 = from.at(2, 1), *const p22 = from.at(2, 2);
    for (int i = 0; i < lanes; ++i)
    {
      const int k = g * lanes + i;
      const Scalar norm2 = p00[i] * p00[i] + p01[i] * p01[i] + p02[i] * p02[i] + p10[i] * p10[i] +
        p11[i] * p11[i] + p12[i] * p12[i] + p20[i] * p20[i] + p21[i] * p21[i] + p22[i] * p22[i];
      const Scalar f = 1 / std::sqrt(norm2 + FitLimits<Scalar>::tiny);
      const Scalar s00 = f * p00[i], s01 = f * p01[i], s02 = f * p02[i];
      const Scalar s10 = f * p10[i], s11 = f * p11[i], s12 = f * p12[i];
      const Scalar s20 = f * p20[i], s21 = f * p21[i], s22 = f * p22[i];
      const HornMatrix<Scalar> n = horn(s00, s01, s02, s10, s11, s12, s20, s21, s22);
      const Scalar k00 = s11 * s22 - s12 * s21, k01 = s12 * s20 - s10 * s22,
                   k02 = s10 * s21 - s11 * s20;
      const Scalar k10 = s21 * s02 - s22 * s01, k11 = s22 * s00 - s20 * s02,
                   k12 = s20 * s01 - s21 * s00;
      const Scalar k20 = s01 * s12 - s02 * s11, k21 = s02 * s10 - s00 * s12,
                   k22 = s00 * s11 - s01 * s10;
      block.linear[k] = -8 * (s00 * k00 + s01 * k01 + s02 * k02);
      block.constant[k] = 1 -
        4 *
          (k00 * k00 + k01 * k01 + k02 * k02 + k10 * k10 + k11 * k11 + k12 * k12 + k20 * k20 +
            k21 * k21 + k22 * k22);
      block.norm2[k] = norm2;
      block.horn[0][k] = n.ww;
      block.horn[1][k] = n.wx;
      block.horn[2][k] = n.wy;
      block.horn[3][k] = n.wz;
      block.horn[4][k] = n.xx;
      block.horn[5][k] = n.xy;
      block.horn[6][k] = n.xz;
      block.horn[7][k] = n.yy;
      block.horn[8][k] = n.yz;
      block.horn[9][k] = n.zz;
    }
  }
}

/// Find the largest roots of the quartics.
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void find_eigenvalues(FitBlock<Scalar>& __restrict block)
{
  using Limits = FitLimits<Scalar>;
  for (int g = 0; g < block.groups; ++g)
  {
    for (int k = g * Limits::lanes; k < (g + 1) * Limits::lanes; ++k)
    {
      const Scalar c1 = block.linear[k], c0 = block.constant[k], norm2 = block.norm2[k];
      // Upper bound of the root: the sum of the three singular values is at most sqrt(3) for |S| =
      // 1.
      Scalar x = Scalar(1.7320508075688772);
      Scalar step = 0;
      for (int i = 0; i < Limits::steps; ++i)
      {
        const Scalar x2 = x * x;
        const Scalar value = (x2 - 2) * x2 + c1 * x + c0;
        const Scalar first = (4 * x2 - 4) * x + c1;
        const Scalar second = 12 * x2 - 4;
        const Scalar inside = 9 * first * first - 12 * value * second;
        const Scalar denominator = first + std::sqrt(inside > 0 ? inside : 0);
        step = 4 * value / (denominator > Scalar(1e-30) ? denominator : Scalar(1e-30));
        x -= step;
      }
      // The fast path fails if the iteration has not converged (convergence to a double root is
      // slow), or if |S|^2 is out of range. fit_by_eigenvectors() then fits the matrix.
      const Scalar slope = (4 * x * x - 4) * x + c1;
      block.slope[k] = std::abs(step) < Limits::last_step && norm2 > Limits::minimum_norm2 &&
          norm2 < Limits::maximum_norm2
        ? slope
        : Scalar(0);
      block.eigenvalue[k] = x;
    }
  }
}

/// Refine each eigenvalue by the Rayleigh quotient of its eigenvector.
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void refine_eigenvalues(FitBlock<Scalar>& __restrict block)
{
  constexpr int lanes = FitLimits<Scalar>::lanes;
  for (int g = 0; g < block.groups; ++g)
  {
    for (int k = g * lanes; k < (g + 1) * lanes; ++k)
    {
      const HornMatrix<Scalar> n = block.horn_of(k);
      block.eigenvalue[k] = rayleigh(n, eigenvector(n, block.eigenvalue[k]));
    }
  }
}

/// Compute R - I, with `diagonal` added to its diagonal.
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void make_rotations(Scalar diagonal, FitBlock<Scalar>& __restrict block)
{
  constexpr int lanes = FitLimits<Scalar>::lanes;
  for (int g = 0; g < block.groups; ++g)
  {
    for (int k = g * lanes; k < (g + 1) * lanes; ++k)
    {
      const Quaternion<Scalar> v = eigenvector(block.horn_of(k), block.eigenvalue[k]);
      const Scalar twice = 2 / square_of(v);
      const Scalar w = twice * v.w, x = twice * v.x, y = twice * v.y, z = twice * v.z;
      block.rotation[0][k] = diagonal - (y * v.y + z * v.z);
      block.rotation[1][k] = x * v.y - w * v.z;
      block.rotation[2][k] = x * v.z + w * v.y;
      block.rotation[3][k] = x * v.y + w * v.z;
      block.rotation[4][k] = diagonal - (x * v.x + z * v.z);
      block.rotation[5][k] = y * v.z - w * v.x;
      block.rotation[6][k] = x * v.z - w * v.y;
      block.rotation[7][k] = y * v.z + w * v.x;
      block.rotation[8][k] = diagonal - (x * v.x + y * v.y);
    }
  }
}

/// Write the rotations of the lanes whose slope p'(lambda) is above the limit.
/// @return the number of the other lanes, without skipped lanes.
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE int put_rotations(
  const MatrixPlanes<Scalar>& rotations, FitBlock<Scalar>& __restrict block)
{
  constexpr int lanes = FitLimits<Scalar>::lanes;
  // An integer as wide as Scalar, so that the compiler vectorizes the loop.
  using Count = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
  Count unresolved = 0;
  for (int g = 0; g < block.groups; ++g)
  {
    Scalar resolved_slope[lanes];
#pragma GCC unroll 1 // prevents unrolling, so that the compiler vectorizes the loop
    for (int i = 0; i < lanes; ++i)
    {
      const int k = g * lanes + i;
      const bool is_skipped = i < block.skipped[g];
      const Scalar slope = is_skipped ? Scalar(1) : block.slope[k];
      block.slope[k] = slope;
      // a comparison with NaN is false, so a slope of NaN is not above the limit
      unresolved += slope > FitLimits<Scalar>::slope ? 0 : 1;
      resolved_slope[i] = is_skipped ? Scalar(0) : slope;
    }
    for (int e = 0; e < 9; ++e)
    {
      Scalar* const __restrict to = rotations.at(e / 3, e % 3) + block.begin[g];
#pragma GCC unroll 1
      for (int i = 0; i < lanes; ++i)
      {
        const Scalar before = to[i], after = block.rotation[e][g * lanes + i];
        to[i] = resolved_slope[i] > FitLimits<Scalar>::slope ? after : before;
      }
    }
  }
  return static_cast<int>(unresolved);
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE int fit_groups(const MatrixPlanes<const Scalar>& s,
  const MatrixPlanes<Scalar>& rotations, Scalar diagonal, FitBlock<Scalar>& block)
{
  set_quartics(s, block);
  find_eigenvalues(block);
  refine_eigenvalues(block);
  make_rotations(diagonal, block);
  return put_rotations(rotations, block);
}

BINDPOSE_SIMD_CLONES int fit_block(const MatrixPlanes<const double>& s,
  const MatrixPlanes<double>& rotations, double diagonal, FitBlock<double>& block)
{
  return fit_groups(s, rotations, diagonal, block);
}

BINDPOSE_SIMD_CLONES int fit_block(const MatrixPlanes<const float>& s,
  const MatrixPlanes<float>& rotations, float diagonal, FitBlock<float>& block)
{
  return fit_groups(s, rotations, diagonal, block);
}

/// Compute the best rotation for any S. If several rotations are best, choose the one that is
/// nearest to the previous rotation.
void fit_by_eigenvectors(const Eigen::Matrix3d& matrix, Eigen::Matrix3d& rotation)
{
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !matrix.allFinite())
  {
    return; // S does not determine a rotation
  }
  const Eigen::Matrix3d s = (matrix / largest).normalized();
  const HornMatrix n =
    horn(s(0, 0), s(0, 1), s(0, 2), s(1, 0), s(1, 1), s(1, 2), s(2, 0), s(2, 1), s(2, 2));
  Eigen::Matrix4d full;
  full << n.ww, n.wx, n.wy, n.wz, n.wx, n.xx, n.xy, n.xz, n.wy, n.xy, n.yy, n.yz, n.wz, n.xz, n.yz,
    n.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(full);
  const Eigen::Quaterniond before(rotation);
  const Eigen::Vector4d previous(before.w(), before.x(), before.y(), before.z());
  Eigen::Vector4d best = Eigen::Vector4d::Zero();
  for (int i = 3; i >= 0 && solver.eigenvalues()[i] >= solver.eigenvalues()[3] - same_eigenvalue;
       --i)
  {
    best += solver.eigenvectors().col(i) * solver.eigenvectors().col(i).dot(previous);
  }
  if (best.norm() < 1e-6)
  {
    best = solver.eigenvectors().col(3);
  }
  best.normalize();
  rotation = Eigen::Quaterniond(best[0], best[1], best[2], best[3]).toRotationMatrix();
}

/// Fit the matrices of a block for which put_rotations() has written no rotation, one at a time.
template <typename Scalar>
void fit_remaining(const FitBlock<Scalar>& block, const MatrixPlanes<const Scalar>& s,
  const MatrixPlanes<Scalar>& rotations, Scalar diagonal)
{
  constexpr int lanes = FitLimits<Scalar>::lanes;
  const double missing = 1.0 - diagonal;
  for (int k = 0; k < block.groups * lanes; ++k)
  {
    if (block.slope[k] > FitLimits<Scalar>::slope)
    {
      continue;
    }
    const Index at = block.begin[k / lanes] + k % lanes;
    Eigen::Matrix3d matrix, rotation;
    for (int e = 0; e < 9; ++e)
    {
      matrix(e / 3, e % 3) = s.at(e / 3, e % 3)[at];
      rotation(e / 3, e % 3) = rotations.at(e / 3, e % 3)[at] + (e % 4 == 0 ? missing : 0.0);
    }
    fit_by_eigenvectors(matrix, rotation);
    for (int e = 0; e < 9; ++e)
    {
      rotations.at(e / 3, e % 3)[at] =
        static_cast<Scalar>(rotation(e / 3, e % 3) - (e % 4 == 0 ? missing : 0.0));
    }
  }
}

/// Fit all matrices. The result is R - I with `diagonal` added to the diagonal entries: R - I if
/// `diagonal` is 0, and R if `diagonal` is 1.
template <typename Scalar>
void fit_all(Index count, const MatrixPlanes<const Scalar>& s,
  const MatrixPlanes<Scalar>& rotations, Scalar diagonal)
{
  constexpr int lanes = FitLimits<Scalar>::lanes;
  FitBlock<Scalar> block;
  const auto fit = [&](const MatrixPlanes<const Scalar>& from, const MatrixPlanes<Scalar>& to)
  {
    if (fit_block(from, to, diagonal, block) > 0)
    {
      fit_remaining(block, from, to, diagonal);
    }
  };
  if (count < lanes)
  {
    // A group needs `lanes` matrices. Fill its leading lanes with zero matrices, which are skipped.
    const Index missing = lanes - count;
    Scalar in[9 * lanes] = {}, out[9 * lanes] = {};
    for (int e = 0; e < 9; ++e)
    {
      std::copy_n(s.at(e / 3, e % 3), count, in + e * lanes + missing);
      std::copy_n(rotations.at(e / 3, e % 3), count, out + e * lanes + missing);
    }
    block.groups = 1;
    block.begin[0] = 0;
    block.skipped[0] = static_cast<int>(missing);
    fit({ in, 3 * lanes, lanes }, { out, 3 * lanes, lanes });
    for (int e = 0; e < 9; ++e)
    {
      std::copy_n(out + e * lanes + missing, count, rotations.at(e / 3, e % 3));
    }
    return;
  }
  for (Index done = 0; done < count;)
  {
    for (block.groups = 0; block.groups < groups_per_block && done < count; ++block.groups)
    {
      // The last group overlaps the previous group and skips the matrices that are already done.
      const Index begin = std::min(done, count - lanes);
      block.begin[block.groups] = begin;
      block.skipped[block.groups] = static_cast<int>(done - begin);
      done = begin + lanes;
    }
    fit(s, rotations);
  }
}
} // namespace

void fit_rotations(Index count, Index stride, const double* s, double* rotations)
{
  fit_all(count, { s, 3 * stride, stride }, { rotations, 3 * stride, stride }, 1.0);
}

void fit_rotation_deltas(Index count, MatrixPlanes<const double> s, MatrixPlanes<double> deltas)
{
  fit_all(count, s, deltas, 0.0);
}

void fit_rotation_deltas(Index count, MatrixPlanes<const float> s, MatrixPlanes<float> deltas)
{
  fit_all(count, s, deltas, 0.0F);
}

void fit_rotation(const Eigen::Matrix3d& s, Eigen::Matrix3d& rotation)
{
  double in[9], out[9];
  for (int e = 0; e < 9; ++e)
  {
    in[e] = s(e / 3, e % 3);
    out[e] = rotation(e / 3, e % 3);
  }
  fit_rotations(1, 1, in, out);
  for (int e = 0; e < 9; ++e)
  {
    rotation(e / 3, e % 3) = out[e];
  }
}

std::vector<Eigen::Matrix3d> rotation_matrices(
  Index count, Index stride, const std::vector<double>& planes)
{
  std::vector<Eigen::Matrix3d> result(static_cast<std::size_t>(count));
  for (Index k = 0; k < count; ++k)
  {
    for (Index e = 0; e < 9; ++e)
    {
      result[static_cast<std::size_t>(k)](e / 3, e % 3) =
        planes[static_cast<std::size_t>(e * stride + k)];
    }
  }
  return result;
}

} // namespace bindpose
