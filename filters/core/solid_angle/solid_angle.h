#ifndef bindpose_solid_angle_solid_angle_h
#define bindpose_solid_angle_solid_angle_h

// Solid angles of triangles, accurate at every distance. The winding number is a sum of solid
// angles.

#include "base/constants.h"
#include "geometry/mesh.h"

namespace bindpose
{

/// Report whether the distance between the point and the triangle is at most `tolerance`.
bool touches_triangle(
  const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c, double tolerance);

/// Return six times the signed volume of the tetrahedron a, b, c, point. The volume is positive if
/// the triangle's normal points away from the point, that is, if the point is on the inner side of
/// the triangle. The sign is reliable unless the result is smaller than about 1e-30 times the
/// product of the distances of a, b and c from the point.
double side_of_triangle(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c);

/// Sum of the solid angles of triangles at one point, about 20 ns per triangle.
///
/// Triangles that touch the point contribute 0 (the principal value) and set on_surface(). Angles
/// are accurate to a few units in the last place of a full turn for every shape and distance of a
/// triangle, because near triangles are evaluated in double-double arithmetic. Coordinates must be
/// centered and scaled. No vertex may be farther than about 1e20 from the point, because products
/// of distances would overflow.
class SolidAngleSum
{
public:
  SolidAngleSum(const Vec3& point, double tolerance) : point_(point), tolerance_(tolerance) {}

  /// Add the triangle a, b, c `multiplicity` times. A negative multiplicity reverses the
  /// orientation.
  void add(const Vec3& a, const Vec3& b, const Vec3& c, int multiplicity = 1);
  /// Return the current sum in full turns (4 pi), which is the winding number.
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
  // real > lengths implies that half the solid angle is below 45 degrees. The sum of four such
  // angles is then below a half turn. Together with the minimum distance of the vertices, the
  // condition also excludes triangles that touch the point: real / lengths is at most 0.63 for a
  // touching triangle whose vertices are more than 4 tolerances away.
  const double near_distance = 4.0 * this->tolerance_;
  if (real > lengths && la > near_distance && lb > near_distance && lc > near_distance &&
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
  return (this->half_angles_ + std::atan2(this->imaginary_, this->real_)) / two_pi;
}

} // namespace bindpose

#endif
