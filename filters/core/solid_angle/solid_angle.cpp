// Solid angles of triangles. At every distance from the triangle, the error is a few units in the
// last place of a full turn.
//
// The solid angle of a triangle a, b, c seen from the origin is twice the angle of the complex
// number (|a||b||c| + a.b|c| + b.c|a| + c.a|b|) + i a.(b x c) (Van Oosterom and Strackee, 1983).
// Far from the triangle, solid_angle.h multiplies the complex numbers of four triangles and
// computes the angle of the product.
//
// Near the triangle, cancellation occurs in the real and the imaginary part. Next to a sliver both
// parts have the size of the squared width of the sliver. Even double-double arithmetic would then
// lose all digits. Let u = |a|b + |b|a and v = |a|c + |c|a, which bisect the angles between a and b
// and between a and c. The angle of the complex number above equals the angle from u to v around a,
// which is the angle of the complex number |a| u.v + i a.(u x v). If a is on one side of the point
// and b and c are on the opposite side, u and v are small. Both vectors are still exact to
// double-double precision, and their products lose no more digits.
//
// The solid angle of a triangle jumps where the point crosses the triangle, so it is undefined for
// a point that touches the triangle. Such a triangle contributes 0, the mean of the values on its
// two sides.
#include "solid_angle/solid_angle.h"

#include "geometry/exact.h"

#include <algorithm>

namespace bindpose
{

namespace
{
using DoubleDouble3 = std::array<DoubleDouble, 3>;

DoubleDouble3 exact_difference(const Vec3& a, const Vec3& b)
{
  DoubleDouble3 difference;
  for (int k = 0; k < 3; ++k)
  {
    two_sum(a[k], -b[k], difference[k].high, difference[k].low);
  }
  return difference;
}

DoubleDouble dot(const DoubleDouble3& a, const DoubleDouble3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

DoubleDouble determinant(const DoubleDouble3& a, const DoubleDouble3& b, const DoubleDouble3& c)
{
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
    a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Return s a + t b.
DoubleDouble3 sum(
  const DoubleDouble& s, const DoubleDouble3& a, const DoubleDouble& t, const DoubleDouble3& b)
{
  return { s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2] };
}

/// Return the squared distance of the origin from the segment a, b.
double squared_distance_from_segment(const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double length = ab.squaredNorm();
  const double t = length > 0.0 ? std::clamp(-a.dot(ab) / length, 0.0, 1.0) : 0.0;
  return (a + t * ab).squaredNorm();
}
} // namespace

bool touches_triangle(
  const Vec3& point, const Vec3& a0, const Vec3& b0, const Vec3& c0, double tolerance)
{
  const Vec3 a = a0 - point;
  const Vec3 b = b0 - point;
  const Vec3 c = c0 - point;
  const double limit = tolerance * tolerance;
  if (squared_distance_from_segment(a, b) <= limit ||
    squared_distance_from_segment(b, c) <= limit || squared_distance_from_segment(c, a) <= limit)
  {
    return true;
  }
  // The point is not near an edge, so round-off does not decide whether the projection of the point
  // is inside the triangle.
  const Vec3 normal = (b - a).cross(c - a);
  if (normal.dot(a.cross(b)) <= 0.0 || normal.dot(b.cross(c)) <= 0.0 ||
    normal.dot(c.cross(a)) <= 0.0)
  {
    return false;
  }
  return std::abs(side_of_triangle(point, a0, b0, c0)) <= tolerance * normal.norm();
}

double side_of_triangle(const Vec3& point, const Vec3& a0, const Vec3& b0, const Vec3& c0)
{
  const Vec3 a = a0 - point;
  const Vec3 b = b0 - point;
  const Vec3 c = c0 - point;
  const Vec3 absolute_cross(std::abs(b.y() * c.z()) + std::abs(b.z() * c.y()),
    std::abs(b.z() * c.x()) + std::abs(b.x() * c.z()),
    std::abs(b.x() * c.y()) + std::abs(b.y() * c.x()));
  const double side = a.dot(b.cross(c));
  if (std::abs(side) > 8e-16 * a.cwiseAbs().dot(absolute_cross))
  {
    return side;
  }
  return determinant(
    exact_difference(a0, point), exact_difference(b0, point), exact_difference(c0, point))
    .value();
}

double SolidAngleSum::near_half_angle(const Vec3& a0, const Vec3& b0, const Vec3& c0)
{
  if (touches_triangle(this->point_, a0, b0, c0, this->tolerance_))
  {
    this->on_surface_ = true;
    return 0.0;
  }
  // Use as first corner the one for which, seen from the point, the directions to the other two
  // corners form the smallest angle.
  std::array<Vec3, 3> corners{ a0, b0, c0 };
  std::array<Vec3, 3> directions;
  for (int k = 0; k < 3; ++k)
  {
    directions[k] = (corners[k] - this->point_).normalized();
  }
  const double cosines[3] = { directions[1].dot(directions[2]), directions[2].dot(directions[0]),
    directions[0].dot(directions[1]) };
  const auto first = std::max_element(cosines, cosines + 3) - cosines;
  std::rotate(corners.begin(), corners.begin() + first, corners.end());
  const DoubleDouble3 a = exact_difference(corners[0], this->point_);
  const DoubleDouble3 b = exact_difference(corners[1], this->point_);
  const DoubleDouble3 c = exact_difference(corners[2], this->point_);
  const DoubleDouble la = sqrt(dot(a, a));
  const DoubleDouble3 u = sum(la, b, sqrt(dot(b, b)), a);
  const DoubleDouble3 v = sum(la, c, sqrt(dot(c, c)), a);
  const double real = dot(u, v).value() * la.value();
  const double imaginary = determinant(a, u, v).value();
  return imaginary == 0.0 ? 0.0 : std::atan2(imaginary, real);
}

} // namespace bindpose
