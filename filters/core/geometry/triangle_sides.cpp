// Sides of triangles, sorted by edge. Sides are put into buckets by their lower vertex id, then
// each small bucket is sorted.
#include "geometry/triangle_sides.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace bindpose
{

std::vector<TriangleSide> sides_by_edge(TrianglesView triangles)
{
  const Index vertices = triangles.size() > 0 ? triangles.maxCoeff() + 1 : 0;
  std::vector<std::size_t> next(static_cast<std::size_t>(vertices) + 1, 0);
  const auto for_each = [triangles](const auto& side)
  {
    for (Index t = 0; t < triangles.rows(); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Index from = triangles(t, k);
        const Index to = triangles(t, (k + 1) % 3);
        side(TriangleSide{ std::min(from, to), std::max(from, to), t, k, from < to });
      }
    }
  };
  for_each([&](const TriangleSide& side) { ++next[static_cast<std::size_t>(side.a) + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<TriangleSide> sides(static_cast<std::size_t>(triangles.size()));
  for_each(
    [&](const TriangleSide& side) { sides[next[static_cast<std::size_t>(side.a)]++] = side; });
  // next[v] is now the index after the last side of vertex v.
  std::size_t begin = 0;
  for (Index v = 0; v < vertices; ++v)
  {
    const std::size_t end = next[static_cast<std::size_t>(v)];
    std::sort(sides.begin() + static_cast<std::ptrdiff_t>(begin),
      sides.begin() + static_cast<std::ptrdiff_t>(end),
      [](const TriangleSide& x, const TriangleSide& y)
      { return std::tie(x.b, x.triangle, x.corner) < std::tie(y.b, y.triangle, y.corner); });
    begin = end;
  }
  return sides;
}

std::size_t end_of_edge(const std::vector<TriangleSide>& sides, std::size_t begin)
{
  std::size_t end = begin + 1;
  while (end < sides.size() && sides[end].same_edge(sides[begin]))
  {
    ++end;
  }
  return end;
}

} // namespace bindpose
