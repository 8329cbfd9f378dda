#include "base/triangle_sides.h"

#include <algorithm>
#include <tuple>

namespace bindpose
{

std::vector<TriangleSide> sides_by_edge(TrianglesView triangles)
{
  std::vector<TriangleSide> sides;
  sides.reserve(static_cast<std::size_t>(triangles.size()));
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Index from = triangles(t, k);
      const Index to = triangles(t, (k + 1) % 3);
      sides.push_back({ std::min(from, to), std::max(from, to), t, k, from < to });
    }
  }
  std::sort(sides.begin(), sides.end(),
    [](const TriangleSide& x, const TriangleSide& y) {
      return std::tie(x.a, x.b, x.triangle, x.corner) < std::tie(y.a, y.b, y.triangle, y.corner);
    });
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
