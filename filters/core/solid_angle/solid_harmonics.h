#ifndef bindpose_solid_angle_solid_harmonics_h
#define bindpose_solid_angle_solid_harmonics_h

// Solid harmonics for fast multipole methods, for eight expansions in parallel. The conventions are
// those of Dehnen, A fast multipole method for stellar dynamics, 2014.
//
//   1 / |x - y| = sum over n >= 0, |m| <= n of conj(regular(y)) irregular(x),   |x| > |y|
//
// Only coefficients (n, m) with m >= 0 are stored; f(n, -m) = (-1)^m conj(f(n, m)). The eight lanes
// are independent: the bits of a lane depend on that lane only, on every instruction set.

#include "solid_angle/harmonic_lanes.h"

namespace bindpose
{

/// Return the array index of the coefficient (n, m), 0 <= m <= n.
constexpr int harmonic_index(int n, int m)
{
  return n * (n + 1) / 2 + m;
}
/// Return the number of coefficients (n, m) with 0 <= m <= n <= order.
constexpr int harmonic_count(int order)
{
  return harmonic_index(order + 1, 0);
}

/// Highest degree that the functions below accept. A local expansion of order p uses irregular
/// harmonics of degree p + 1 (multipole_to_local).
constexpr int max_harmonic_order = 16;

/// Real and imaginary parts of the coefficients (n, m) of an expansion.
struct Harmonics
{
  HarmonicLanes real[harmonic_count(max_harmonic_order)];
  HarmonicLanes imaginary[harmonic_count(max_harmonic_order)];

  /// Set the coefficients up to degree `order` to zero.
  void clear(int order);
};

/// Compute the regular (polynomial) harmonics of x, y, z up to degree `order`; z is the polar axis.
void regular_harmonics(int order, const HarmonicLanes (&position)[3], Harmonics& out);
/// Compute the irregular (decaying) harmonics; `position` must not be 0.
void irregular_harmonics(int order, const HarmonicLanes (&position)[3], Harmonics& out);

/// Add the derivatives of the regular harmonics along the vector `normal` to `out`. `value`
/// contains the regular harmonics or their integrals. If `value` contains integrals, the integrals
/// of the derivatives are added. The coefficients out(n, m) of degrees n = 1 … order are computed
/// from value(n - 1, .).
void regular_derivative(
  int order, const Harmonics& value, const HarmonicLanes (&normal)[3], Harmonics& out);

/// Add to `out` the multipoles `in` of degrees 1 … order, moved to another center. `shift` contains
/// the regular harmonics of (old center - new center).
void multipole_to_multipole(int order, const Harmonics& shift, const Harmonics& in, Harmonics& out);

/// Convert the multipoles `in` (degrees 1 … order) to a local expansion (degrees 0 … order - 1),
/// and add the local expansion to `out`. Contributions of multipoles of degree n to local
/// coefficients of degree k are omitted if n + k > order. Their sum would be incomplete anyway,
/// because multipoles of degree n > order are not available. `from` contains the irregular
/// harmonics of (local center - multipole center).
void multipole_to_local(int order, const Harmonics& from, const Harmonics& in, Harmonics& out);

/// Set `out` to the local expansion `in` of degrees 0 … order, moved to another center. `shift`
/// contains the regular harmonics of (new center - old center).
void local_to_local(int order, const Harmonics& shift, const Harmonics& in, Harmonics& out);

} // namespace bindpose

#endif
