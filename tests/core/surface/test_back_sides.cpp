// If every triangle of a closed patch occurs in both orientations, all copies except one are back
// sides. The order of the triangles must not matter.
#include "surface/back_sides.h"

#include "surface/surface_repair.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace bindpose;

namespace
{
TriangleMesh welded(const TriangleMesh& mesh)
{
  ExecutionContext context;
  RepairOptions options;
  options.orient = false;
  RepairedSurface repaired;
  EXPECT_TRUE(repair_surface(context, mesh.points, mesh.triangles, options, repaired).ok());
  return { repaired.points, repaired.triangles };
}

double volume_without(const TriangleMesh& mesh, const std::vector<Index>& left_out)
{
  std::vector<Index> kept;
  for (Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    if (!std::binary_search(left_out.begin(), left_out.end(), t))
    {
      kept.push_back(t);
    }
  }
  const Triangles triangles = mesh.triangles(kept, Eigen::all);
  return signed_volume(mesh.points, triangles);
}

TriangleMesh shuffled(TriangleMesh mesh, unsigned seed)
{
  std::vector<Index> order(static_cast<std::size_t>(mesh.triangles.rows()));
  std::iota(order.begin(), order.end(), Index(0));
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  const Triangles triangles = mesh.triangles(order, Eigen::all);
  mesh.triangles = triangles;
  return mesh;
}
} // namespace

TEST(BackSides, AreTheInnerCopiesOfWhatEnclosesSomething)
{
  const TriangleMesh ball = test::sphere(2);
  const double volume = volume_without(ball, {});
  for (const unsigned seed : { 1U, 2U, 3U })
  {
    const TriangleMesh twice = shuffled(welded(test::join(ball, test::flipped(ball))), seed);
    const std::vector<Index> backs = back_sides(twice.points, twice.triangles);
    EXPECT_EQ(backs.size(), static_cast<std::size_t>(ball.triangles.rows()));
    EXPECT_NEAR(volume_without(twice, backs), volume, 1e-12);
    // Every triangle occurs twice in each orientation. Three of the four copies are back sides.
    const TriangleMesh four = shuffled(welded(test::join(twice, twice)), seed);
    const std::vector<Index> three = back_sides(four.points, four.triangles);
    EXPECT_EQ(three.size(), static_cast<std::size_t>(3 * ball.triangles.rows()));
    EXPECT_NEAR(volume_without(four, three), volume, 1e-12);
  }
}

TEST(BackSides, OfABoxWithoutALidAreFoundToo)
{
  const TriangleMesh open = test::open_cube(); // a sixth of the area is missing
  const TriangleMesh twice = welded(test::join(test::flipped(open), open));
  const std::vector<Index> backs = back_sides(twice.points, twice.triangles);
  EXPECT_EQ(backs.size(), static_cast<std::size_t>(open.triangles.rows()));
  EXPECT_NEAR(std::abs(volume_without(twice, backs)), std::abs(volume_without(open, {})), 1e-12);
}

TEST(BackSides, AreNotThereWhereNothingIsEnclosed)
{
  const TriangleMesh leaf = test::grid(4, 4);
  const TriangleMesh two_leaves = welded(test::join(leaf, test::flipped(leaf)));
  EXPECT_TRUE(back_sides(two_leaves.points, two_leaves.triangles).empty());
  // Triangles that occur once, or twice in the same orientation, have no back sides.
  const TriangleMesh ball = test::sphere(2);
  EXPECT_TRUE(back_sides(ball.points, ball.triangles).empty());
  const TriangleMesh same_way = welded(test::join(ball, ball));
  EXPECT_TRUE(back_sides(same_way.points, same_way.triangles).empty());
}

TEST(BackSides, AreFoundPatchByPatch)
{
  // The surface consists of a two-sided sphere, a two-sided flat grid, and a one-sided sphere. Only
  // the two-sided sphere has back sides.
  const TriangleMesh ball = test::sphere(2);
  const TriangleMesh leaf = test::translated(test::grid(4, 4), Vec3(5, 0, 0));
  TriangleMesh all =
    test::join(test::join(ball, test::flipped(ball)), test::join(leaf, test::flipped(leaf)));
  all = welded(test::join(all, test::translated(ball, Vec3(0, 9, 0))));
  EXPECT_EQ(
    back_sides(all.points, all.triangles).size(), static_cast<std::size_t>(ball.triangles.rows()));
}
