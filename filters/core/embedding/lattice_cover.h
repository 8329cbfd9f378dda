#ifndef bindpose_embedding_lattice_cover_h
#define bindpose_embedding_lattice_cover_h

#include "base/execution.h"
#include "base/mesh.h"
#include "embedding/disphenoid_lattice.h"
#include "surface/part_links.h"
#include "winding/winding_number.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace bindpose
{

/// A surface with equal points welded; whatever else it has stays. Each link is one more triangle,
/// without area, and its ends are two more points.
struct LatticeSurface
{
  using Id = std::int32_t;

  /// A link's end.
  struct End
  {
    Id point, link; ///< the link's triangle
    Id triangle; ///< that holds the end
  };

  std::vector<Id> of_point; ///< #V: id in `points`, -1 for a point that no triangle uses
  std::vector<Vec3> points;
  std::vector<std::array<Id, 3>> triangles;
  std::vector<End> ends; ///< of the links

  /// @return false when cancelled.
  bool build(PointsView all, TrianglesView faces, const std::vector<PartLink>& links,
    ExecutionContext& context);
};

/// Which tets and cubes of a lattice a surface goes through, and which cubes it encloses.
class LatticeCover
{
public:
  using Key = DisphenoidLattice::Key;
  using Cube = DisphenoidLattice::Cube;
  using Id = LatticeSurface::Id;

  /// A triangle in a tet.
  struct Piece
  {
    Key tet;
    Id triangle;
    Vec3 middle; ///< a place of both
  };
  enum class Kind : std::uint8_t
  {
    outside,
    inside, ///< no triangle in it, and w >= threshold
    cut ///< by triangles, or the inside ends in it
  };
  static constexpr Index most_cubes = 4000000;
  static constexpr Index largest_resolution = 1000; ///< cubes along the longest side

  /// All three must outlive the cover.
  LatticeCover(
    const LatticeSurface& surface, const WindingNumber& winding, double threshold, const Box& box)
    : surface_(surface), winding_(winding), threshold_(threshold), box_(box)
  {
  }

  /// `resolution` cubes along the longest side of the box; 0: as many as give about `tets` tets,
  /// but not more than 1000, and fewer where triangles would fall into millions of pieces.
  /// invalid_input: more than most_cubes. Cost: 1 us per piece.
  Status choose(Index resolution, Index tets, ExecutionContext& context);
  Status build(double spacing, ExecutionContext& context);

  std::array<Vec3, 3> corners_of(Index triangle) const
  {
    const auto& t = this->surface_.triangles[triangle];
    return { this->places[t[0]], this->places[t[1]], this->places[t[2]] };
  }
  /// Calls body(tet) for the tets that the edge between two vertices goes through.
  template <typename Body>
  void tets_of_edge(Id a, Id b, const Body& body) const
  {
    const Vec3& p = this->places[std::min(a, b)];
    const Vec3& q = this->places[std::max(a, b)];
    DisphenoidLattice::for_pieces({ p, q, q },
      [&](const Vec3& middle, const Vec3&, const Vec3&)
      { body(DisphenoidLattice::locate(middle).tet); });
  }

  static Status too_many_cubes();

  DisphenoidLattice lattice;
  std::vector<Vec3> places; ///< of the vertices, in cubes
  std::vector<Key> tet_of_point;
  std::vector<Piece> pieces; ///< by triangle, then tet
  std::vector<Index> first_piece; ///< #F + 1
  std::unordered_map<Key, Kind> kinds; ///< of the cubes that are not outside

private:
  bool find_pieces(ExecutionContext& context);
  Status find_cubes(ExecutionContext& context);
  Kind kind_of(const Cube& cube) const;
  bool in_box(const Cube& cube) const;
  double count_tets() const;

  const LatticeSurface& surface_;
  const WindingNumber& winding_;
  double threshold_;
  Box box_;
  Cube first_cube_{}, last_cube_{}; ///< of the box
};

} // namespace bindpose

#endif
