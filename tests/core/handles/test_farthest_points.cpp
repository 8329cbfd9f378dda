// Farthest-point sampling: comparisons with the definition, and meshes with too few points.
#include "handles/farthest_points.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

using namespace bindpose;

TEST(FarthestPoints, EachIsTheFarthestFromAllBefore)
{
  const TriangleMesh mesh = test::join(test::sphere(3), test::cube(2.0, 3.0));
  ExecutionContext context;
  std::vector<Index> chosen;
  ASSERT_TRUE(farthest_points(context, mesh.points, mesh.triangles, 20, chosen).ok());
  ASSERT_EQ(chosen.size(), 20u);
  const auto distance_to_first = [&](Index v, std::size_t count)
  {
    double nearest = 1e300;
    for (std::size_t k = 0; k < count; ++k)
    {
      nearest = std::min(nearest, (mesh.points.row(v) - mesh.points.row(chosen[k])).norm());
    }
    return nearest;
  };
  for (std::size_t k = 1; k < chosen.size(); ++k)
  {
    const double own = distance_to_first(chosen[k], k);
    for (Index v = 0; v < mesh.points.rows(); ++v)
    {
      EXPECT_LE(distance_to_first(v, k), own + 1e-12);
    }
  }
  std::vector<Index> fewer;
  ASSERT_TRUE(farthest_points(context, mesh.points, mesh.triangles, 5, fewer).ok());
  EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), chosen.begin()));
}

TEST(FarthestPoints, BoxCornersComeFirst)
{
  const TriangleMesh mesh = test::cube();
  ExecutionContext context;
  std::vector<Index> chosen;
  ASSERT_TRUE(farthest_points(context, mesh.points, mesh.triangles, 8, chosen).ok());
  EXPECT_EQ(chosen[0], 0); // the smallest id of eight equally distant corners
  EXPECT_EQ(chosen[1], 7); // corner 7 is opposite corner 0
  std::sort(chosen.begin(), chosen.end());
  EXPECT_EQ(chosen, (std::vector<Index>{ 0, 1, 2, 3, 4, 5, 6, 7 }));
}

TEST(FarthestPoints, TooFewPlacesAndCancel)
{
  TriangleMesh mesh = test::cube();
  mesh.points.conservativeResize(9, 3);
  mesh.points.row(8) << 100, 100, 100; // no triangle uses this vertex
  ExecutionContext context;
  std::vector<Index> chosen;
  const Status few = farthest_points(context, mesh.points, mesh.triangles, 9, chosen);
  EXPECT_EQ(few.code, StatusCode::invalid_input);
  EXPECT_NE(few.message.find("only 8"), std::string::npos);
  EXPECT_EQ(farthest_points(context, mesh.points, mesh.triangles, 0, chosen).code,
    StatusCode::invalid_input);
  EXPECT_EQ(farthest_points(context, mesh.points, Triangles(0, 3), 1, chosen).code,
    StatusCode::invalid_input);
  context.request_cancel();
  EXPECT_EQ(
    farthest_points(context, mesh.points, mesh.triangles, 8, chosen).code, StatusCode::canceled);
}
