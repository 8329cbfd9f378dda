#ifndef bindpose_tets_tet_complex_h
#define bindpose_tets_tet_complex_h

#include "geometry/mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace bindpose
{

/// A tet mesh that is edited in place. Each vertex stores its tets, and each tet its neighbors. The
/// ids of removed tets are not used again before compact(). Queries are thread-safe while no thread
/// edits the mesh. At most two tets may share a facet at any time: remove tets before adding
/// their replacements. The quality of a tet is the squared sine of its smallest dihedral angle (at
/// most 70.53 degrees).
class TetComplex
{
public:
  using Tet = std::array<Index, 4>;
  using Facet = std::array<Index, 3>;

  /// The tets around edge a-b and their other vertices, in order. The ring of a boundary edge is
  /// open and has one more vertex than tets.
  struct Ring
  {
    std::vector<Index> tets;
    std::vector<Index> vertices;
    bool closed = false;
  };

  static constexpr double removed_quality = 1e9; ///< quality of a removed tet
  /// Quality of a tet whose dihedral angles cannot be computed in doubles.
  static constexpr double least_quality = 1e-24;
  static constexpr std::size_t maximum_ring_size = 10; ///< maximum number of tets in a ring

  /// Take over points and tets. The tets must be positive and conforming: they intersect only in
  /// shared facets, edges and vertices.
  explicit TetComplex(TetMesh& mesh);
  /// Write the points, and the tets in the order in which they were added, to `mesh`.
  void write(TetMesh& mesh);

  Index vertex_count() const { return static_cast<Index>(this->points_.size()); }
  /// Return one more than the largest tet id.
  Index tet_id_limit() const { return static_cast<Index>(this->tets_.size()); }
  Index tet_count() const { return this->count_; }
  const Vec3& point(Index v) const { return this->points_[v]; }
  const Tet& tet(Index t) const { return this->tets_[t]; }
  bool alive(Index t) const { return this->quality_[t] < removed_quality; }
  const std::vector<Index>& tets_of_vertex(Index v) const { return this->vertex_tets_[v]; }
  bool on_boundary(Index v) const { return this->boundary_[v] != 0; }
  double quality(Index t) const { return this->quality_[t]; }
  /// Return the quality of a tet, or -1 if its volume is not positive, exactly or in doubles.
  static double quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
  double quality(const Tet& tet) const
  {
    return quality(
      this->points_[tet[0]], this->points_[tet[1]], this->points_[tet[2]], this->points_[tet[3]]);
  }
  /// Return the quality that tet t would have with its vertex v at p.
  double quality_with(Index t, Index v, const Vec3& p) const;
  static double quality_of_angle(double degrees);
  double volume(const Tet& tet) const;
  /// Return the value of changes() at the last change of a tet that uses the vertex.
  std::uint64_t stamp(Index v) const { return this->stamp_[v]; }
  /// Return a counter that increases with each change of the mesh. It equals the largest stamp of
  /// all vertices.
  std::uint64_t changes() const { return this->changes_; }

  Index add_vertex(const Vec3& p, bool on_boundary);
  void move(Index v, const Vec3& p);
  Index add(const Tet& tet);
  void remove(Index t);
  /// Renumber the tets as 0 to tet_count() - 1, in their order, and reserve memory for `ids` tets.
  /// @return the new id for each old id, -1 for removed tets.
  std::vector<Index> compact(Index ids);

  static bool has_vertex(const Tet& tet, Index v)
  {
    return tet[0] == v || tet[1] == v || tet[2] == v || tet[3] == v;
  }
  /// Return the index of the fourth corner of a tet with the vertices a, b and c.
  static int opposite_corner(const Tet& tet, Index a, Index b, Index c)
  {
    const auto found =
      std::find_if(tet.begin(), tet.end(), [&](Index v) { return v != a && v != b && v != c; });
    return static_cast<int>(found - tet.begin());
  }
  void find_edge_tets(Index a, Index b, std::vector<Index>& found) const;
  bool has_edge(Index a, Index b) const;
  /// Return the two vertices of tet t other than a and b, ordered so that (a, b, first, second) is
  /// positive.
  std::pair<Index, Index> opposite_edge(Index t, Index a, Index b) const;
  /// Find the ring of edge a-b. @return false if the tets of the edge do not form a single ring, or
  /// if there are more than maximum_ring_size of them.
  bool find_ring(Index a, Index b, Ring& ring) const;
  /// Return the tet on the other side of facet k (see facet_corners) of tet t, or -1 on the
  /// boundary.
  Index neighbor_tet(Index t, int k) const { return this->neighbors_[t][k]; }
  /// Return the tet on the other side of the facet of tet t that is opposite to vertex v, or -1 on
  /// the boundary.
  Index neighbor_across(Index t, Index v) const
  {
    const Tet& tet = this->tets_[t];
    return this->neighbors_[t][std::find(tet.begin(), tet.end(), v) - tet.begin()];
  }
  /// Return the boundary facets at vertex v, oriented outwards.
  std::vector<Facet> boundary_facets_at(Index v) const;

  /// Report whether a new vertex at p would split each of the tets at edge a-b into two tets of
  /// positive volume.
  bool may_split_edge(Index a, Index b, const std::vector<Index>& tets, const Vec3& p) const;
  /// Insert a new vertex into an edge, which splits every tet at the edge into two. @return the
  /// vertex. If a new tet would have no volume, return -1 and change nothing.
  Index split_edge(Index a, Index b, const Vec3& p);

private:
  void link_neighbors(Index t);
  void unlink_neighbors(Index t);

  std::vector<Vec3> points_;
  std::vector<Tet> tets_;
  std::vector<std::array<Index, 4>> neighbors_; ///< per tet: the neighbors at the four facets
  std::vector<double> quality_;
  std::vector<std::vector<Index>> vertex_tets_; ///< tet ids per vertex
  std::vector<char> boundary_; ///< per vertex: 1 on the boundary, else 0
  std::vector<std::uint64_t> stamp_;
  Index count_ = 0;
  std::uint64_t changes_ = 0;
};

} // namespace bindpose

#endif
