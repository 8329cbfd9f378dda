// Recurrences and translations of solid harmonics (Dehnen 2014, section A). Each function processes
// eight expansions in parallel. HarmonicPack is a vector type of the compiler; each of its eight
// lanes contains a number of one expansion. No operation mixes lanes.
//
// Regular harmonics U and irregular ones T:
//   U(n, n) = (x + iy) / (2n) U(n-1, n-1)
//   (n^2 - m^2) U(n, m) = (2n-1) z U(n-1, m) - r^2 U(n-2, m)
//   T(n, n) = (2n-1) (x + iy) / r^2 T(n-1, n-1)
//   r^2 T(n, m) = (2n-1) z T(n-1, m) - ((n-1)^2 - m^2) T(n-2, m)
// Derivatives: d/dz U(n, m) = U(n-1, m), (d/dx ± i d/dy) U(n, m) = ∓ U(n-1, m±1).
#include "solid_angle/solid_harmonics.h"

namespace bindpose
{

namespace
{
/// The coefficient (n, m) for any sign of m is the stored coefficient at `index` with its real part
/// multiplied by `real_sign` and its imaginary part by `imaginary_sign`.
struct StoredCoefficient
{
  int index;
  double real_sign, imaginary_sign;
};

BINDPOSE_ALWAYS_INLINE StoredCoefficient stored_coefficient(int n, int m)
{
  if (m >= 0)
  {
    return { harmonic_index(n, m), 1.0, 1.0 };
  }
  const double sign = m % 2 ? -1.0 : 1.0;
  return { harmonic_index(n, -m), sign, -sign };
}
} // namespace

void Harmonics::clear(int order)
{
  for (int i = 0; i < harmonic_count(order); ++i)
  {
    this->real[i] = {};
    this->imaginary[i] = {};
  }
}

BINDPOSE_SIMD_CLONES void regular_harmonics(
  int order, const HarmonicLanes (&position)[3], Harmonics& out)
{
  const HarmonicPack x = pack(position[0]), y = pack(position[1]), z = pack(position[2]);
  const HarmonicPack r2 = x * x + y * y + z * z;
  const HarmonicPack zero = x - x;
  pack(out.real[0]) = zero + 1.0;
  pack(out.imaginary[0]) = zero;
  for (int n = 1; n <= order; ++n)
  {
    const int d = harmonic_index(n - 1, n - 1);
    const int e = harmonic_index(n, n);
    const double half = 1.0 / (2.0 * n);
    const HarmonicPack re = pack(out.real[d]) * half, im = pack(out.imaginary[d]) * half;
    pack(out.real[e]) = x * re - y * im;
    pack(out.imaginary[e]) = x * im + y * re;
    const HarmonicPack zn = z * (2.0 * n - 1.0);
    for (int m = 0; m < n; ++m)
    {
      const int a = harmonic_index(n, m), b = harmonic_index(n - 1, m);
      const double scale = 1.0 / (n * n - m * m);
      HarmonicPack re2 = zn * pack(out.real[b]), im2 = zn * pack(out.imaginary[b]);
      if (m <= n - 2)
      {
        const int c = harmonic_index(n - 2, m);
        re2 -= r2 * pack(out.real[c]);
        im2 -= r2 * pack(out.imaginary[c]);
      }
      pack(out.real[a]) = re2 * scale;
      pack(out.imaginary[a]) = im2 * scale;
    }
  }
}

BINDPOSE_SIMD_CLONES void irregular_harmonics(
  int order, const HarmonicLanes (&position)[3], Harmonics& out)
{
  const HarmonicPack r2 = pack(position[0]) * pack(position[0]) +
    pack(position[1]) * pack(position[1]) + pack(position[2]) * pack(position[2]);
  const HarmonicPack inverse = 1.0 / r2;
  const HarmonicPack x = pack(position[0]) * inverse, y = pack(position[1]) * inverse,
                     z = pack(position[2]) * inverse;
  HarmonicLanes root;
  for (int i = 0; i < harmonic_lanes; ++i)
  {
    root.lane[i] = __builtin_sqrt(inverse[i]);
  }
  pack(out.real[0]) = pack(root);
  pack(out.imaginary[0]) = inverse - inverse;
  for (int n = 1; n <= order; ++n)
  {
    const int d = harmonic_index(n - 1, n - 1);
    const int e = harmonic_index(n, n);
    const double odd = 2.0 * n - 1.0;
    const HarmonicPack re = pack(out.real[d]) * odd, im = pack(out.imaginary[d]) * odd;
    pack(out.real[e]) = x * re - y * im;
    pack(out.imaginary[e]) = x * im + y * re;
    const HarmonicPack zn = z * odd;
    for (int m = 0; m < n; ++m)
    {
      const int a = harmonic_index(n, m), b = harmonic_index(n - 1, m);
      HarmonicPack re2 = zn * pack(out.real[b]), im2 = zn * pack(out.imaginary[b]);
      if (m <= n - 2)
      {
        const int c = harmonic_index(n - 2, m);
        const HarmonicPack factor = inverse * static_cast<double>((n - 1) * (n - 1) - m * m);
        re2 -= factor * pack(out.real[c]);
        im2 -= factor * pack(out.imaginary[c]);
      }
      pack(out.real[a]) = re2;
      pack(out.imaginary[a]) = im2;
    }
  }
}

BINDPOSE_SIMD_CLONES void regular_derivative(
  int order, const Harmonics& value, const HarmonicLanes (&normal)[3], Harmonics& out)
{
  const HarmonicPack x = 0.5 * pack(normal[0]), y = 0.5 * pack(normal[1]), z = pack(normal[2]);
  for (int n = 1; n <= order; ++n)
  {
    for (int m = 0; m <= n; ++m)
    {
      const int a = harmonic_index(n, m);
      HarmonicPack re = z - z, im = re;
      if (m <= n - 1)
      {
        const int b = harmonic_index(n - 1, m);
        re += z * pack(value.real[b]);
        im += z * pack(value.imaginary[b]);
      }
      if (m + 1 <= n - 1) // -(x - iy) U(n-1, m+1)
      {
        const int b = harmonic_index(n - 1, m + 1);
        re -= x * pack(value.real[b]) + y * pack(value.imaginary[b]);
        im -= x * pack(value.imaginary[b]) - y * pack(value.real[b]);
      }
      if (1 - m <= n - 1) // (x + iy) U(n-1, m-1)
      {
        const StoredCoefficient b = stored_coefficient(n - 1, m - 1);
        const HarmonicPack ure = pack(value.real[b.index]) * b.real_sign;
        const HarmonicPack uim = pack(value.imaginary[b.index]) * b.imaginary_sign;
        re += x * ure - y * uim;
        im += x * uim + y * ure;
      }
      pack(out.real[a]) += re;
      pack(out.imaginary[a]) += im;
    }
  }
}

BINDPOSE_SIMD_CLONES void multipole_to_multipole(
  int order, const Harmonics& shift, const Harmonics& in, Harmonics& out)
{
  for (int n = 1; n <= order; ++n)
  {
    for (int m = 0; m <= n; ++m)
    {
      const int a = harmonic_index(n, m);
      HarmonicPack re = pack(out.real[a]), im = pack(out.imaginary[a]);
      for (int k = 0; k < n; ++k)
      {
        const int d = n - k;
        for (int l = m - d > -k ? m - d : -k; l <= (m + d < k ? m + d : k); ++l)
        {
          const StoredCoefficient s = stored_coefficient(k, l), c = stored_coefficient(d, m - l);
          const double rr = s.real_sign * c.real_sign;
          const double ii = s.imaginary_sign * c.imaginary_sign;
          const double ri = s.real_sign * c.imaginary_sign;
          const double ir = s.imaginary_sign * c.real_sign;
          const HarmonicPack sr = pack(shift.real[s.index]), si = pack(shift.imaginary[s.index]);
          const HarmonicPack cr = pack(in.real[c.index]), ci = pack(in.imaginary[c.index]);
          re += rr * (sr * cr) - ii * (si * ci);
          im += ri * (sr * ci) + ir * (si * cr);
        }
      }
      pack(out.real[a]) = re;
      pack(out.imaginary[a]) = im;
    }
  }
}

BINDPOSE_SIMD_CLONES void multipole_to_local(
  int order, const Harmonics& from, const Harmonics& in, Harmonics& out)
{
  for (int k = 0; k < order; ++k)
  {
    for (int l = 0; l <= k; ++l)
    {
      HarmonicPack re = pack(from.real[0]) - pack(from.real[0]);
      HarmonicPack im = re;
      for (int n = 1; n <= order - k; ++n)
      {
        const int row = harmonic_index(n + k, 0);
        const HarmonicPack m0 = pack(in.real[harmonic_index(n, 0)]);
        re += m0 * pack(from.real[row + l]);
        im += m0 * pack(from.imaginary[row + l]);
        // The coefficients M(n, m) and M(n, -m) are processed together.
        for (int m = 1; m <= n; ++m)
        {
          const HarmonicPack mr = pack(in.real[harmonic_index(n, m)]);
          const HarmonicPack mi = pack(in.imaginary[harmonic_index(n, m)]);
          const HarmonicPack pr = pack(from.real[row + l + m]),
                             pi = pack(from.imaginary[row + l + m]);
          if (m <= l)
          {
            HarmonicPack qr = pack(from.real[row + l - m]), qi = pack(from.imaginary[row + l - m]);
            if (m % 2)
            {
              qr = -qr;
              qi = -qi;
            }
            re += mr * (pr + qr) + mi * (pi - qi);
            im += mr * (pi + qi) + mi * (qr - pr);
          }
          else
          {
            // (-1)^m T(., l - m) = (-1)^l conj(T(., m - l))
            HarmonicPack qr = pack(from.real[row + m - l]), qi = pack(from.imaginary[row + m - l]);
            if (l % 2)
            {
              qr = -qr;
              qi = -qi;
            }
            re += mr * (pr + qr) + mi * (pi + qi);
            im += mr * (pi - qi) + mi * (qr - pr);
          }
        }
      }
      const int a = harmonic_index(k, l);
      if (k % 2)
      {
        pack(out.real[a]) -= re;
        pack(out.imaginary[a]) -= im;
      }
      else
      {
        pack(out.real[a]) += re;
        pack(out.imaginary[a]) += im;
      }
    }
  }
}

BINDPOSE_SIMD_CLONES void local_to_local(
  int order, const Harmonics& shift, const Harmonics& in, Harmonics& out)
{
  for (int k = 0; k <= order; ++k)
  {
    for (int l = 0; l <= k; ++l)
    {
      HarmonicPack re = pack(in.real[0]) - pack(in.real[0]);
      HarmonicPack im = re;
      for (int n = k; n <= order; ++n)
      {
        const int d = n - k;
        for (int m = l - d > -n ? l - d : -n; m <= (l + d < n ? l + d : n); ++m)
        {
          // conj(U(d, m - l)) F(n, m)
          const StoredCoefficient s = stored_coefficient(d, m - l), c = stored_coefficient(n, m);
          const double rr = s.real_sign * c.real_sign;
          const double ii = s.imaginary_sign * c.imaginary_sign;
          const double ri = s.real_sign * c.imaginary_sign;
          const double ir = s.imaginary_sign * c.real_sign;
          const HarmonicPack sr = pack(shift.real[s.index]), si = pack(shift.imaginary[s.index]);
          const HarmonicPack cr = pack(in.real[c.index]), ci = pack(in.imaginary[c.index]);
          re += rr * (sr * cr) + ii * (si * ci);
          im += ri * (sr * ci) - ir * (si * cr);
        }
      }
      pack(out.real[harmonic_index(k, l)]) = re;
      pack(out.imaginary[harmonic_index(k, l)]) = im;
    }
  }
}

} // namespace bindpose
