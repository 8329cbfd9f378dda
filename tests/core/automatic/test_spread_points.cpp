// Spread points: handles that are far from each other and distributed over the components of a
// surface. They are on the surface or in the middle of the shape.
#include "automatic/spread_points.h"

#include "base/constants.h"

#include "support/meshes.h"
#include "surface/triangle_tree.h"
#include "winding/winding_number.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
SpreadPoints run_spread_points(
  const TriangleMesh& mesh, const SpreadPointsOptions& options, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  SpreadPoints result;
  const Status status = spread_points(context, mesh.points, mesh.triangles, options, result);
  EXPECT_TRUE(status.ok()) << status.message;
  return result;
}

Status failing_status(const TriangleMesh& mesh, const SpreadPointsOptions& options)
{
  ExecutionContext context;
  SpreadPoints result;
  return spread_points(context, mesh.points, mesh.triangles, options, result);
}

SpreadPointsOptions surface_options(Index count, PointDistance distance)
{
  SpreadPointsOptions options;
  options.count = count;
  options.distance = distance;
  options.inside = false;
  return options;
}

/// Return the distance along edges from a vertex to each vertex, by relaxing all edges until no
/// distance changes.
std::vector<double> along_edges(const TriangleMesh& mesh, Index from)
{
  std::vector<double> distance(static_cast<std::size_t>(mesh.points.rows()), infinite);
  distance[from] = 0.0;
  for (bool changed = true; changed;)
  {
    changed = false;
    for (const Edge& edge : mesh_edges(mesh.triangles))
    {
      const double length = (mesh.points.row(edge.a) - mesh.points.row(edge.b)).norm();
      for (const auto& [v, w] : { std::pair(edge.a, edge.b), std::pair(edge.b, edge.a) })
      {
        if (distance[v] + length < distance[w])
        {
          distance[w] = distance[v] + length;
          changed = true;
        }
      }
    }
  }
  return distance;
}

std::vector<double> straight(const TriangleMesh& mesh, Index from)
{
  std::vector<double> distance;
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    distance.push_back((mesh.points.row(v) - mesh.points.row(from)).norm());
  }
  return distance;
}

/// Return the closed surface of a plate: two unit squares at distance `thickness`, joined by a rim.
TriangleMesh plate_surface(double thickness)
{
  const TetMesh box = test::tet_box(10, 10, 1, Vec3::Zero(), Vec3(1.0, 1.0, thickness));
  return { box.points, boundary_triangles(box.tets) };
}

/// Return the surface of [0, 8] x [0, 1] x [0, 1].
TriangleMesh bar_surface()
{
  const TetMesh box = test::tet_box(32, 4, 4, Vec3::Zero(), Vec3(8.0, 1.0, 1.0));
  TriangleMesh mesh{ box.points, boundary_triangles(box.tets) };
  return mesh;
}
} // namespace

TEST(SpreadPoints, AreFartherFromEachOtherThanAnyVertexIsFromThem)
{
  const TriangleMesh mesh = test::torus(30, 12, 1.0, 0.3);
  for (const PointDistance metric : { PointDistance::along_edges, PointDistance::straight })
  {
    const SpreadPoints points = run_spread_points(mesh, surface_options(9, metric));
    ASSERT_EQ(points.vertices.size(), 9u);
    EXPECT_EQ(points.inside, 0);
    std::vector<double> nearest(static_cast<std::size_t>(mesh.points.rows()), infinite);
    double closest_pair = infinite;
    for (std::size_t i = 0; i < points.vertices.size(); ++i)
    {
      EXPECT_EQ(points.positions.row(static_cast<Index>(i)), mesh.points.row(points.vertices[i]));
      const std::vector<double> distance = metric == PointDistance::straight
        ? straight(mesh, points.vertices[i])
        : along_edges(mesh, points.vertices[i]);
      for (std::size_t j = 0; j < i; ++j)
      {
        closest_pair = std::min(closest_pair, distance[points.vertices[j]]);
      }
      for (std::size_t v = 0; v < nearest.size(); ++v)
      {
        nearest[v] = std::min(nearest[v], distance[v]);
      }
    }
    const double covering = *std::max_element(nearest.begin(), nearest.end());
    EXPECT_GE(closest_pair * (1.0 + 1e-12), covering);
    // For comparison with the limit 1.3: half of the torus's outer circle is 4.1 long.
    EXPECT_LT(covering, 1.3);
  }
}

TEST(SpreadPoints, FewerAreTheFirstOfMore)
{
  const TriangleMesh mesh = test::join(test::sphere(3), test::sphere(2, 0.5, Vec3(3.0, 0.0, 0.0)));
  const std::vector<Index> more =
    run_spread_points(mesh, surface_options(20, PointDistance::along_edges)).vertices;
  for (const Index count : { 1, 2, 5, 19 })
  {
    const std::vector<Index> fewer =
      run_spread_points(mesh, surface_options(count, PointDistance::along_edges)).vertices;
    EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), more.begin()));
  }
  EXPECT_EQ(std::set<Index>(more.begin(), more.end()).size(), 20u);
}

TEST(SpreadPoints, EveryComponentHasItsShare)
{
  // The mesh has four spheres. The first two are concentric and have almost equal radii, the third
  // has half the radius, and the fourth is tiny. The areas of the first three have the ratio
  // 4 : 4 : 1, and the numbers of their points have the same ratio. The tiny sphere gets no point.
  TriangleMesh mesh = test::join(test::sphere(2), test::sphere(3, 1.001)); // no vertices coincide
  mesh = test::join(mesh, test::sphere(2, 0.5, Vec3(9.0, 0.0, 0.0)));
  const Index crumb = mesh.points.rows();
  mesh = test::join(mesh, test::sphere(1, 0.01, Vec3(0.0, 9.0, 0.0)));
  for (const PointDistance metric : { PointDistance::along_edges, PointDistance::straight })
  {
    const SpreadPoints three = run_spread_points(mesh, surface_options(3, metric));
    EXPECT_EQ(three.components, 4);
    EXPECT_EQ(three.covered_components, 3);
    const SpreadPoints nine = run_spread_points(mesh, surface_options(9, metric));
    EXPECT_EQ(nine.covered_components, 3);
    Index counts[3] = { 0, 0, 0 };
    for (const Index v : nine.vertices)
    {
      ASSERT_LT(v, crumb);
      const Index first = test::sphere(2).points.rows();
      const Index second = first + test::sphere(3).points.rows();
      ++counts[v < first ? 0 : v < second ? 1 : 2];
    }
    EXPECT_THAT(counts, testing::ElementsAre(4, 4, 1));
  }
}

TEST(SpreadPoints, WeldEqualVertices)
{
  // Triangles with separate vertices at equal positions are connected, so distances along edges are
  // the same as for the welded mesh.
  const TriangleMesh mesh = test::sphere(2);
  const TriangleMesh loose = test::unwelded(mesh);
  const SpreadPoints a = run_spread_points(mesh, surface_options(12, PointDistance::along_edges));
  const SpreadPoints b = run_spread_points(loose, surface_options(12, PointDistance::along_edges));
  EXPECT_EQ(b.components, 1);
  std::set<std::array<double, 3>> different;
  for (Index i = 0; i < b.positions.rows(); ++i)
  {
    different.insert({ b.positions(i, 0), b.positions(i, 1), b.positions(i, 2) });
  }
  EXPECT_EQ(different.size(), 12u);
  EXPECT_EQ(a.positions.rows(), 12);
}

TEST(SpreadPoints, LieInTheMiddleOfTheShape)
{
  const TriangleMesh mesh = bar_surface();
  SpreadPointsOptions options;
  options.count = 6;
  const SpreadPoints points = run_spread_points(mesh, options);
  EXPECT_EQ(points.inside, 6);
  double least = infinite, most = -infinite;
  for (Index i = 0; i < 6; ++i)
  {
    // A point moves along its normal, so it stops near the axis but not exactly on the axis.
    EXPECT_NEAR(points.positions(i, 1), 0.5, 0.15) << i;
    EXPECT_NEAR(points.positions(i, 2), 0.5, 0.15) << i;
    least = std::min(least, points.positions(i, 0));
    most = std::max(most, points.positions(i, 0));
  }
  // The outermost points are less than 0.7 from the ends of the bar, which has the thickness 1.
  EXPECT_LT(least, 0.7);
  EXPECT_GT(most, 7.3);
}

TEST(SpreadPoints, StayInTheTips)
{
  // At the tips of a long ellipsoid the normal is parallel to the long axis. Points there must not
  // move along the whole axis.
  TriangleMesh mesh = test::sphere(4);
  mesh.points.col(0) *= 5.0;
  SpreadPointsOptions options;
  options.count = 2;
  const SpreadPoints points = run_spread_points(mesh, options);
  EXPECT_EQ(points.inside, 2);
  EXPECT_GT(std::abs(points.positions(0, 0)), 3.5);
  EXPECT_GT(std::abs(points.positions(1, 0)), 3.5);
  EXPECT_LT(points.positions(0, 0) * points.positions(1, 0), 0.0);
}

TEST(SpreadPoints, APlateIsNotServedOnBothSides)
{
  const TriangleMesh mesh = plate_surface(0.05);
  SpreadPointsOptions options;
  options.count = 9;
  const SpreadPoints points = run_spread_points(mesh, options);
  for (Index i = 0; i < 9; ++i)
  {
    for (Index j = 0; j < i; ++j)
    {
      EXPECT_GT((points.positions.row(i) - points.positions.row(j)).norm(), 0.15) << i << " " << j;
    }
  }
}

TEST(SpreadPoints, AreInsideWhicheverWayTrianglesTurn)
{
  const TriangleMesh mesh = bar_surface();
  SpreadPointsOptions options;
  options.count = 5;
  const SpreadPoints right = run_spread_points(mesh, options);
  // One end of the bar is open. The winding number still exceeds 0.5 in most of the inside.
  TriangleMesh open = mesh;
  open.triangles.conservativeResize(mesh.triangles.rows() - 8, 3);
  const SpreadPoints points = run_spread_points(open, options);
  const WindingNumber winding(open.points, open.triangles);
  EXPECT_GE(points.inside, 4);
  for (Index i = 0; i < right.positions.rows(); ++i)
  {
    EXPECT_GE(winding_number_direct(mesh.points, mesh.triangles, right.positions.row(i)), 0.5);
  }
  // A flat surface has no inside, so its points are not moved.
  const SpreadPoints flat = run_spread_points(test::grid(5, 5), options);
  EXPECT_EQ(flat.inside, 0);
  EXPECT_EQ(flat.vertices.size(), 5u);
}

TEST(SpreadPoints, DoNotDependOnThreads)
{
  SpreadPointsOptions options;
  options.count = 10;
  const TriangleMesh mesh = bar_surface();
  EXPECT_EQ(
    run_spread_points(mesh, options, 1).positions, run_spread_points(mesh, options, 2).positions);
}

TEST(SpreadPoints, BadInputIsOneSentence)
{
  TriangleMesh mesh = test::cube();
  const auto message = [](const Status& status)
  {
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    return status.message;
  };
  EXPECT_THAT(
    message(failing_status(mesh, surface_options(0, PointDistance::straight))), HasSubstr("not 0"));
  for (const PointDistance metric : { PointDistance::along_edges, PointDistance::straight })
  {
    EXPECT_EQ(run_spread_points(mesh, surface_options(8, metric)).vertices.size(), 8u);
    EXPECT_THAT(message(failing_status(mesh, surface_options(9, metric))),
      HasSubstr("only 8 distinct vertices"));
  }
  SpreadPointsOptions options;
  options.winding_threshold = 0.0;
  EXPECT_THAT(message(failing_status(mesh, options)), HasSubstr("winding_threshold"));
  mesh.points(3, 1) = std::nan("");
  EXPECT_THAT(message(failing_status(mesh, SpreadPointsOptions())), HasSubstr("finite"));
  EXPECT_THAT(message(failing_status(TriangleMesh(), SpreadPointsOptions())), HasSubstr("only 0"));
}

TEST(SpreadPoints, CanBeCanceled)
{
  ExecutionContext context;
  context.request_cancel();
  SpreadPoints result;
  const TriangleMesh mesh = test::sphere(3);
  EXPECT_EQ(spread_points(context, mesh.points, mesh.triangles, SpreadPointsOptions(), result).code,
    StatusCode::canceled);
}
