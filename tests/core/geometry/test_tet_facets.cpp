// Facets of tets: tet_facets() sorts the facets by their three vertices, and facet_corners lists
// the corners so that the normals of facets point outwards.
#include "geometry/tet_facets.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

using namespace bindpose;

TEST(TetFacets, EveryFacetOfEveryTetIsThereInOrder)
{
  const TetMesh box = test::tet_box(3, 4, 5);
  // Compute the reference with a map from the sorted vertices of a facet to its tets.
  std::map<std::array<Index, 3>, std::vector<Index>> expected;
  for (Index t = 0; t < box.tets.rows(); ++t)
  {
    for (int skip = 0; skip < 4; ++skip)
    {
      std::array<Index, 3> key{ box.tets(t, (skip + 1) % 4), box.tets(t, (skip + 2) % 4),
        box.tets(t, (skip + 3) % 4) };
      std::sort(key.begin(), key.end());
      expected[key].push_back(t);
    }
  }
  const std::vector<TetFacet> facets = tet_facets(box.tets);
  ASSERT_EQ(facets.size(), 4u * static_cast<std::size_t>(box.tets.rows()));
  std::size_t i = 0;
  for (const auto& [vertices, tets] : expected)
  {
    for (const Index t : tets)
    {
      ASSERT_EQ(facets[i].vertices, vertices);
      ASSERT_EQ(facets[i].tet, t);
      const Index apex = box.tets(t, facets[i].side);
      ASSERT_EQ(std::count(vertices.begin(), vertices.end(), apex), 0);
      ++i;
    }
  }
  EXPECT_TRUE(tet_facets(Tets(0, 4)).empty());
}

TEST(TetFacets, SidesPointOutwards)
{
  const TetMesh box = test::tet_box(1, 1, 1);
  for (Index t = 0; t < box.tets.rows(); ++t)
  {
    for (int side = 0; side < 4; ++side)
    {
      const auto& corner = facet_corners[side];
      const Vec3 a = box.points.row(box.tets(t, corner[0]));
      const Vec3 b = box.points.row(box.tets(t, corner[1]));
      const Vec3 c = box.points.row(box.tets(t, corner[2]));
      const Vec3 apex = box.points.row(box.tets(t, side));
      EXPECT_LT((b - a).cross(c - a).dot(apex - a), 0.0);
    }
  }
}
