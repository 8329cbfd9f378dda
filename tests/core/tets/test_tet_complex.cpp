// A tet mesh that is edited in place: the stored neighbors equal those of a search of all tets, and
// the sign of the quality equals the exact orientation.
#include "tets/tet_complex.h"

#include "geometry/tet_facets.h"
#include "surface/triangle_predicates.h"

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

TEST(TetComplex, SignOfQualityIsTheExactOrientation)
{
  // Four points near one line, found on a model of a laptop. All normals are rounding errors.
  const Vec3 a(-5.1478699056915556, -1.3063412546580893, -12.391188381203319);
  const Vec3 b(-5.0585415922571144, -1.3053896598353134, -12.391457456963652);
  const Vec3 c(-4.9602727375294133, -1.3043428233978649, -12.391753463524015);
  const Vec3 d(-5.0030401579462414, -1.3047984152957461, -12.391624639014477);
  ASSERT_LT(orientation_3d(a, b, c, d), 0);
  EXPECT_LT(TetComplex::quality(a, b, c, d), 0.0);

  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  int negative = 0;
  for (int i = 0; i < 2000; ++i)
  {
    // The points are in a plane or on a line, up to rounding.
    const Vec3 p = vector(), u = vector(), v = i % 2 ? vector() : Vec3::Zero();
    const auto point = [&]() -> Vec3 { return p + uniform(random) * u + uniform(random) * v; };
    const Vec3 q = point(), r = point(), s = point();
    const double quality = TetComplex::quality(p, q, r, s);
    if (orientation_3d(p, q, r, s) <= 0)
    {
      EXPECT_LT(quality, 0.0);
      ++negative;
    }
    EXPECT_LE(quality, 0.9);
  }
  EXPECT_GT(negative, 500);
}
