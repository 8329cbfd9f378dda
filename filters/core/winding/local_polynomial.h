#ifndef bindpose_winding_local_polynomial_h
#define bindpose_winding_local_polynomial_h

// A cell's expansion of what is far away (solid_harmonics.h), as numbers that are soon evaluated.
//
// The polar axis of the harmonics is x. With y and z given, the expansion becomes a polynomial in
// x: its coefficient j is made of F(k, l) times the harmonic (k - j, l) in the plane x = 0, divided
// by j!, as d/dx lowers the degree of a harmonic by one.
//
// The numbers of an expansion are, for l = 0 … order, the real parts of (k, l), k = l … order, then
// (l > 0) the imaginary ones, doubled. They are read up to polynomial_lanes numbers beyond their
// end.

#include "base/mesh.h"

#include <array>

namespace bindpose
{

/// Which of x, y, z the harmonics take for theirs.
constexpr int harmonic_axes[3] = { 1, 2, 0 };

constexpr int largest_polynomial_order = 14;
/// Coefficients that are worked on at once.
constexpr int polynomial_lanes = 8;
/// Coefficients of a polynomial of any order, those beyond it 0.
constexpr int polynomial_room = 2 * polynomial_lanes;

/// Numbers of an expansion.
constexpr int count_of_local(int order)
{
  return (order + 1) * (order + 1);
}

/// Orders 2 … largest_polynomial_order; as precise as the numbers' type. The same bits whatever
/// instructions the machine has.
void contract_local(int order, const float* numbers, double y, double z, double* polynomial);
void contract_local(int order, const double* numbers, double y, double z, double* polynomial);

double polynomial_at(const double* polynomial, int order, double x);

/// Derivatives of the expansion along y and z.
std::array<double, 2> slopes_across(int order, const float* numbers, const Vec3& at);
std::array<double, 2> slopes_across(int order, const double* numbers, const Vec3& at);

} // namespace bindpose

#endif
