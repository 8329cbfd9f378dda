// Sorted facets of a tet mesh. Facets are put into buckets by their smallest vertex id, about a
// dozen per bucket. Then each bucket is sorted.
#include "geometry/tet_facets.h"

#include <algorithm>

namespace bindpose
{

std::vector<TetFacet> tet_facets(TetsView tets)
{
  if (tets.rows() == 0)
  {
    return {};
  }
  std::vector<std::size_t> begin(static_cast<std::size_t>(tets.maxCoeff()) + 2, 0);
  for (Index t = 0; t < tets.rows(); ++t)
  {
    for (const auto& corners : facet_corners)
    {
      ++begin[std::min({ tets(t, corners[0]), tets(t, corners[1]), tets(t, corners[2]) }) + 1];
    }
  }
  for (std::size_t v = 1; v < begin.size(); ++v)
  {
    begin[v] += begin[v - 1];
  }
  std::vector<TetFacet> facets(static_cast<std::size_t>(tets.rows()) * 4);
  std::vector<std::size_t> next = begin;
  for (Index t = 0; t < tets.rows(); ++t)
  {
    for (int side = 0; side < 4; ++side)
    {
      const auto& corners = facet_corners[side];
      std::array<Index, 3> vertices{ tets(t, corners[0]), tets(t, corners[1]),
        tets(t, corners[2]) };
      std::sort(vertices.begin(), vertices.end());
      facets[next[vertices[0]]++] = { vertices, t, side };
    }
  }
  for (std::size_t v = 0; v + 1 < begin.size(); ++v)
  {
    std::sort(facets.begin() + static_cast<std::ptrdiff_t>(begin[v]),
      facets.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]),
      [](const TetFacet& x, const TetFacet& y)
      {
        // All facets of a bucket have the same first vertex.
        return x.vertices[1] != y.vertices[1] ? x.vertices[1] < y.vertices[1]
          : x.vertices[2] != y.vertices[2]    ? x.vertices[2] < y.vertices[2]
                                              : x.tet < y.tet;
      });
  }
  return facets;
}

} // namespace bindpose
