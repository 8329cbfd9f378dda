#ifndef bindpose_geometry_tet_facets_h
#define bindpose_geometry_tet_facets_h

// Sorted facets of a tet mesh.

#include "base/mesh_types.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Corners of the four facets of a positive tet, ordered so that normals point outwards. Facet k is
/// opposite to corner k.
constexpr int facet_corners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };

/// A facet of a tet, identified by its vertex ids in ascending order.
struct TetFacet
{
  std::array<Index, 3> vertices;
  Index tet;
  int side; ///< index of the facet in facet_corners
};

/// Return the 4 #T facets, sorted by vertices, then by tet. A facet between two tets has two
/// entries, which are adjacent in this order. Ids must be in range of the points. Cost: 0.1 us per
/// facet.
std::vector<TetFacet> tet_facets(TetsView tets);

} // namespace bindpose

#endif
