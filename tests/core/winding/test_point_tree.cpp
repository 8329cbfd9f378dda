// Search tree of points. The tree contains every point once, and its searches agree with brute
// force.
#include "winding/point_tree.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace bindpose;

namespace
{
/// Return random points. If they are on a lattice, many points and distances are equal.
Points tree_points(Index count, std::uint64_t seed, bool on_lattice)
{
  const Points points = test::random_points(count, 1.0, seed);
  return on_lattice ? Points((4.0 * points).array().round()) : points;
}
} // namespace

TEST(PointTree, HoldsEveryPointOnceInBoxesThatHoldThem)
{
  for (const Index count : { 1, 7, 8, 9, 16, 17, 255, 256, 257, 5000 })
  {
    const Points points = tree_points(count, 3, false);
    ExecutionContext context;
    PointTree tree;
    ASSERT_TRUE(tree.build(context, points, 16));
    const std::set<PointTree::Id> ids(tree.order().begin(), tree.order().end());
    EXPECT_EQ(static_cast<Index>(tree.order().size()), count);
    EXPECT_EQ(static_cast<Index>(ids.size()), count);
    Index in_leaves = 0;
    for (const PointTree::Group& group : tree.groups())
    {
      for (int c = 0; c < group.size; ++c)
      {
        const PointTree::Child& child = group.children[c];
        EXPECT_EQ(child.first % PointTree::width, 0);
        EXPECT_GT(child.count, 0);
        in_leaves += child.group < 0 ? child.count : 0;
        EXPECT_LE(child.group < 0 ? child.count : 0, 16);
        for (PointTree::Id i = child.first; i < child.first + child.count; ++i)
        {
          const Vec3 p = points.row(tree.order()[i]);
          EXPECT_TRUE((p.array() >= child.lower.array()).all());
          EXPECT_TRUE((p.array() <= child.upper.array()).all());
        }
      }
    }
    EXPECT_EQ(in_leaves, count);
  }
}

TEST(PointTree, NearestAreThoseOfASearchOfAll)
{
  for (const bool on_lattice : { false, true })
  {
    const Points points = tree_points(700, 5, on_lattice);
    ExecutionContext context;
    PointTree tree;
    ASSERT_TRUE(tree.build(context, points, 16));
    std::vector<PointTree::Neighbor> found;
    for (PointTree::Id point = 0; point < 700; point += 13)
    {
      std::vector<std::pair<double, PointTree::Id>> all;
      for (PointTree::Id other = 0; other < 700; ++other)
      {
        if (other != point)
        {
          all.emplace_back((points.row(other) - points.row(point)).squaredNorm(), other);
        }
      }
      std::sort(all.begin(), all.end());
      for (const Index count : { 1, 12, 699, 5000 })
      {
        tree.nearest(points, point, count, found);
        ASSERT_EQ(static_cast<Index>(found.size()), std::min<Index>(count, 699));
        for (std::size_t k = 0; k < found.size(); ++k)
        {
          ASSERT_EQ(found[k].point, all[k].second) << on_lattice;
          ASSERT_EQ(found[k].squared_distance, all[k].first);
        }
      }
    }
  }
}

TEST(PointTree, NoPointsAndCancel)
{
  ExecutionContext context;
  PointTree tree;
  EXPECT_TRUE(tree.build(context, Points(0, 3), 16));
  EXPECT_TRUE(tree.groups().empty());
  ExecutionContext stopped;
  stopped.request_cancel();
  EXPECT_FALSE(tree.build(stopped, tree_points(50000, 1, false), 16));
}
