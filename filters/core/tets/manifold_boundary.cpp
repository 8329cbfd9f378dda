// Separation of a tet mesh's boundary into a 2-manifold.
//
// The triangles of the boundary are the facets with one tet. From each edge of such a triangle, a
// walk through the tets around the edge ends at another boundary triangle. The two triangles are
// neighbors: they bound the same wedge of tets. At each end of the edge, both triangles have a
// corner. These two corners become one vertex.
#include "tets/manifold_boundary.h"

#include "base/disjoint_sets.h"
#include "geometry/tet_facets.h"

#include <algorithm>
#include <array>
#include <vector>

namespace bindpose
{

namespace
{
class FacetAdjacency
{
public:
  explicit FacetAdjacency(TetsView tets)
    : tets_(tets), opposite_facets_(static_cast<std::size_t>(4 * tets.rows()), -1)
  {
    const std::vector<TetFacet> facets = tet_facets(tets);
    for (std::size_t i = 1; i < facets.size(); ++i)
    {
      if (facets[i].vertices == facets[i - 1].vertices)
      {
        const Index first = facet_id(facets[i - 1]);
        const Index second = facet_id(facets[i]);
        this->opposite_facets_[first] = second;
        this->opposite_facets_[second] = first;
      }
    }
  }

  /// A facet between two tets has two ids, one for each tet. Return the other id of the facet, or
  /// -1 if the facet is on the boundary.
  Index opposite_facet(Index facet) const { return this->opposite_facets_[facet]; }

  std::array<Index, 3> corners(Index facet) const
  {
    const int* local_corners = facet_corners[facet % 4];
    const auto tet = this->tets_.row(facet / 4);
    return { tet[local_corners[0]], tet[local_corners[1]], tet[local_corners[2]] };
  }

  /// Return the facet that meets `facet` at the edge from a to b. Both facets belong to one tet.
  Index adjacent_facet(Index facet, Index a, Index b) const
  {
    const Index first = facet - facet % 4;
    for (Index k = first; k < first + 4; ++k)
    {
      const std::array<Index, 3> c = this->corners(k);
      if (k != facet && std::count(c.begin(), c.end(), a) && std::count(c.begin(), c.end(), b))
      {
        return k;
      }
    }
    return -1;
  }

  /// Return the neighbor of a boundary facet at the edge from a to b (see the top of this file).
  Index neighbor(Index facet, Index a, Index b) const
  {
    for (Index next = this->adjacent_facet(facet, a, b);;
         next = this->adjacent_facet(this->opposite_facet(next), a, b))
    {
      if (this->opposite_facet(next) < 0)
      {
        return next;
      }
    }
  }

private:
  static Index facet_id(const TetFacet& facet) { return 4 * facet.tet + facet.side; }

  TetsView tets_;
  std::vector<Index> opposite_facets_;
};

/// The triangles of the boundary with their neighbors across edges. Side 3 f + k is the side from
/// corner k of triangle f to the next corner.
struct BoundaryMesh
{
  /// Corners of the triangles, as ids of the tets' vertices.
  std::vector<std::array<Index, 3>> corners;
  std::vector<Index> opposite; ///< per side: the side of the neighboring triangle
};

BoundaryMesh skin_of(TetsView tets)
{
  const FacetAdjacency facets(tets);
  BoundaryMesh boundary_mesh;
  std::vector<Index> boundary;
  std::vector<Index> triangle_of(static_cast<std::size_t>(4 * tets.rows()), -1);
  for (Index facet = 0; facet < 4 * tets.rows(); ++facet)
  {
    if (facets.opposite_facet(facet) < 0)
    {
      triangle_of[facet] = static_cast<Index>(boundary.size());
      boundary.push_back(facet);
      boundary_mesh.corners.push_back(facets.corners(facet));
    }
  }
  for (std::size_t f = 0; f < boundary.size(); ++f)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index a = boundary_mesh.corners[f][k];
      const Index b = boundary_mesh.corners[f][(k + 1) % 3];
      const Index neighbor = triangle_of[facets.neighbor(boundary[f], a, b)];
      const std::array<Index, 3>& neighbor_corners = boundary_mesh.corners[neighbor];
      boundary_mesh.opposite.push_back(3 * neighbor +
        static_cast<Index>(std::find(neighbor_corners.begin(), neighbor_corners.end(), b) -
          neighbor_corners.begin()));
    }
  }
  return boundary_mesh;
}

Index next_side(Index side)
{
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// Find sides whose two vertices are also joined by a different edge. This happens if the solid
/// touches itself along an edge, but the triangles around each end of the edge form one fan. The
/// edge is then duplicated, but its ends are not.
std::vector<char> doubled_sides(const std::vector<Index>& vertex)
{
  std::vector<std::array<Index, 3>> sides;
  for (Index side = 0; side < static_cast<Index>(vertex.size()); ++side)
  {
    sides.push_back({ vertex[side], vertex[next_side(side)], side });
  }
  std::sort(sides.begin(), sides.end());
  std::vector<char> doubled(vertex.size(), 0);
  for (std::size_t i = 1; i < sides.size(); ++i)
  {
    if (sides[i][0] == sides[i - 1][0] && sides[i][1] == sides[i - 1][1])
    {
      doubled[sides[i][2]] = doubled[sides[i - 1][2]] = 1;
    }
  }
  return doubled;
}
} // namespace

TriangleMesh manifold_boundary(const TetMesh& tets)
{
  const BoundaryMesh boundary_mesh = skin_of(tets.tets);
  const auto count = static_cast<Index>(boundary_mesh.opposite.size());
  DisjointSets<Index> corners(boundary_mesh.opposite.size());
  for (Index side = 0; side < count; ++side)
  {
    corners.unite(side, next_side(boundary_mesh.opposite[side]));
    corners.unite(next_side(side), boundary_mesh.opposite[side]);
  }
  std::vector<Vec3> points;
  std::vector<Index> vertex(boundary_mesh.opposite.size(), -1); // output vertex at each corner
  for (Index corner = 0; corner < count; ++corner)
  {
    const Index first = corners.find(corner); // the first corner of the set already has a vertex
    if (first == corner)
    {
      vertex[corner] = static_cast<Index>(points.size());
      points.emplace_back(tets.points.row(boundary_mesh.corners[corner / 3][corner % 3]));
    }
    vertex[corner] = vertex[first];
  }
  // Two vertices must be joined by at most one edge, so each doubled edge is split at its midpoint.
  const std::vector<char> doubled = doubled_sides(vertex);
  std::vector<Index> middle(vertex.size(), -1);
  std::vector<std::array<Index, 3>> triangles;
  for (Index side = 0; side < count; ++side)
  {
    if (doubled[side] && middle[side] < 0)
    {
      middle[side] = middle[boundary_mesh.opposite[side]] = static_cast<Index>(points.size());
      points.push_back(0.5 * (points[vertex[side]] + points[vertex[next_side(side)]]));
    }
  }
  for (Index first = 0; first < count; first += 3)
  {
    // Vertices and midpoints around the triangle, starting at a midpoint if there is one.
    std::vector<Index> ring;
    for (Index side = first; side < first + 3; ++side)
    {
      ring.push_back(vertex[side]);
      if (middle[side] >= 0)
      {
        ring.push_back(middle[side]);
      }
    }
    const auto is_middle = [&](Index v)
    { return v == middle[first] || v == middle[first + 1] || v == middle[first + 2]; };
    std::rotate(ring.begin(),
      ring.size() > 3 ? std::find_if(ring.begin(), ring.end(), is_middle) : ring.begin(),
      ring.end());
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    {
      triangles.push_back({ ring[0], ring[i], ring[i + 1] });
    }
  }
  TriangleMesh surface;
  surface.points.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v)
  {
    surface.points.row(static_cast<Index>(v)) = points[v];
  }
  surface.triangles.resize(static_cast<Index>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
  {
    surface.triangles.row(static_cast<Index>(f)) << triangles[f][0], triangles[f][1],
      triangles[f][2];
  }
  return surface;
}

} // namespace bindpose
