#ifndef bindpose_embedding_lattice_cover_h
#define bindpose_embedding_lattice_cover_h

#include "base/execution.h"
#include "embedding/disphenoid_lattice.h"
#include "geometry/mesh.h"
#include "surface/part_links.h"
#include "winding/winding_number.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace bindpose
{

/// A surface after welding equal points, otherwise unchanged. Each link (see PartLink) adds its
/// two end points and one degenerate triangle between them.
struct LatticeSurface
{
  using Id = std::int32_t;

  /// One end of a link.
  struct End
  {
    Id point, link; ///< ids of the point at this end and of the degenerate triangle of the link
    Id triangle; ///< id of the surface triangle on which this end lies
  };

  std::vector<Id> vertex_of_point; ///< #V: index in `points`; -1 for a point that no triangle uses
  std::vector<Vec3> points;
  std::vector<std::array<Id, 3>> triangles;
  std::vector<End> ends; ///< ends of the links

  /// @return false if canceled.
  bool build(ExecutionContext& context, PointsView all, TrianglesView faces,
    const std::vector<PartLink>& links);
};

/// The cover of a surface: the tets and cubes of a lattice that the surface passes through, and the
/// cubes that are completely inside.
class LatticeCover
{
public:
  using Key = DisphenoidLattice::Key;
  using Cube = DisphenoidLattice::Cube;
  using Id = LatticeSurface::Id;

  /// The part of a triangle in one tet.
  struct Piece
  {
    Key tet;
    Id triangle;
    Vec3 middle; ///< a position that is in the tet and on the triangle
  };
  enum class Kind : std::uint8_t
  {
    outside,
    inside, ///< the cube has no triangle, and the winding number in it is at least the threshold
    cut ///< the cube contains triangles, or an inside cube is adjacent to an outside cube here
  };
  static constexpr Index maximum_cubes = 4000000;
  /// Maximum number of cubes along the longest side.
  static constexpr Index largest_resolution = 1000;

  /// All arguments must outlive the cover.
  LatticeCover(
    const LatticeSurface& surface, const WindingNumber& winding, double threshold, const Box& box)
    : surface_(surface), winding_(winding), threshold_(threshold), box_(box)
  {
  }

  /// Choose the spacing and build the cover.
  /// @param resolution number of cubes along the longest side of the box. If 0, the number is
  /// chosen so that about `tets` tets result. The chosen number is at most 1000, and smaller if
  /// triangles would be cut into millions of pieces.
  /// @return invalid_input if the lattice would have more than maximum_cubes cubes. Cost: 1 us per
  /// piece of a triangle.
  Status choose(ExecutionContext& context, Index resolution, Index tets);
  Status build(ExecutionContext& context, double spacing);

  std::array<Vec3, 3> corners_of(Index triangle) const
  {
    const auto& t = this->surface_.triangles[triangle];
    return { this->positions[t[0]], this->positions[t[1]], this->positions[t[2]] };
  }
  /// Call body(tet) for the tets that the edge between two vertices passes through.
  template <typename Body>
  void tets_of_edge(Id a, Id b, const Body& body) const
  {
    const Vec3& p = this->positions[std::min(a, b)];
    const Vec3& q = this->positions[std::max(a, b)];
    DisphenoidLattice::for_each_piece({ p, q, q },
      [&](const Vec3& middle, const Vec3&, const Vec3&)
      { body(DisphenoidLattice::locate(middle).tet); });
  }

  static Status too_many_cubes();

  DisphenoidLattice lattice;
  std::vector<Vec3> positions; ///< #points: positions of the surface's points, in units of cubes
  std::vector<Key> tet_of_point;
  std::vector<Piece> pieces; ///< all pieces of triangles, sorted by triangle, then by tet
  std::vector<Index> first_piece; ///< #F + 1: offsets into `pieces`
  std::unordered_map<Key, Kind> kinds; ///< kinds of all cubes that are not outside

private:
  bool find_pieces(ExecutionContext& context);
  Status find_cubes(ExecutionContext& context);
  Kind kind_of(const Cube& cube) const;
  bool is_in_box(const Cube& cube) const;
  double count_tets() const;

  const LatticeSurface& surface_;
  const WindingNumber& winding_;
  double threshold_;
  Box box_;
  Cube first_cube_{}, last_cube_{}; ///< range of cubes that overlap the box
};

} // namespace bindpose

#endif
