// Caps are triangles that close an open surface along its boundary. smaller_caps() replaces the
// caps of a component by the component's reversed triangles if these are smaller.
#include "winding/boundary_caps.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
std::vector<Edge> open_edges(const Triangles& triangles)
{
  std::vector<Edge> open;
  for (const Edge& edge : mesh_edges(triangles))
  {
    if (edge.net_direction != 0)
    {
      open.push_back(edge);
    }
  }
  return open;
}

Triangles stacked(const Triangles& a, const Triangles& b)
{
  Triangles both(a.rows() + b.rows(), 3);
  both << a, b;
  return both;
}

/// Square the length of each triangle's longest edge. Return the sum of these squares.
double sum_of_longest_edges(const Points& points, const Triangles& triangles)
{
  double sum = 0.0;
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      longest = std::max(longest,
        (points.row(triangles(t, k)) - points.row(triangles(t, (k + 1) % 3))).squaredNorm());
    }
    sum += longest;
  }
  return sum;
}
} // namespace

TEST(BoundaryCaps, CloseAllOfSeveralParts)
{
  const TriangleMesh strip = test::grid(64, 1, 64.0, 1.0);
  const TriangleMesh hole = test::translated(test::open_cube(), Vec3(100, 0, 0));
  const TriangleMesh both = test::join(strip, hole);
  const Triangles caps = boundary_caps(open_edges(both.triangles));
  EXPECT_TRUE(open_edges(stacked(both.triangles, caps)).empty());
  EXPECT_EQ(caps.rows(), (130 - 2) + 2);

  // The reversed triangles of the long strip are smaller than its caps and replace them. The caps
  // of the open cube, which fill the missing face, are kept.
  const Triangles smaller = smaller_caps(both.points, both.triangles, caps);
  EXPECT_TRUE(open_edges(stacked(both.triangles, smaller)).empty());
  EXPECT_EQ(smaller.rows(), strip.triangles.rows() + 2);
  EXPECT_LT(
    sum_of_longest_edges(both.points, smaller), 0.1 * sum_of_longest_edges(both.points, caps));
  for (Index t = 2; t < smaller.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(smaller(t, k), strip.triangles(t - 2, 2 - k));
    }
  }
}

TEST(BoundaryCaps, OfAClosedSurfaceAreNone)
{
  const TriangleMesh sphere = test::sphere(2);
  const Triangles caps = boundary_caps(open_edges(sphere.triangles));
  EXPECT_EQ(caps.rows(), 0);
  EXPECT_EQ(smaller_caps(sphere.points, sphere.triangles, caps).rows(), 0);
}
