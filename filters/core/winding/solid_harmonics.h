#ifndef bindpose_winding_solid_harmonics_h
#define bindpose_winding_solid_harmonics_h

// Solid harmonics for fast multipole methods, eight expansions side by side (Dehnen, A fast
// multipole method for stellar dynamics, 2014, whose conventions these are).
//
//   1 / |x - y| = sum over n >= 0, |m| <= n of conj(regular(y)) irregular(x),   |x| > |y|
//
// Of the (n, m) only m >= 0 are kept, the others follow: f(n, -m) = (-1)^m conj(f(n, m)).
// Everything works on eight lanes that do not know of each other, so the bits of a lane depend on
// nothing but that lane, whatever instructions the machine has.

namespace bindpose
{

constexpr int harmonic_lanes = 8;

/// Place of (n, m), 0 <= m <= n, in an array.
constexpr int harmonic_index(int n, int m)
{
  return n * (n + 1) / 2 + m;
}
/// Number of (n, m) with 0 <= m <= n <= order.
constexpr int harmonic_count(int order)
{
  return harmonic_index(order + 1, 0);
}

/// Highest degree that the functions below take (irregular harmonics reach it in multipole_to_local
/// of an expansion of one order less).
constexpr int max_harmonic_order = 16;

/// One double in each lane.
struct alignas(64) HarmonicLanes
{
  double lane[harmonic_lanes];
};

/// Real and imaginary parts of an expansion's coefficients.
struct Harmonics
{
  HarmonicLanes real[harmonic_count(max_harmonic_order)];
  HarmonicLanes imaginary[harmonic_count(max_harmonic_order)];

  /// Zeroes the degrees up to `order`.
  void clear(int order);
};

/// Regular (polynomial) harmonics of x, y, z up to a degree; z is the polar axis.
void regular_harmonics(int order, const HarmonicLanes (&at)[3], Harmonics& out);
/// Irregular (decaying) harmonics; at must not be 0.
void irregular_harmonics(int order, const HarmonicLanes (&at)[3], Harmonics& out);

/// out += the integral of the regular harmonics' derivative along a normal, given `value`, the
/// integral of the regular harmonics: out(n, m) of degrees 1 … order from value(n - 1, .).
void regular_derivative(
  int order, const Harmonics& value, const HarmonicLanes (&normal)[3], Harmonics& out);

/// out += `in`, multipoles of degrees 1 … order about a centre, moved: `shift` are the regular
/// harmonics of (old centre - new centre).
void multipole_to_multipole(int order, const Harmonics& shift, const Harmonics& in, Harmonics& out);

/// out += local expansion of degrees 0 … order - 1 of multipoles `in` of degrees 1 … order; only
/// products of total degree <= order are taken, so that all terms left out are of the same order.
/// `from` are the irregular harmonics of (local centre - multipole centre).
void multipole_to_local(int order, const Harmonics& from, const Harmonics& in, Harmonics& out);

/// out = the local expansion `in` of degrees 0 … order, moved: `shift` are the regular harmonics of
/// (new centre - old centre).
void local_to_local(int order, const Harmonics& shift, const Harmonics& in, Harmonics& out);

} // namespace bindpose

#endif
