// Closed surfaces around shapes with parts that are thinner than a lattice cube.
#include "inside/thick_solid.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
struct SolidOutcome
{
  TriangleMesh solid;
  Status status;
  Index parts = 0;
  double volume = 0.0;
};

SolidOutcome make_solid(const TriangleMesh& mesh, const ThickSolidOptions& options, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  const WindingNumber winding(mesh.points, mesh.triangles);
  SolidOutcome outcome;
  outcome.status =
    thick_solid(context, mesh.points, mesh.triangles, winding, options, outcome.solid);
  EXPECT_TRUE(outcome.status.ok()) << outcome.status.message;
  EXPECT_TRUE(count_edges(outcome.solid.triangles).closed);
  outcome.parts = connected_components(outcome.solid.points.rows(), outcome.solid.triangles).count;
  outcome.volume = signed_volume(outcome.solid.points, outcome.solid.triangles);
  return outcome;
}

/// Return the size of a lattice cube of the solid. `longest` is the longest side of the mesh's
/// bounding box.
double cube_size(const SolidOutcome& outcome, double longest)
{
  return longest / outcome.status.report.number("resolution", 0.0);
}
} // namespace

TEST(ThickSolid, OfABallIsABallWithTheWantedTriangles)
{
  const TriangleMesh ball = test::sphere(4);
  const SolidOutcome outcome = make_solid(ball, {});
  EXPECT_EQ(outcome.parts, 1);
  EXPECT_LT(outcome.status.report.number("counts.thickened_triangles", 1e9),
    0.01 * static_cast<double>(ball.triangles.rows()));
  EXPECT_NEAR(outcome.volume / signed_volume(ball.points, ball.triangles), 1.0, 0.01);
  EXPECT_NEAR(static_cast<double>(outcome.solid.triangles.rows()), 20000.0, 2000.0);
}

TEST(ThickSolid, ASheetBecomesAPlateOfTwiceTheLayer)
{
  const TriangleMesh sheet = test::grid(10, 10);
  const SolidOutcome outcome = make_solid(sheet, {});
  EXPECT_EQ(outcome.parts, 1);
  const double layer = 0.6 * cube_size(outcome, 1.0);
  // The solid should be a plate with a half cylinder at each of its four edges, and a quarter of a
  // ball at each corner.
  const double pi = std::acos(-1.0);
  const double expected =
    2.0 * layer + 2.0 * pi * layer * layer + 4.0 / 3.0 * pi * layer * layer * layer;
  EXPECT_NEAR(outcome.volume / expected, 1.0, 0.1);
}

TEST(ThickSolid, ThinWallsStay)
{
  // The two large faces of the plate have a distance of a hundredth of a lattice cube.
  const TriangleMesh plate = test::box(Vec3(0.0, 0.0, 0.0), Vec3(1.0, 1.0, 1e-4));
  const SolidOutcome outcome = make_solid(plate, {});
  EXPECT_EQ(outcome.parts, 1);
  EXPECT_GT(outcome.volume, cube_size(outcome, 1.0));
}

TEST(ThickSolid, NarrowGapsCloseWherePartsAreJoinedOnly)
{
  ThickSolidOptions options;
  options.triangles = 4000;
  const TriangleMesh left = test::cube(0.0, 1.0);
  const auto both = [&](double gap)
  { return test::join(left, test::translated(left, Vec3(1.0 + gap, 0.0, 0.0))); };
  const double cube = cube_size(make_solid(both(0.05), options), 2.05);
  const TriangleMesh apart = both(0.9 * cube);
  options.join_near_parts = true;
  EXPECT_EQ(make_solid(apart, options).parts, 1);
  EXPECT_EQ(make_solid(both(2.6 * cube), options).parts, 2);
  options.join_near_parts = false;
  EXPECT_EQ(make_solid(both(1.8 * cube), options).parts, 2);
}

TEST(ThickSolid, AnOpenCubeIsFilled)
{
  const SolidOutcome outcome = make_solid(test::open_cube(), {});
  EXPECT_EQ(outcome.parts, 1);
  // Next to the opening, the walls are thickened by a layer of 0.6 lattice cubes.
  EXPECT_NEAR(outcome.volume, 8.0, 0.8);
}

TEST(ThickSolid, SameBitsForAnyNumberOfThreads)
{
  ThickSolidOptions options;
  options.triangles = 3000;
  options.join_near_parts = true;
  const TriangleMesh mesh = test::join(test::torus(24, 12, 1.0, 0.4), test::grid(3, 3));
  const SolidOutcome serial = make_solid(mesh, options, 1);
  const SolidOutcome parallel = make_solid(mesh, options, 4);
  EXPECT_EQ(serial.solid.points, parallel.solid.points);
  EXPECT_EQ(serial.solid.triangles, parallel.solid.triangles);
}

TEST(ThickSolid, CancelEndsSoon)
{
  const TriangleMesh mesh = test::sphere(4);
  const WindingNumber winding(mesh.points, mesh.triangles);
  ExecutionContext context;
  context.request_cancel();
  TriangleMesh solid;
  EXPECT_EQ(thick_solid(context, mesh.points, mesh.triangles, winding, {}, solid).code,
    StatusCode::canceled);
}
