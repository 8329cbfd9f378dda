#ifndef bindpose_embedding_disphenoid_lattice_h
#define bindpose_embedding_disphenoid_lattice_h

#include "geometry/mesh.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace bindpose
{

/// The body-centered cubic lattice, divided into tets (disphenoids). The lattice is unbounded and
/// not stored: its elements are computed from keys. Its nodes are the corners and centers of cubes
/// of edge length `spacing`. Around the common face of two cubes are four congruent tets, with
/// dihedral angles of 60 and 90 degrees. Each of them has the centers of both cubes and the ends of
/// one edge of the face as corners. All facets are in planes where the sum or the difference of two
/// coordinates, in units of cubes, is an integer.
///
/// In this class, a position is relative to the origin, in units of cubes; a point is in world
/// coordinates. Cubes have the integer coordinates (0, 0, 0) to (65535, 65535, 65535).
class DisphenoidLattice
{
public:
  using Key = std::uint64_t;
  using Cube = std::array<std::int32_t, 3>;

  DisphenoidLattice() = default;
  /// Make a lattice with at least two cubes of margin around the box. The spacing is rounded up to
  /// 8 binary digits and the origin to a 64th of the spacing. Coordinates of nodes are therefore
  /// exact if the spacing is at least minimum_spacing().
  DisphenoidLattice(const Box& box, double spacing);
  /// Return the smallest spacing for which node coordinates are exact, for a box whose
  /// coordinates have absolute values up to `largest_coordinate`.
  static double minimum_spacing(double largest_coordinate);

  double spacing() const { return this->spacing_; }
  const Vec3& origin() const { return this->origin_; }
  Vec3 lattice_position(const Vec3& point) const
  {
    return (point - this->origin_) / this->spacing_;
  }
  Vec3 world_point(const Vec3& position) const { return this->origin_ + this->spacing_ * position; }

  static Cube cube_of(const Vec3& position)
  {
    return { static_cast<std::int32_t>(std::floor(position[0])),
      static_cast<std::int32_t>(std::floor(position[1])),
      static_cast<std::int32_t>(std::floor(position[2])) };
  }
  static Key cube_key(const Cube& cube);
  static Cube cube_of(Key cube_key);

  /// The tet that contains a position, and the position's barycentric coordinates, all >= 0, in the
  /// order of corners(). A position on a facet, edge or node belongs to one of the adjacent tets,
  /// always the same one.
  struct Location
  {
    Key tet = 0;
    std::array<double, 4> coordinates{};
  };
  static Location locate(const Vec3& position);

  /// Return the keys of a tet's nodes, in the order that makes its volume positive.
  static std::array<Key, 4> corners(Key tet);
  Vec3 node_point(Key node) const;

  /// Two corners of a tet are the centers of two neighboring cubes, its lower and its upper cube.
  /// The face between these cubes divides the tet into two halves, one in each cube. Therefore a
  /// cube contains 24 halves: halves 1, 3, 5, … belong to the 12 tets of which it is the lower
  /// cube, and halves 0, 2, 4, … to the 12 tets of which it is the upper cube. The two halves of
  /// the tet with number n (see number_of) are half 2n + 1 of its lower cube and half 2n of its
  /// upper cube.
  static constexpr int halves = 24;
  static Key tet_of_half(const Cube& cube, int half);
  /// Return the number n of a tet, 0 … 11, among the tets around the three upper faces of its lower
  /// cube. The upper faces are those toward larger coordinates.
  static int number_of(Key tet) { return static_cast<int>(tet & 15U); }
  /// Return the index of the half that contains a position, among the 24 halves of the position's
  /// cube.
  static int half_of(const Vec3& position);

  /// Cut a triangle by the planes of all facets, and call piece(middle, lower, upper) for each
  /// piece. `middle` is a position in the piece; `lower` and `upper` are the corners of the piece's
  /// bounding box. A segment is passed as three positions, two of them equal. Pieces thinner than
  /// 1e-9 cubes are skipped.
  template <typename Piece>
  static void for_each_piece(const std::array<Vec3, 3>& positions, const Piece& piece)
  {
    Polygon input_polygon;
    for (const Vec3& position : positions)
    {
      input_polygon.add(position);
    }
    slice(input_polygon, 0, piece);
  }

private:
  struct Polygon
  {
    /// Maximum number of corners: 3 of the triangle, at most one more for each of 12 planes, and
    /// some for rounding.
    static constexpr int maximum_corners = 24;
    std::array<Vec3, maximum_corners> positions;
    int count = 0;
    void add(const Vec3& position)
    {
      if (this->count < maximum_corners)
      {
        this->positions[this->count++] = position;
      }
    }
  };
  static constexpr int directions = 6;
  static double coordinate_along(int direction, const Vec3& position)
  {
    const double x = position[direction / 2];
    const double y = position[(direction / 2 + 1) % 3];
    return direction % 2 ? x - y : x + y;
  }
  /// Clip the polygon to the region between the planes `lower` and `upper`.
  static void cut(const Polygon& polygon, int direction, double lower, double upper, Polygon& part);

  template <typename Piece>
  static void slice(const Polygon& polygon, int direction, const Piece& piece)
  {
    if (direction == directions)
    {
      Vec3 middle = Vec3::Zero();
      Vec3 lower = polygon.positions[0], upper = polygon.positions[0];
      for (int i = 0; i < polygon.count; ++i)
      {
        middle += polygon.positions[i] / polygon.count;
        lower = lower.cwiseMin(polygon.positions[i]);
        upper = upper.cwiseMax(polygon.positions[i]);
      }
      piece(middle, lower, upper);
      return;
    }
    double low = coordinate_along(direction, polygon.positions[0]);
    double high = low;
    for (int i = 1; i < polygon.count; ++i)
    {
      const double at = coordinate_along(direction, polygon.positions[i]);
      low = at < low ? at : low;
      high = at > high ? at : high;
    }
    constexpr double minimum_thickness = 1e-9;
    double from = std::floor(low + minimum_thickness);
    if (from + 1.0 >= high - minimum_thickness)
    {
      slice(polygon, direction + 1, piece);
      return;
    }
    for (; from < high - minimum_thickness; from += 1.0)
    {
      Polygon part;
      cut(polygon, direction, from, from + 1.0, part);
      if (part.count > 0)
      {
        slice(part, direction + 1, piece);
      }
    }
  }

  Vec3 origin_ = Vec3::Zero();
  double spacing_ = 1.0;
};

} // namespace bindpose

#endif
