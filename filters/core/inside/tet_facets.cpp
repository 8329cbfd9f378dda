#include "inside/tet_facets.h"

#include <algorithm>

namespace bindpose
{

std::vector<TetFacet> tet_facets(TetsView tets)
{
  std::vector<TetFacet> facets;
  facets.reserve(static_cast<std::size_t>(tets.rows()) * 4);
  for (Index t = 0; t < tets.rows(); ++t)
  {
    for (int skip = 0; skip < 4; ++skip)
    {
      std::array<Index, 3> key{ tets(t, (skip + 1) % 4), tets(t, (skip + 2) % 4),
        tets(t, (skip + 3) % 4) };
      std::sort(key.begin(), key.end());
      facets.push_back({ key, t });
    }
  }
  std::sort(facets.begin(), facets.end(),
    [](const TetFacet& x, const TetFacet& y)
    { return x.vertices != y.vertices ? x.vertices < y.vertices : x.tet < y.tet; });
  return facets;
}

} // namespace bindpose
