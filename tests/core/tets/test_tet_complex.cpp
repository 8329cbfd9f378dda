// A tet mesh that is edited in place: its neighbors are those that a search of all tets finds.
#include "tets/tet_complex.h"

#include "geometry/tet_facets.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <random>

using namespace bindpose;

namespace
{
/// Return the tet that shares facet k of tet t, by a search of all tets, or -1.
Index searched_neighbor(const TetComplex& tets, Index t, int k)
{
  for (Index other = 0; other < tets.tet_id_limit(); ++other)
  {
    int shared = 0;
    for (const int corner : facet_corners[k])
    {
      shared += TetComplex::has_vertex(tets.tet(other), tets.tet(t)[corner]) ? 1 : 0;
    }
    if (tets.alive(other) && other != t && shared == 3)
    {
      return other;
    }
  }
  return -1;
}

void expect_searched_neighbors(const TetComplex& tets)
{
  for (Index t = 0; t < tets.tet_id_limit(); ++t)
  {
    for (int k = 0; k < 4 && tets.alive(t); ++k)
    {
      const Index neighbor = searched_neighbor(tets, t, k);
      EXPECT_EQ(tets.neighbor_tet(t, k), neighbor) << "tet " << t << ", facet " << k;
      EXPECT_EQ(tets.neighbor_across(t, tets.tet(t)[k]), neighbor);
    }
  }
}
} // namespace

TEST(TetComplex, NeighborsAreKeptThroughEdits)
{
  TetMesh mesh = test::tet_box(2, 2, 2);
  TetComplex tets(mesh);
  expect_searched_neighbors(tets);
  std::mt19937 random(7);
  const auto random_tet = [&]
  {
    Index t = -1;
    while (t < 0 || !tets.alive(t))
    {
      t = std::uniform_int_distribution<Index>(0, tets.tet_id_limit() - 1)(random);
    }
    return t;
  };
  for (int edit = 0; edit < 40; ++edit)
  {
    const TetComplex::Tet tet = tets.tet(random_tet());
    EXPECT_GE(tets.split_edge(tet[0], tet[1], 0.5 * (tets.point(tet[0]) + tets.point(tet[1]))), 0);
    if (edit % 4 == 0)
    {
      tets.remove(random_tet());
    }
    if (edit % 10 == 9)
    {
      tets.compact(2 * tets.tet_count());
    }
  }
  expect_searched_neighbors(tets);
}
