// Exact tests on triangles (see triangle_predicates.h). The intersection of two triangles is
// convex. If it is more than their shared vertices and edges, it contains a point on an edge that
// is not shared. It is therefore sufficient to test edges against triangles. Each test uses a few
// exact orientation signs.
#include "surface/triangle_predicates.h"

#include "geometry/exact.h"

#include <algorithm>

namespace bindpose
{

namespace
{
/// Add sign * det(a, b, c) to an expansion, exactly.
template <int Products>
void add_determinant(
  ExactSum<Products>& sum, double sign, const Vec3& a, const Vec3& b, const Vec3& c)
{
  constexpr int orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 }, { 2, 1, 0 },
    { 1, 0, 2 } };
  for (int o = 0; o < 6; ++o)
  {
    double high, low;
    two_product(a[orders[o][0]], b[orders[o][1]], high, low);
    const double factor = (o < 3 ? sign : -sign) * c[orders[o][2]];
    sum.add_product(low, factor);
    sum.add_product(high, factor);
  }
}

/// Report whether the differences of the coordinates of two points are exact in double precision.
bool is_exact(const Vec3& a, const Vec3& b)
{
  bool exact = true;
  for (int k = 0; k < 3; ++k)
  {
    double high, low;
    two_sum(a[k], -b[k], high, low);
    exact = exact && low == 0.0;
  }
  return exact;
}

int orientation_in_plane(const Vec3& a, const Vec3& b, const Vec3& c, int axis)
{
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  return orientation_2d(a[u], a[v], b[u], b[v], c[u], c[v]);
}

/// Return an axis such that the projection of the triangle along this axis has a nonzero area.
/// Return -1 if the area of the triangle is zero.
int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (orientation_in_plane(a, b, c, axis) != 0)
    {
      return axis;
    }
  }
  return -1;
}

bool segments_meet_in_plane(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s, int axis)
{
  const int r_side = orientation_in_plane(p, q, r, axis);
  const int s_side = orientation_in_plane(p, q, s, axis);
  const int p_side = orientation_in_plane(r, s, p, axis);
  const int q_side = orientation_in_plane(r, s, q, axis);
  if (r_side == 0 && s_side == 0)
  {
    // All four points are collinear: test whether the bounding boxes of the segments overlap.
    const Vec3 lower = p.cwiseMin(q).cwiseMax(r.cwiseMin(s));
    const Vec3 upper = p.cwiseMax(q).cwiseMin(r.cwiseMax(s));
    return (lower.array() <= upper.array()).all();
  }
  return r_side * s_side <= 0 && p_side * q_side <= 0;
}

bool segment_meets_triangle_in_plane(
  const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c, int axis)
{
  const int ab = orientation_in_plane(a, b, p, axis);
  const int bc = orientation_in_plane(b, c, p, axis);
  const int ca = orientation_in_plane(c, a, p, axis);
  if ((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0))
  {
    return true;
  }
  return segments_meet_in_plane(p, q, a, b, axis) || segments_meet_in_plane(p, q, b, c, axis) ||
    segments_meet_in_plane(p, q, c, a, axis);
}

/// Report whether a segment and a triangle have a common point. If they are coplanar, they are
/// projected along `axis`. The projection of the triangle must have a nonzero area.
bool segment_meets_triangle(
  const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c, int axis)
{
  const int p_side = orientation_3d(a, b, c, p);
  const int q_side = orientation_3d(a, b, c, q);
  if (p_side == 0 && q_side == 0)
  {
    return segment_meets_triangle_in_plane(p, q, a, b, c, axis);
  }
  if (p_side * q_side > 0)
  {
    return false;
  }
  const int ab = orientation_3d(p, q, a, b);
  const int bc = orientation_3d(p, q, b, c);
  const int ca = orientation_3d(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}
} // namespace

int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 u = a - d;
  const Vec3 v = b - d;
  const Vec3 w = c - d;
  const double vw = v.x() * w.y(), wv = w.x() * v.y();
  const double wu = w.x() * u.y(), uw = u.x() * w.y();
  const double uv = u.x() * v.y(), vu = v.x() * u.y();
  // det(u, v, w) is minus six times the volume.
  const double determinant = u.z() * (vw - wv) + v.z() * (wu - uw) + w.z() * (uv - vu);
  const double size = std::abs(u.z()) * (std::abs(vw) + std::abs(wv)) +
    std::abs(v.z()) * (std::abs(wu) + std::abs(uw)) +
    std::abs(w.z()) * (std::abs(uv) + std::abs(vu));
  constexpr double bound = 7.7715611723761027e-16; // (7 + 56 e) e, e = 2^-53 (Shewchuk 1997)
  if (std::abs(determinant) > bound * size)
  {
    return determinant < 0.0 ? 1 : -1;
  }
  // Coordinates with few digits, as in CAD, have exact differences. The determinant then needs only
  // a fourth of the products.
  if (is_exact(a, d) && is_exact(b, d) && is_exact(c, d))
  {
    ExactSum<12> translated_sum;
    add_determinant(translated_sum, 1.0, u, v, w);
    return -translated_sum.sign();
  }
  ExactSum<48> sum;
  add_determinant(sum, 1.0, b, c, d);
  add_determinant(sum, -1.0, a, c, d);
  add_determinant(sum, 1.0, a, b, d);
  add_determinant(sum, -1.0, a, b, c);
  return sum.sign();
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return projection_axis(a, b, c) < 0;
}

bool segment_meets_triangle(
  const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const int axis = projection_axis(a, b, c);
  return axis >= 0 && segment_meets_triangle(p, q, a, b, c, axis);
}

bool triangles_cross(PointsView points, TrianglesView triangles, Index f, Index g)
{
  std::array<Index, 3> s{ triangles(f, 0), triangles(f, 1), triangles(f, 2) };
  std::array<Index, 3> t{ triangles(g, 0), triangles(g, 1), triangles(g, 2) };
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    const auto shared_corner = std::find(t.begin() + shared, t.end(), s[i]);
    if (shared_corner != t.end())
    {
      std::swap(t[shared], *shared_corner);
      std::swap(s[shared], s[i]);
      ++shared;
    }
  }
  if (f == g || shared == 3)
  {
    return false;
  }
  std::array<Vec3, 3> a, b;
  for (int k = 0; k < 3; ++k)
  {
    a[k] = points.row(s[k]);
    b[k] = points.row(t[k]);
  }
  const int a_axis = projection_axis(a[0], a[1], a[2]);
  const int b_axis = projection_axis(b[0], b[1], b[2]);
  if (a_axis < 0 || b_axis < 0)
  {
    return false;
  }
  if (shared == 2)
  {
    // Test whether two triangles with a common edge overlap in one plane.
    return orientation_3d(a[0], a[1], a[2], b[2]) == 0 &&
      orientation_in_plane(a[0], a[1], a[2], a_axis) ==
      orientation_in_plane(a[0], a[1], b[2], a_axis);
  }
  if (shared == 1)
  {
    return segment_meets_triangle(a[1], a[2], b[0], b[1], b[2], b_axis) ||
      segment_meets_triangle(b[1], b[2], a[0], a[1], a[2], a_axis);
  }
  for (int k = 0; k < 3; ++k)
  {
    if (segment_meets_triangle(a[k], a[(k + 1) % 3], b[0], b[1], b[2], b_axis) ||
      segment_meets_triangle(b[k], b[(k + 1) % 3], a[0], a[1], a[2], a_axis))
    {
      return true;
    }
  }
  return false;
}

namespace
{
Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double length = ab.squaredNorm();
  return a + (length > 0.0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0.0) * ab;
}
} // namespace

Vec3 closest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  // If the corners are almost collinear, the tests below are unreliable because of rounding. In
  // this case, return the nearest point of the three edges.
  constexpr double flatness_tolerance = 1e-10;
  if ((b - a).cross(c - a).squaredNorm() <=
    flatness_tolerance * flatness_tolerance * (b - a).squaredNorm() * (c - a).squaredNorm())
  {
    Vec3 closest = closest_on_segment(p, a, b);
    for (const Vec3& other : { closest_on_segment(p, b, c), closest_on_segment(p, c, a) })
    {
      closest = (other - p).squaredNorm() < (closest - p).squaredNorm() ? other : closest;
    }
    return closest;
  }
  // The Voronoi regions of the corners, the edges and the interior of the triangle divide space.
  // Find the region that contains p (Ericson, Real-Time Collision Detection, 5.1.5).
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0)
  {
    return a;
  }
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3)
  {
    return b;
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
  {
    return a + (d1 > d3 ? d1 / (d1 - d3) : 0.0) * ab;
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6)
  {
    return c;
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
  {
    return a + (d2 > d6 ? d2 / (d2 - d6) : 0.0) * ac;
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
  {
    const double length = (d4 - d3) + (d5 - d6);
    return b + (length > 0.0 ? (d4 - d3) / length : 0.0) * (c - b);
  }
  const double sum = va + vb + vc;
  return sum > 0.0 ? Vec3(a + (vb / sum) * ab + (vc / sum) * ac) : a;
}

} // namespace bindpose
