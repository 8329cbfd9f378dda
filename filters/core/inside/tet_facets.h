#ifndef bindpose_inside_tet_facets_h
#define bindpose_inside_tet_facets_h

#include "base/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// A tet's side, named by its vertices in ascending order.
struct TetFacet
{
  std::array<Index, 3> vertices;
  Index tet;
};

/// The 4 #T facets, sorted by vertices, then tet: those of two neighbours stand side by side.
std::vector<TetFacet> tet_facets(TetsView tets);

} // namespace bindpose

#endif
