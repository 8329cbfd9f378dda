#ifndef bindpose_winding_solid_angle_h
#define bindpose_winding_solid_angle_h

#include "base/mesh.h"

namespace bindpose
{

/// True when the point is within the tolerance of the triangle: on it, as far as doubles can tell.
bool touches_triangle(
  const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c, double tolerance);

/// Six times the signed volume of a, b, c, point: positive when the point is on the inner side of
/// the triangle (its normal points away from it). The sign holds to about 1e-30 of the size.
double side_of_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

/// Sums the solid angles of triangles at one point, about 20 ns a triangle.
///
/// Triangles that touch the point count 0 (principal value) and set on_surface(). Angles are
/// right to a few units in the last place of a full turn, whatever the triangle's shape and
/// however near the point: near triangles are evaluated with twice the digits.
/// Coordinates are expected within about 1e20 of the point (centred and scaled).
class SolidAngleSum
{
public:
  SolidAngleSum(const Vec3& point, double tolerance) : point_(point), tolerance_(tolerance) {}

  /// The triangle a, b, c, counted `multiplicity` times (negative: turned over).
  void add(const Vec3& a, const Vec3& b, const Vec3& c, int multiplicity = 1);
  /// The sum so far in full turns (4 pi): the winding number.
  double winding_number() const;
  bool on_surface() const { return this->on_surface_; }

private:
  double near_half_angle(const Vec3& a, const Vec3& b, const Vec3& c);

  Vec3 point_;
  double tolerance_;
  double half_angles_ = 0.0;
  // Product of up to three complex numbers whose angles are the half solid angles of triangles.
  double real_ = 1.0;
  double imaginary_ = 0.0;
  int factors_ = 0;
  bool on_surface_ = false;
};

inline void SolidAngleSum::add(const Vec3& a0, const Vec3& b0, const Vec3& c0, int multiplicity)
{
  const Vec3 a = a0 - this->point_;
  const Vec3 b = b0 - this->point_;
  const Vec3 c = c0 - this->point_;
  const double la = std::sqrt(a.squaredNorm());
  const double lb = std::sqrt(b.squaredNorm());
  const double lc = std::sqrt(c.squaredNorm());
  const double lengths = la * lb * lc;
  const double real = lengths + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  const double imaginary = a.dot(b.cross(c));
  // The half angle is below 45 degrees, so that four of them stay below a half turn; and the point
  // is clearly off the triangle (at a touching one, real / lengths is at most 0.63 when the
  // vertices are more than 4 tolerances away).
  const double reach = 4.0 * this->tolerance_;
  if (real > lengths && la > reach && lb > reach && lc > reach &&
    (multiplicity == 1 || multiplicity == -1))
  {
    const double signed_imaginary = multiplicity * imaginary;
    const double product = this->real_ * real - this->imaginary_ * signed_imaginary;
    this->imaginary_ = this->real_ * signed_imaginary + this->imaginary_ * real;
    this->real_ = product;
    if (++this->factors_ == 4)
    {
      this->half_angles_ += std::atan2(this->imaginary_, this->real_);
      this->real_ = 1.0;
      this->imaginary_ = 0.0;
      this->factors_ = 0;
    }
    return;
  }
  this->half_angles_ += multiplicity * this->near_half_angle(a0, b0, c0);
}

inline double SolidAngleSum::winding_number() const
{
  constexpr double two_pi = 6.283185307179586477;
  return (this->half_angles_ + std::atan2(this->imaginary_, this->real_)) / two_pi;
}

} // namespace bindpose

#endif
