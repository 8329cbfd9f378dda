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
/// Matrices that go through together; also the length of the local arrays.
constexpr int lanes = 8;
/// p'(lambda) / |S|^3 below which the fast path is not trusted.
constexpr double smallest_slope = 1e-3;
/// Eigenvalues closer than this share of |S| to the top count as equal to it.
constexpr double same_eigenvalue = 1e-12;

/// The symmetric matrix N over (w, x, y, z).
struct Horn
{
  double ww, wx, wy, wz, xx, xy, xz, yy, yz, zz;
};

struct Quaternion
{
  double w, x, y, z;
};

BINDPOSE_ALWAYS_INLINE Horn horn(double s00, double s01, double s02, double s10, double s11,
  double s12, double s20, double s21, double s22)
{
  return { s00 + s11 + s22, s12 - s21, s20 - s02, s01 - s10, s00 - s11 - s22, s01 + s10, s02 + s20,
    s11 - s00 - s22, s12 + s21, s22 - s00 - s11 };
}

/// The unit column of the adjugate of N - lambda whose diagonal entry is the largest.
BINDPOSE_ALWAYS_INLINE Quaternion eigenvector(const Horn& n, double lambda)
{
  const double a = n.ww - lambda, b = n.xx - lambda, c = n.yy - lambda, d = n.zz - lambda;
  const double p = n.wx, q = n.wy, r = n.wz, s = n.xy, t = n.xz, u = n.yz;
  const double cd = c * d - u * u, sd = s * d - u * t, qd = q * d - u * r;
  const double su = s * u - c * t, qu = q * u - c * r, qt = q * t - s * r;
  const double pt = p * t - b * r;
  const double ww = b * cd - s * sd + t * su;
  const double wx = -(p * cd - s * qd + t * qu);
  const double wy = p * sd - b * qd + t * qt;
  const double wz = -(p * su - b * qu + s * qt);
  const double xx = a * cd - q * qd + r * qu;
  const double xy = -(a * sd - p * qd + r * qt);
  const double xz = a * su - p * qu + q * qt;
  const double yy = a * (b * d - t * t) - p * (p * d - t * r) + r * pt;
  const double yz = -(a * (b * u - s * t) - p * (p * u - s * r) + q * pt);
  const double zz = a * (b * c - s * s) - p * (p * c - s * q) + q * (p * s - b * q);
  // Selects, not branches.
  double w0 = ww, x0 = wx, y0 = wy, z0 = wz, size = std::abs(ww);
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
  const double scale = 1.0 / std::sqrt(w0 * w0 + x0 * x0 + y0 * y0 + z0 * z0 + 1e-300);
  return { w0 * scale, x0 * scale, y0 * scale, z0 * scale };
}

BINDPOSE_ALWAYS_INLINE double rayleigh(const Horn& n, const Quaternion& v)
{
  return n.ww * v.w * v.w + n.xx * v.x * v.x + n.yy * v.y * v.y + n.zz * v.z * v.z +
    2.0 *
    (v.w * (n.wx * v.x + n.wy * v.y + n.wz * v.z) + v.x * (n.xy * v.y + n.xz * v.z) +
      n.yz * v.y * v.z);
}

/// One block of matrices by the fast path; slope says how far the result can be trusted.
BINDPOSE_SIMD_CLONES void fit_block(
  const double* __restrict s, double* __restrict r, double* __restrict slope)
{
  for (int k = 0; k < lanes; ++k)
  {
    double norm2 = 0.0;
    for (int e = 0; e < 9; ++e)
    {
      norm2 += s[e * lanes + k] * s[e * lanes + k];
    }
    const double f = 1.0 / std::sqrt(norm2 + 1e-300);
    const double s00 = f * s[0 * lanes + k], s01 = f * s[1 * lanes + k], s02 = f * s[2 * lanes + k];
    const double s10 = f * s[3 * lanes + k], s11 = f * s[4 * lanes + k], s12 = f * s[5 * lanes + k];
    const double s20 = f * s[6 * lanes + k], s21 = f * s[7 * lanes + k], s22 = f * s[8 * lanes + k];
    const Horn n = horn(s00, s01, s02, s10, s11, s12, s20, s21, s22);

    // p(x) = x^4 - 2 x^2 + c1 x + c0, with c1 = -8 det S and c0 = 1 - 4 |cofactors of S|^2.
    const double k00 = s11 * s22 - s12 * s21, k01 = s12 * s20 - s10 * s22,
                 k02 = s10 * s21 - s11 * s20;
    const double k10 = s21 * s02 - s22 * s01, k11 = s22 * s00 - s20 * s02,
                 k12 = s20 * s01 - s21 * s00;
    const double k20 = s01 * s12 - s02 * s11, k21 = s02 * s10 - s00 * s12,
                 k22 = s00 * s11 - s01 * s10;
    const double c1 = -8.0 * (s00 * k00 + s01 * k01 + s02 * k02);
    const double c0 = 1.0 -
      4.0 *
        (k00 * k00 + k01 * k01 + k02 * k02 + k10 * k10 + k11 * k11 + k12 * k12 + k20 * k20 +
          k21 * k21 + k22 * k22);

    double x = 1.7320508075688772; // the sum of three singular values of |S| = 1 at most
    double step = 0.0;
    for (int i = 0; i < 5; ++i)
    {
      const double x2 = x * x;
      const double value = (x2 - 2.0) * x2 + c1 * x + c0;
      const double first = (4.0 * x2 - 4.0) * x + c1;
      const double second = 12.0 * x2 - 4.0;
      const double inside = 9.0 * first * first - 12.0 * value * second;
      const double below = first + std::sqrt(inside > 0.0 ? inside : 0.0);
      step = 4.0 * value / (below > 1e-30 ? below : 1e-30);
      x -= step;
    }
    // Not there yet (a double root draws the iteration in slowly), or S out of the squares' range:
    // the careful way.
    const double p1 = (4.0 * x * x - 4.0) * x + c1;
    slope[k] = std::abs(step) < 1e-5 && norm2 > 1e-200 && norm2 < 1e200 ? p1 : 0.0;

    Quaternion v = eigenvector(n, x);
    v = eigenvector(n, rayleigh(n, v));
    r[0 * lanes + k] = v.w * v.w + v.x * v.x - v.y * v.y - v.z * v.z;
    r[1 * lanes + k] = 2.0 * (v.x * v.y - v.w * v.z);
    r[2 * lanes + k] = 2.0 * (v.x * v.z + v.w * v.y);
    r[3 * lanes + k] = 2.0 * (v.x * v.y + v.w * v.z);
    r[4 * lanes + k] = v.w * v.w - v.x * v.x + v.y * v.y - v.z * v.z;
    r[5 * lanes + k] = 2.0 * (v.y * v.z - v.w * v.x);
    r[6 * lanes + k] = 2.0 * (v.x * v.z - v.w * v.y);
    r[7 * lanes + k] = 2.0 * (v.y * v.z + v.w * v.x);
    r[8 * lanes + k] = v.w * v.w - v.x * v.x - v.y * v.y + v.z * v.z;
  }
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
} // namespace

void fit_rotations(Index count, Index stride, const double* s, double* rotations)
{
  double in[9 * lanes];
  double out[9 * lanes];
  double slope[lanes];
  for (Index begin = 0; begin < count; begin += lanes)
  {
    const int size = static_cast<int>(std::min<Index>(lanes, count - begin));
    for (int e = 0; e < 9; ++e)
    {
      for (int k = 0; k < lanes; ++k)
      {
        in[e * lanes + k] = k < size ? s[e * stride + begin + k] : 0.0;
      }
    }
    fit_block(in, out, slope);
    for (int k = 0; k < size; ++k)
    {
      if (slope[k] > smallest_slope) // not a number goes the careful way
      {
        for (int e = 0; e < 9; ++e)
        {
          rotations[e * stride + begin + k] = out[e * lanes + k];
        }
        continue;
      }
      Eigen::Matrix3d matrix, rotation;
      for (int e = 0; e < 9; ++e)
      {
        matrix(e / 3, e % 3) = in[e * lanes + k];
        rotation(e / 3, e % 3) = rotations[e * stride + begin + k];
      }
      fit_carefully(matrix, rotation);
      for (int e = 0; e < 9; ++e)
      {
        rotations[e * stride + begin + k] = rotation(e / 3, e % 3);
      }
    }
  }
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
