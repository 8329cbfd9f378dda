// Traversal of patches with consistent orientation (see oriented_patches.h).
#include "surface/oriented_patches.h"

#include "geometry/triangle_sides.h"

#include <array>
#include <utility>

namespace bindpose
{

namespace
{
struct Neighbor
{
  Index triangle = -1;
  bool agrees = true;
};

struct Neighbors
{
  std::array<Neighbor, 3> list;
  int count = 0;
};

std::vector<Neighbors> neighbors_of(TrianglesView triangles)
{
  std::vector<Neighbors> neighbors(static_cast<std::size_t>(triangles.rows()));
  const auto add = [&](Index to, const Neighbor& neighbor)
  { neighbors[to].list[neighbors[to].count++] = neighbor; };
  const std::vector<TriangleSide> sides = sides_by_edge(triangles);
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j)
  {
    j = end_of_edge(sides, i);
    if (j == i + 2)
    {
      const bool agrees = sides[i].forward != sides[i + 1].forward;
      add(sides[i].triangle, { sides[i + 1].triangle, agrees });
      add(sides[i + 1].triangle, { sides[i].triangle, agrees });
    }
  }
  return neighbors;
}
} // namespace

std::vector<OrientedPatch> oriented_patches(TrianglesView triangles)
{
  const std::vector<Neighbors> neighbors = neighbors_of(triangles);
  std::vector<signed char> flipped(neighbors.size(), -1); // -1: the triangle is not yet in a patch
  std::vector<OrientedPatch> patches;
  for (Index start = 0; start < triangles.rows(); ++start)
  {
    if (flipped[start] >= 0)
    {
      continue;
    }
    OrientedPatch patch;
    patch.triangles.assign(1, start);
    flipped[start] = 0;
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
    {
      const Index t = patch.triangles[i];
      patch.flipped.push_back(flipped[t]);
      for (int k = 0; k < neighbors[t].count; ++k)
      {
        const Neighbor& n = neighbors[t].list[k];
        const auto expected = static_cast<signed char>(n.agrees ? flipped[t] : 1 - flipped[t]);
        if (flipped[n.triangle] < 0)
        {
          flipped[n.triangle] = expected;
          patch.triangles.push_back(n.triangle);
        }
        patch.orientable = patch.orientable && flipped[n.triangle] == expected;
      }
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

} // namespace bindpose
