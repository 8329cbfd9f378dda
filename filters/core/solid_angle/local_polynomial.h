#ifndef bindpose_solid_angle_local_polynomial_h
#define bindpose_solid_angle_local_polynomial_h

// Evaluation of a cell's local expansion, which approximates the winding number of the far
// triangles (see dipole_field.h and solid_harmonics.h).
//
// The polar axis of the harmonics is x. Let F(k, l) be the coefficients of the expansion. For given
// y and z, the expansion is a polynomial in x. Coefficient j of the polynomial is the sum of F(k,
// l) times the harmonic (k - j, l) in the plane x = 0, divided by j!, because d/dx lowers the
// degree of a harmonic by one.
//
// The coefficients of an expansion are stored for l = 0 … order: first the real parts of (k, l), k
// = l … order, then for l > 0 their imaginary parts. All coefficients with l > 0 are doubled. The
// functions read up to polynomial_lanes values beyond the end of the array, so the array must be
// padded.

#include "geometry/mesh.h"

#include <array>

namespace bindpose
{

/// Coordinate axes that serve as the x, y and z axes of the harmonics.
constexpr int harmonic_axes[3] = { 1, 2, 0 };

constexpr int largest_polynomial_order = 14;
/// Number of coefficients that are processed in parallel.
constexpr int polynomial_lanes = 8;
/// Capacity of an array for the coefficients of a polynomial of any order; unused coefficients are
/// 0.
constexpr int polynomial_capacity = 2 * polynomial_lanes;

/// Return the number of values in an expansion.
constexpr int local_coefficient_count(int order)
{
  return (order + 1) * (order + 1);
}

/// Contract an expansion to a polynomial in x for the specified y and z, in the precision of
/// `coefficients`. `order` must be 2 … largest_polynomial_order. The result has the same bits on
/// every instruction set.
void contract_local(int order, const float* coefficients, double y, double z, double* polynomial);
void contract_local(int order, const double* coefficients, double y, double z, double* polynomial);

double evaluate_polynomial(const double* polynomial, int order, double x);

/// Return the derivatives of the expansion along y and z.
std::array<double, 2> transverse_derivatives(int order, const float* coefficients, const Vec3& at);
std::array<double, 2> transverse_derivatives(int order, const double* coefficients, const Vec3& at);

} // namespace bindpose

#endif
