// Horn's form: tr(R S) of the rotation with unit quaternion q is q^T N q with a symmetric traceless
// 4x4 matrix N of S, so the best rotation is N's top eigenvector.
//
// Fast path, without branches so that several matrices go through at once: the top eigenvalue is
// the largest root of N's characteristic quartic, whose roots are all real; Laguerre's iteration
// from an upper bound falls on it from above, with third order. The eigenvector is a column of the
// adjugate of N - lambda, which for a simple eigenvalue is p'(lambda) q q^T. One more step at the
// Rayleigh quotient takes away what the quartic's rounding left.
//
// p'(lambda) is the product of the gaps to the other eigenvalues. When it is small the best
// rotation is nearly not unique (S of rank 1, a reflection of equal sizes); then an eigenvalue
// solver finds the whole top eigenspace, and the previous quaternion is projected on it.
#include "pose/rotation_fit.h"

#include "base/simd.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
/// Eigenvalues closer than this share of |S| to the top count as equal to it.
constexpr double same_eigenvalue = 1e-12;

/// The fast path in a precision.
template <typename Scalar>
struct Fast;
template <>
struct Fast<double>
{
  static constexpr int lanes = 8; ///< matrices that go through together
  static constexpr int steps = 5; ///< of Laguerre's iteration
  static constexpr double last_step = 1e-5; ///< a longer one has not arrived
  static constexpr double slope = 1e-3; ///< p'(lambda) / |S|^3 below which it is not trusted
  static constexpr double tiny = 1e-300; ///< keeps quotients finite
  static constexpr double least = 1e-200, most = 1e200; ///< of |S|^2
};
template <>
struct Fast<float>
{
  static constexpr int lanes = 16;
  static constexpr int steps = 4;
  static constexpr float last_step = 1e-3F;
  static constexpr float slope = 3e-2F;
  static constexpr float tiny = 1e-36F;
  static constexpr float least = 1e-25F, most = 1e25F;
};

/// The symmetric matrix N over (w, x, y, z).
template <typename Scalar>
struct Horn
{
  Scalar ww, wx, wy, wz, xx, xy, xz, yy, yz, zz;
};

template <typename Scalar>
struct Quaternion
{
  Scalar w, x, y, z;
};

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE Horn<Scalar> horn(Scalar s00, Scalar s01, Scalar s02, Scalar s10, Scalar s11,
  Scalar s12, Scalar s20, Scalar s21, Scalar s22)
{
  return { s00 + s11 + s22, s12 - s21, s20 - s02, s01 - s10, s00 - s11 - s22, s01 + s10, s02 + s20,
    s11 - s00 - s22, s12 + s21, s22 - s00 - s11 };
}

/// The unit column of the adjugate of N - lambda whose diagonal entry is the largest.
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE Quaternion<Scalar> eigenvector(const Horn<Scalar>& n, Scalar lambda)
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
  // Selects, not branches.
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
  const Scalar scale = 1 / std::sqrt(w0 * w0 + x0 * x0 + y0 * y0 + z0 * z0 + Fast<Scalar>::tiny);
  return { w0 * scale, x0 * scale, y0 * scale, z0 * scale };
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE Scalar rayleigh(const Horn<Scalar>& n, const Quaternion<Scalar>& v)
{
  return n.ww * v.w * v.w + n.xx * v.x * v.x + n.yy * v.y * v.y + n.zz * v.z * v.z +
    2 *
    (v.w * (n.wx * v.x + n.wy * v.y + n.wz * v.z) + v.x * (n.xy * v.y + n.xz * v.z) +
      n.yz * v.y * v.z);
}

/// One block of matrices by the fast path: R - I, and a slope that says how far it can be trusted.
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void fit_lanes(
  const Scalar* __restrict s, Scalar* __restrict r, Scalar* __restrict slope)
{
  using Limits = Fast<Scalar>;
  constexpr int lanes = Limits::lanes;
  for (int k = 0; k < lanes; ++k)
  {
    Scalar norm2 = 0;
    for (int e = 0; e < 9; ++e)
    {
      norm2 += s[e * lanes + k] * s[e * lanes + k];
    }
    const Scalar f = 1 / std::sqrt(norm2 + Limits::tiny);
    const Scalar s00 = f * s[0 * lanes + k], s01 = f * s[1 * lanes + k], s02 = f * s[2 * lanes + k];
    const Scalar s10 = f * s[3 * lanes + k], s11 = f * s[4 * lanes + k], s12 = f * s[5 * lanes + k];
    const Scalar s20 = f * s[6 * lanes + k], s21 = f * s[7 * lanes + k], s22 = f * s[8 * lanes + k];
    const Horn<Scalar> n = horn(s00, s01, s02, s10, s11, s12, s20, s21, s22);

    // p(x) = x^4 - 2 x^2 + c1 x + c0, with c1 = -8 det S and c0 = 1 - 4 |cofactors of S|^2.
    const Scalar k00 = s11 * s22 - s12 * s21, k01 = s12 * s20 - s10 * s22,
                 k02 = s10 * s21 - s11 * s20;
    const Scalar k10 = s21 * s02 - s22 * s01, k11 = s22 * s00 - s20 * s02,
                 k12 = s20 * s01 - s21 * s00;
    const Scalar k20 = s01 * s12 - s02 * s11, k21 = s02 * s10 - s00 * s12,
                 k22 = s00 * s11 - s01 * s10;
    const Scalar c1 = -8 * (s00 * k00 + s01 * k01 + s02 * k02);
    const Scalar c0 = 1 -
      4 *
        (k00 * k00 + k01 * k01 + k02 * k02 + k10 * k10 + k11 * k11 + k12 * k12 + k20 * k20 +
          k21 * k21 + k22 * k22);

    Scalar x = Scalar(1.7320508075688772); // the sum of three singular values of |S| = 1 at most
    Scalar step = 0;
    for (int i = 0; i < Limits::steps; ++i)
    {
      const Scalar x2 = x * x;
      const Scalar value = (x2 - 2) * x2 + c1 * x + c0;
      const Scalar first = (4 * x2 - 4) * x + c1;
      const Scalar second = 12 * x2 - 4;
      const Scalar inside = 9 * first * first - 12 * value * second;
      const Scalar below = first + std::sqrt(inside > 0 ? inside : 0);
      step = 4 * value / (below > Scalar(1e-30) ? below : Scalar(1e-30));
      x -= step;
    }
    // Not there yet (a double root draws the iteration in slowly), or S out of the squares' range:
    // the careful way.
    const Scalar p1 = (4 * x * x - 4) * x + c1;
    slope[k] = std::abs(step) < Limits::last_step && norm2 > Limits::least && norm2 < Limits::most
      ? p1
      : Scalar(0);

    Quaternion<Scalar> v = eigenvector(n, x);
    v = eigenvector(n, rayleigh(n, v));
    r[0 * lanes + k] = -2 * (v.y * v.y + v.z * v.z);
    r[1 * lanes + k] = 2 * (v.x * v.y - v.w * v.z);
    r[2 * lanes + k] = 2 * (v.x * v.z + v.w * v.y);
    r[3 * lanes + k] = 2 * (v.x * v.y + v.w * v.z);
    r[4 * lanes + k] = -2 * (v.x * v.x + v.z * v.z);
    r[5 * lanes + k] = 2 * (v.y * v.z - v.w * v.x);
    r[6 * lanes + k] = 2 * (v.x * v.z - v.w * v.y);
    r[7 * lanes + k] = 2 * (v.y * v.z + v.w * v.x);
    r[8 * lanes + k] = -2 * (v.x * v.x + v.y * v.y);
  }
}

BINDPOSE_SIMD_CLONES void fit_block(
  const double* __restrict s, double* __restrict r, double* __restrict slope)
{
  fit_lanes(s, r, slope);
}

BINDPOSE_SIMD_CLONES void fit_block(
  const float* __restrict s, float* __restrict r, float* __restrict slope)
{
  fit_lanes(s, r, slope);
}

/// The best rotation nearest to the previous one, for any S.
void fit_carefully(const Eigen::Matrix3d& matrix, Eigen::Matrix3d& rotation)
{
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !matrix.allFinite())
  {
    return; // nothing to go by
  }
  const Eigen::Matrix3d s = (matrix / largest).normalized();
  const Horn n =
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

/// `size` numbers of at most `lanes`, mostly all: then their count is known when this is compiled.
template <int lanes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void copy_lanes(const Scalar* from, int size, Scalar* to)
{
  if (size == lanes)
  {
    std::copy_n(from, lanes, to);
  }
  else
  {
    std::copy_n(from, size, to);
  }
}

/// What is written is R - I with `diagonal` added to its diagonal: 0, or 1 for R.
template <typename Scalar>
void fit_all(Index count, const MatrixPlanes<const Scalar>& s,
  const MatrixPlanes<Scalar>& rotations, Scalar diagonal)
{
  constexpr int lanes = Fast<Scalar>::lanes;
  alignas(64) Scalar in[9 * lanes], out[9 * lanes], slope[lanes];
  for (Index begin = 0; begin < count; begin += lanes)
  {
    const int size = static_cast<int>(std::min<Index>(lanes, count - begin));
    if (size < lanes)
    {
      std::fill_n(in, 9 * lanes, Scalar(0));
    }
    for (int e = 0; e < 9; ++e)
    {
      copy_lanes<lanes>(s.at(e / 3, e % 3) + begin, size, in + e * lanes);
    }
    fit_block(in, out, slope);
    for (int e = 0; e < 9 && diagonal != Scalar(0); e += 4)
    {
      for (int k = 0; k < lanes; ++k)
      {
        out[e * lanes + k] += diagonal;
      }
    }
    std::fill(slope + size, slope + lanes, Scalar(1)); // what is not there needs no care
    int trusted = 0;
    for (int k = 0; k < lanes; ++k)
    {
      trusted += slope[k] > Fast<Scalar>::slope ? 1 : 0; // not a number goes the careful way
    }
    const double missing = 1.0 - diagonal;
    for (int k = 0; trusted < lanes && k < size; ++k)
    {
      if (slope[k] > Fast<Scalar>::slope)
      {
        continue;
      }
      Eigen::Matrix3d matrix, rotation;
      for (int e = 0; e < 9; ++e)
      {
        matrix(e / 3, e % 3) = in[e * lanes + k];
        rotation(e / 3, e % 3) =
          rotations.at(e / 3, e % 3)[begin + k] + (e % 4 == 0 ? missing : 0.0);
      }
      fit_carefully(matrix, rotation);
      for (int e = 0; e < 9; ++e)
      {
        out[e * lanes + k] =
          static_cast<Scalar>(rotation(e / 3, e % 3) - (e % 4 == 0 ? missing : 0.0));
      }
    }
    for (int e = 0; e < 9; ++e)
    {
      copy_lanes<lanes>(out + e * lanes, size, rotations.at(e / 3, e % 3) + begin);
    }
  }
}
} // namespace

void fit_rotations(Index count, Index stride, const double* s, double* rotations)
{
  fit_all(count, { s, 3 * stride, stride }, { rotations, 3 * stride, stride }, 1.0);
}

void fit_turns(Index count, MatrixPlanes<const double> s, MatrixPlanes<double> turns)
{
  fit_all(count, s, turns, 0.0);
}

void fit_turns(Index count, MatrixPlanes<const float> s, MatrixPlanes<float> turns)
{
  fit_all(count, s, turns, 0.0F);
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
