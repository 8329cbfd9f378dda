// Triangle sides (half-edges), grouped by edge. The result must equal that of sorting all sides.
#include "geometry/triangle_sides.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

using namespace bindpose;

namespace
{
auto key(const TriangleSide& side)
{
  return std::tie(side.a, side.b, side.triangle, side.corner);
}

void expect_all_sides_in_order(const Triangles& triangles)
{
  const std::vector<TriangleSide> sides = sides_by_edge(triangles);
  ASSERT_EQ(sides.size(), static_cast<std::size_t>(triangles.size()));
  EXPECT_TRUE(std::is_sorted(sides.begin(), sides.end(),
    [](const TriangleSide& x, const TriangleSide& y) { return key(x) < key(y); }));
  std::set<std::pair<Index, int>> seen;
  for (const TriangleSide& side : sides)
  {
    EXPECT_TRUE(seen.emplace(side.triangle, side.corner).second);
    const Index from = triangles(side.triangle, side.corner);
    const Index to = triangles(side.triangle, (side.corner + 1) % 3);
    EXPECT_EQ(side.a, std::min(from, to));
    EXPECT_EQ(side.b, std::max(from, to));
    EXPECT_EQ(side.forward, from < to);
  }
}
} // namespace

TEST(TriangleSides, OfAnEdgeAreNextToEachOther)
{
  const Triangles sphere = test::sphere(3).triangles;
  expect_all_sides_in_order(sphere);
  const std::vector<TriangleSide> sides = sides_by_edge(sphere);
  for (std::size_t begin = 0; begin < sides.size(); begin += 2)
  {
    EXPECT_EQ(end_of_edge(sides, begin), begin + 2);
    EXPECT_NE(sides[begin].forward, sides[begin + 1].forward);
  }
}

TEST(TriangleSides, OfAnySoup)
{
  test::Random random(4);
  for (int round = 0; round < 50; ++round)
  {
    // Many triangles use few vertices. Some edges therefore belong to many triangles, some
    // triangles are repeated, and some sides connect a vertex to itself.
    Triangles triangles(1 + round * 7, 3);
    for (Index k = 0; k < triangles.size(); ++k)
    {
      triangles.data()[k] = random.below(1 + round);
    }
    expect_all_sides_in_order(triangles);
  }
  expect_all_sides_in_order(Triangles(0, 3));
}
