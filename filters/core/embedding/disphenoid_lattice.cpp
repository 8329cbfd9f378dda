// Keys and geometry of the body-centered cubic lattice (see disphenoid_lattice.h). Each tet belongs
// to an edge of the face between two cubes. The key of a tet contains its lower cube and three more
// properties: the normal axis of the face (a), the axis along which the edge is offset from the
// center of the face (m), and the sign of that offset (s). The edge is parallel to the third axis
// (n). With the center c of the lower cube and a, m, n as unit vectors, the nodes are
//   c,   c + a,   c + (a + s m - n) / 2,   c + (a + s m + n) / 2.
// Let d be the offset of a position from the center of its cube. Sort the axes by the absolute
// values of d's components, largest first: the sorted axes are the axes a, m, n of the tet that
// contains the position. The barycentric coordinates are sums and differences of d's components.
#include "embedding/disphenoid_lattice.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
constexpr int cube_bits = 16;
// Bits per coordinate in a node's key; coordinates are integers, in units of half cubes.
constexpr int node_bits = 17;
constexpr int tet_bits = 4;
constexpr double margin = 2.0;

/// The axes a, m, n and the sign s (`side`) of a tet, as defined at the top of this file.
struct Frame
{
  int a, m, n;
  int side;

  explicit Frame(int number)
    : a(number / 4), m((a + 1 + number / 2 % 2) % 3), n(3 - a - m), side(number % 2 ? 1 : -1)
  {
  }
  static int number(int a, int m, bool positive)
  {
    return 4 * a + 2 * (m == (a + 1) % 3 ? 0 : 1) + (positive ? 1 : 0);
  }
  /// Report whether the tet (c, c + a, lower end of the edge, upper end of the edge) has a positive
  /// volume.
  bool even() const { return (this->m == (this->a + 1) % 3) == (this->side > 0); }
};

/// Return the axes sorted by |d|, largest first. Axes with equal |d| keep their order.
std::array<int, 3> sorted_axes(const Vec3& d)
{
  std::array<int, 3> axes{ 0, 1, 2 };
  const auto less = [&](int i, int j) { return std::abs(d[i]) < std::abs(d[j]); };
  if (less(axes[0], axes[1]))
  {
    std::swap(axes[0], axes[1]);
  }
  if (less(axes[1], axes[2]))
  {
    std::swap(axes[1], axes[2]);
    if (less(axes[0], axes[1]))
    {
      std::swap(axes[0], axes[1]);
    }
  }
  return axes;
}

Vec3 from_center(const Vec3& position, const DisphenoidLattice::Cube& cube)
{
  return { position[0] - cube[0] - 0.5, position[1] - cube[1] - 0.5, position[2] - cube[2] - 0.5 };
}
} // namespace

DisphenoidLattice::DisphenoidLattice(const Box& box, double spacing)
{
  constexpr double digits = 256.0;
  int exponent = 0;
  const double mantissa = std::frexp(spacing, &exponent);
  this->spacing_ = std::ldexp(std::ceil(mantissa * digits) / digits, exponent);
  // The origin is offset from the box by a different fraction of a cube along each axis. Therefore,
  // surfaces that are parallel to the axes or pass through the middle of the box are in no plane of
  // the lattice.
  constexpr double fraction[3] = { 21.0, 13.0, 35.0 };
  const double unit = this->spacing_ / 64.0;
  for (int k = 0; k < 3; ++k)
  {
    this->origin_[k] = (std::floor(box.lower[k] / unit) - 64.0 * margin - fraction[k]) * unit;
  }
}

double DisphenoidLattice::minimum_spacing(double largest_coordinate)
{
  return std::ldexp(largest_coordinate, -36);
}

DisphenoidLattice::Key DisphenoidLattice::cube_key(const Cube& cube)
{
  return ((static_cast<Key>(cube[2]) << cube_bits | static_cast<Key>(cube[1])) << cube_bits) |
    static_cast<Key>(cube[0]);
}

DisphenoidLattice::Cube DisphenoidLattice::cube_of(Key cube_key)
{
  constexpr Key mask = (Key(1) << cube_bits) - 1;
  return { static_cast<std::int32_t>(cube_key & mask),
    static_cast<std::int32_t>(cube_key >> cube_bits & mask),
    static_cast<std::int32_t>(cube_key >> 2 * cube_bits & mask) };
}

DisphenoidLattice::Location DisphenoidLattice::locate(const Vec3& position)
{
  Cube cube = cube_of(position);
  const Vec3 d = from_center(position, cube);
  const auto [a, m, n] = sorted_axes(d);
  const bool upper = d[a] >= 0.0;
  const double dominant_offset = std::abs(d[a]);
  const double middle_offset = std::abs(d[m]);
  const double axis_coordinate = std::max(0.0, 1.0 - dominant_offset - middle_offset);
  const double other = dominant_offset - middle_offset;
  cube[a] -= upper ? 0 : 1;
  const int number = Frame::number(a, m, d[m] >= 0.0);
  const double low_end = middle_offset - d[n];
  const double high_end = middle_offset + d[n];
  const bool even = Frame(number).even();
  return { cube_key(cube) << tet_bits | static_cast<Key>(number),
    { upper ? axis_coordinate : other, upper ? other : axis_coordinate, even ? low_end : high_end,
      even ? high_end : low_end } };
}

std::array<DisphenoidLattice::Key, 4> DisphenoidLattice::corners(Key tet)
{
  const Frame frame(static_cast<int>(tet & ((Key(1) << tet_bits) - 1)));
  const Cube cube = cube_of(tet >> tet_bits);
  const auto node = [&](int a, int m, int n)
  {
    std::array<Key, 3> at{};
    at[frame.a] = static_cast<Key>(2 * cube[frame.a] + 1 + a);
    at[frame.m] = static_cast<Key>(2 * cube[frame.m] + 1 + m);
    at[frame.n] = static_cast<Key>(2 * cube[frame.n] + 1 + n);
    return (at[2] << node_bits | at[1]) << node_bits | at[0];
  };
  const int end = frame.even() ? 1 : -1;
  return { node(0, 0, 0), node(2, 0, 0), node(1, frame.side, -end), node(1, frame.side, end) };
}

Vec3 DisphenoidLattice::node_point(Key node) const
{
  constexpr Key mask = (Key(1) << node_bits) - 1;
  return this->world_point(0.5 *
    Vec3(static_cast<double>(node & mask), static_cast<double>(node >> node_bits & mask),
      static_cast<double>(node >> 2 * node_bits & mask)));
}

DisphenoidLattice::Key DisphenoidLattice::tet_of_half(const Cube& cube, int half)
{
  const int number = half / 2;
  Cube lower = cube;
  lower[Frame(number).a] -= half % 2 ? 0 : 1;
  return cube_key(lower) << tet_bits | static_cast<Key>(number);
}

int DisphenoidLattice::half_of(const Vec3& position)
{
  const Vec3 d = from_center(position, cube_of(position));
  const auto [a, m, n] = sorted_axes(d);
  return 2 * Frame::number(a, m, d[m] >= 0.0) + (d[a] >= 0.0 ? 1 : 0);
}

void DisphenoidLattice::cut(
  const Polygon& polygon, int direction, double lower, double upper, Polygon& part)
{
  // Clip by the two planes, one after the other (Sutherland and Hodgman).
  Polygon clipped;
  for (const bool first : { true, false })
  {
    const Polygon& from = first ? polygon : clipped;
    Polygon& to = first ? clipped : part;
    const double bound = first ? upper : lower;
    const double sign = first ? 1.0 : -1.0;
    for (int i = 0; i < from.count; ++i)
    {
      const Vec3& p = from.positions[i];
      const Vec3& q = from.positions[(i + 1) % from.count];
      const double at_p = sign * (coordinate_along(direction, p) - bound);
      const double at_q = sign * (coordinate_along(direction, q) - bound);
      if (at_p <= 0.0)
      {
        to.add(p);
      }
      if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0))
      {
        to.add(p + (q - p) * (at_p / (at_p - at_q)));
      }
    }
  }
}

} // namespace bindpose
