// Crossing test between a segment and a triangle by the signs of five tetrahedron volumes, with an
// error bound for each sign.
#include "solid_angle/segment_crossing.h"

#include <algorithm>

namespace bindpose
{

namespace
{
/// Error bound of the volumes, relative to the cube of the largest coordinate. A tighter bound
/// applies to tetrahedra that have the segment as an edge. The tighter bound is relative to the
/// squared largest coordinate times the length of the segment. In units of 2^-53, subtractions
/// contribute 1, cross products 28 and volumes 90. The bound is rounded up.
constexpr double relative_error = 0x1p-53 * 256.0;
} // namespace

Crossing crossing(const Vec3& p, const Vec3& r, const std::array<Vec3, 3>& corners)
{
  const Vec3 a = corners[0] - p;
  const Vec3 b = corners[1] - p;
  const Vec3 c = corners[2] - p;
  const Vec3 d = r - p;
  const double length = d.lpNorm<Eigen::Infinity>();
  const double size = std::max({ a.lpNorm<Eigen::Infinity>(), b.lpNorm<Eigen::Infinity>(),
    c.lpNorm<Eigen::Infinity>(), length });
  const double error = relative_error * size * size * size;
  const double edge_error = relative_error * size * size * length;
  const Vec3 bc = b.cross(c);
  const double u = d.dot(bc);
  const double v = d.dot(c.cross(a));
  const double w = d.dot(a.cross(b));
  const double side = a.dot(bc);
  const double other_side = side - (u + v + w);
  const double minimum = std::min({ u, v, w });
  const double maximum = std::max({ u, v, w });
  if ((minimum < -edge_error && maximum > edge_error) || std::min(side, other_side) > error ||
    std::max(side, other_side) < -error)
  {
    return Crossing::none;
  }
  if (minimum > edge_error && side > error && other_side < -error)
  {
    return Crossing::outwards;
  }
  if (maximum < -edge_error && side < -error && other_side > error)
  {
    return Crossing::inwards;
  }
  return Crossing::undecided;
}

} // namespace bindpose
