// Evaluation of the expansion of a cell at points with the same y and z. The expansion is then a
// polynomial in x (see local_polynomial.h). A coefficient of the polynomial is a sum of products:
// coefficients of the expansion times harmonics in the plane x = 0. Eight coefficients of the
// polynomial are computed in parallel. If the length of a row of the expansion's coefficients is
// not a multiple of eight, values beyond the end of the row are read but not used.
#include "solid_angle/local_polynomial.h"

#include "base/simd.h"

namespace bindpose
{

namespace
{
constexpr int largest_order = largest_polynomial_order;

/// Constants of the harmonics in the plane x = 0. With zeta = y + iz, the harmonic (l + 2q, l) is
/// plane[l][q] * zeta^l * |zeta|^(2q).
struct PlaneConstants
{
  double plane[largest_order + 1][largest_order / 2 + 1];
  double factorial[largest_order + 2]; ///< entry j is 1 / j!; the last entry is 0
};
constexpr PlaneConstants make_plane_constants()
{
  PlaneConstants c{};
  double diagonal = 1.0, factorial = 1.0;
  for (int l = 0; l <= largest_order; ++l)
  {
    if (l > 0)
    {
      diagonal /= 2.0 * l;
      factorial /= l;
    }
    c.factorial[l] = factorial;
    c.plane[l][0] = diagonal;
    for (int q = 1; l + 2 * q <= largest_order; ++q)
    {
      c.plane[l][q] = -c.plane[l][q - 1] / ((l + 2 * q) * (l + 2 * q) - l * l);
    }
  }
  return c;
}
constexpr PlaneConstants plane_constants = make_plane_constants();

/// Number of coefficients of a polynomial of this order, rounded up to a multiple of
/// polynomial_lanes.
template <int Order>
constexpr int padded_count = (Order / polynomial_lanes + 1) * polynomial_lanes;

/// Add the products of the coefficients in `row` and the harmonics (L + 2Q, L), (L + 2Q + 2, L) …
/// to the polynomial. With zeta = y + iz, rho2 is |zeta|^2, and r and i are the real and the
/// imaginary part of zeta^L * rho2^Q.
template <int Order, int L, int Q, typename Real>
BINDPOSE_ALWAYS_INLINE void add_terms(const Real* row, Real r, Real i, Real rho2, Real* polynomial)
{
  constexpr int count = Order - L - 2 * Q + 1;
  if constexpr (count > 0)
  {
    constexpr int lanes = (count + polynomial_lanes - 1) / polynomial_lanes * polynomial_lanes;
    const Real a = r * static_cast<Real>(plane_constants.plane[L][Q]);
    const Real b = i * static_cast<Real>(plane_constants.plane[L][Q]);
    const Real* const real = row + 2 * Q;
    const Real* const imaginary = real + (Order - L + 1);
    for (int j = 0; j < lanes; ++j)
    {
      const Real term = L > 0 ? a * real[j] + b * imaginary[j] : a * real[j];
      polynomial[j] += j < count ? term : Real(0);
    }
    add_terms<Order, L, Q + 1>(row, r * rho2, i * rho2, rho2, polynomial);
  }
}

/// Row l contains the coefficients (k, l) of the expansion, for all degrees k. Multiply the
/// coefficients of the rows from L to Order by their harmonics, and add the products to the
/// polynomial. re and im are the real and the imaginary part of zeta^L, where zeta = y + iz.
template <int Order, int L, typename Real>
BINDPOSE_ALWAYS_INLINE void add_rows(
  const Real* row, Real re, Real im, Real y, Real z, Real* polynomial)
{
  if constexpr (L <= Order)
  {
    add_terms<Order, L, 0>(row, re, im, y * y + z * z, polynomial);
    add_rows<Order, L + 1>(
      row + (L > 0 ? 2 : 1) * (Order - L + 1), re * y - im * z, re * z + im * y, y, z, polynomial);
  }
}

template <int Order, typename Real>
BINDPOSE_ALWAYS_INLINE void contract_rows(const Real* rows, double y, double z, double* polynomial)
{
  constexpr int capacity = padded_count<Order>;
  Real sum[capacity] = {};
  add_rows<Order, 0>(rows, Real(1), Real(0), static_cast<Real>(y), static_cast<Real>(z), sum);
  for (int j = 0; j < capacity; ++j)
  {
    polynomial[j] = static_cast<double>(sum[j]) * plane_constants.factorial[j];
  }
}

template <typename Real>
BINDPOSE_ALWAYS_INLINE void contract_by_order(
  int order, const Real* rows, double y, double z, double* polynomial)
{
  switch (order)
  {
    case 2:
      return contract_rows<2>(rows, y, z, polynomial);
    case 3:
      return contract_rows<3>(rows, y, z, polynomial);
    case 4:
      return contract_rows<4>(rows, y, z, polynomial);
    case 5:
      return contract_rows<5>(rows, y, z, polynomial);
    case 6:
      return contract_rows<6>(rows, y, z, polynomial);
    case 7:
      return contract_rows<7>(rows, y, z, polynomial);
    case 8:
      return contract_rows<8>(rows, y, z, polynomial);
    case 9:
      return contract_rows<9>(rows, y, z, polynomial);
    case 10:
      return contract_rows<10>(rows, y, z, polynomial);
    case 11:
      return contract_rows<11>(rows, y, z, polynomial);
    case 12:
      return contract_rows<12>(rows, y, z, polynomial);
    case 13:
      return contract_rows<13>(rows, y, z, polynomial);
    default:
      return contract_rows<14>(rows, y, z, polynomial);
  }
}

/// Sum the terms in pairs, then the sums in pairs, because a chain of dependent operations would be
/// slower.
double eight_terms(const double* p, double x, double x2, double x4)
{
  return ((p[0] + p[1] * x) + (p[2] + p[3] * x) * x2) +
    ((p[4] + p[5] * x) + (p[6] + p[7] * x) * x2) * x4;
}

template <typename Real>
std::array<double, 2> slopes(int order, const Real* coefficients, const Vec3& local)
{
  const double x = local[0], y = local[1], z = local[2];
  const double rho2 = y * y + z * z;
  std::array<double, 2> sums{ 0.0, 0.0 };
  const Real* row = coefficients;
  double re = 1.0, im = 0.0; // zeta^l, where zeta = y + iz
  double below_re = 0.0, below_im = 0.0; // d/d(zeta) zeta^l = l zeta^(l-1)
  for (int l = 0; l <= order; ++l)
  {
    const int size = order - l + 1;
    double power = 1.0, slope = 0.0; // rho2^q and its derivative with respect to rho2
    for (int q = 0; l + 2 * q <= order; ++q)
    {
      double real = 0.0, imaginary = 0.0;
      for (int j = order - l - 2 * q; j >= 0; --j)
      {
        const double factor = plane_constants.factorial[j];
        real = real * x + factor * static_cast<double>(row[2 * q + j]);
        imaginary =
          imaginary * x + (l > 0 ? factor * static_cast<double>(row[size + 2 * q + j]) : 0.0);
      }
      const double c = plane_constants.plane[l][q];
      const double ry = below_re * power + re * slope * 2.0 * y;
      const double iy = below_im * power + im * slope * 2.0 * y;
      const double rz = -below_im * power + re * slope * 2.0 * z;
      const double iz = below_re * power + im * slope * 2.0 * z;
      sums[0] += c * (ry * real + iy * imaginary);
      sums[1] += c * (rz * real + iz * imaginary);
      slope = (q + 1) * power;
      power *= rho2;
    }
    row += (l > 0 ? 2 : 1) * size;
    below_re = (l + 1) * re;
    below_im = (l + 1) * im;
    const double next = re * y - im * z;
    im = re * z + im * y;
    re = next;
  }
  return sums;
}
} // namespace

BINDPOSE_SIMD_CLONES void contract_local(
  int order, const float* rows, double y, double z, double* polynomial)
{
  contract_by_order(order, rows, y, z, polynomial);
}

BINDPOSE_SIMD_CLONES void contract_local(
  int order, const double* rows, double y, double z, double* polynomial)
{
  contract_by_order(order, rows, y, z, polynomial);
}

double evaluate_polynomial(const double* polynomial, int order, double x)
{
  const double x2 = x * x, x4 = x2 * x2;
  const double low = eight_terms(polynomial, x, x2, x4);
  return order < polynomial_lanes
    ? low
    : low + x4 * x4 * eight_terms(polynomial + polynomial_lanes, x, x2, x4);
}
std::array<double, 2> transverse_derivatives(int order, const float* coefficients, const Vec3& at)
{
  return slopes(order, coefficients, at);
}

std::array<double, 2> transverse_derivatives(int order, const double* coefficients, const Vec3& at)
{
  return slopes(order, coefficients, at);
}

} // namespace bindpose
