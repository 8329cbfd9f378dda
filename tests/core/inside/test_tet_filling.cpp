// Vertices inside of tets: how many, where, and what stays as it is.
#include "inside/tet_filling.h"

#include "inside/tet_quality.h"
#include "inside/tetrahedralize.h"

#include "core/inside/tet_outcome.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;
using test::Cdt;
using test::expect_valid;
using test::run;
using Outcome = test::TetOutcome;

namespace
{
SizingField everywhere(double length)
{
  return SizingField(Points(0, 3), Eigen::VectorXd(0), 0.5, length);
}

/// Smallest distance of two vertices of which one is at least `first`.
double smallest_distance(const Points& points, Index first)
{
  double smallest = 1e9;
  for (Index v = first; v < points.rows(); ++v)
  {
    for (Index w = 0; w < v; ++w)
    {
      smallest = std::min(smallest, (points.row(v) - points.row(w)).norm());
    }
  }
  return smallest;
}
/// Fills the mesh for edges of `length`; it stays a mesh.
Filling fill(TetMesh& mesh, double length, const FillOptions& options)
{
  Filling done;
  ExecutionContext context;
  EXPECT_TRUE(fill_tets(mesh, everywhere(length), options, done, context));
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  return done;
}
} // namespace

TEST(TetFilling, AddsVerticesOfTheWantedDistance)
{
  TetMesh mesh = test::tet_box(1, 1, 1);
  const Points before = mesh.points;
  FillOptions options;
  options.longest_boundary_edge = 0.3;
  const Filling done = fill(mesh, 0.2, options);
  EXPECT_NEAR(tet_volumes(mesh.points, mesh.tets).sum(), 1.0, 1e-12);
  EXPECT_NEAR(surface_area(mesh.points, boundary_triangles(mesh.tets)), 6.0, 1e-12);
  EXPECT_EQ(mesh.points.topRows(8), before);
  EXPECT_GT(done.inner_vertices, 20);
  EXPECT_GT(done.boundary_vertices, 50);
  EXPECT_EQ(mesh.points.rows(), 8 + done.inner_vertices + done.boundary_vertices);
  // Regular tets of this size would be 1 / (0.118 * 0.2^3), about 1,060.
  EXPECT_GT(mesh.tets.rows(), 500);
  EXPECT_LT(mesh.tets.rows(), 4000);
  EXPECT_GT(smallest_distance(mesh.points, 8), 0.05);
}

TEST(TetFilling, EndsAtTheNumberOfTets)
{
  TetMesh mesh = test::tet_box(2, 2, 2);
  FillOptions options;
  options.most_tets = 500;
  fill(mesh, 0.01, options);
  EXPECT_GE(mesh.tets.rows(), 500);
  EXPECT_LT(mesh.tets.rows(), 700);
}

TEST(TetFilling, RequiredPointsBecomeVertices)
{
  TetMesh mesh = test::tet_box(1, 1, 1);
  FillOptions options;
  options.most_tets = 0;
  options.required.resize(4, 3);
  // In general position, on the cube's diagonal, on the box's boundary, and outside.
  options.required << 0.3, 0.41, 0.2, 0.5, 0.5, 0.5, 0.0, 0.31, 0.4, 1.5, 0.5, 0.5;
  const Filling done = fill(mesh, 1.0, options);
  ASSERT_EQ(done.required.size(), 4u);
  for (const int i : { 0, 1 })
  {
    ASSERT_GE(done.required[i], 8);
    EXPECT_EQ(mesh.points.row(done.required[i]), options.required.row(i));
  }
  EXPECT_EQ(done.required[2], -1);
  EXPECT_EQ(done.required[3], -1);
  EXPECT_EQ(mesh.points.rows(), 10);
  EXPECT_EQ(boundary_triangles(mesh.tets).rows(), 12);
}

TEST_F(Cdt, NumbersOfTetsGrowWithTheSurfaceNotWithTheVolume)
{
  for (const int level : { 3, 4 })
  {
    SCOPED_TRACE(level);
    const TriangleMesh sphere = test::sphere(level);
    const Outcome outcome = run(sphere, TetMethod::cdt);
    expect_valid(outcome, sphere);
    EXPECT_LT(outcome.result.mesh.tets.rows(), 6 * sphere.triangles.rows());
    EXPECT_GT(outcome.result.mesh.points.rows(), 1.05 * sphere.points.rows()) << "vertices inside";
    EXPECT_EQ(outcome.number("counts.tets_below_5_degrees"), 0);
  }
}

TEST_F(Cdt, AFewTrianglesAreFilledWithManyTets)
{
  const Outcome outcome = run(test::cube(), TetMethod::cdt);
  expect_valid(outcome, test::cube());
  EXPECT_GT(outcome.result.mesh.tets.rows(), 700);
  EXPECT_LT(outcome.result.mesh.tets.rows(), 3000);
  EXPECT_NEAR(outcome.volume(), 8.0, 1e-12);
  EXPECT_NEAR(
    surface_area(outcome.result.mesh.points, boundary_triangles(outcome.result.mesh.tets)), 24.0,
    1e-9);
  EXPECT_GE(outcome.number("min_dihedral_angle"), 5.0);
}

TEST_F(Cdt, TetsForcedByNeedlesAreCounted)
{
  // Boxes of 12 triangles. One of 100 x 1 x 1 has sides with corners of 0.57 degrees.
  TetrahedralizeOptions bare;
  bare.method = TetMethod::cdt;
  bare.quality = 0.0;
  TriangleMesh bar = test::cube(0.0, 1.0);
  bar.points.col(0) *= 100.0;
  const Outcome forced = run(bar, bare);
  expect_valid(forced, bar);
  EXPECT_GT(forced.number("counts.tets_below_5_degrees"), 0);
  EXPECT_EQ(forced.number("counts.tets_below_5_degrees_forced"),
    forced.number("counts.tets_below_5_degrees"));
  const Outcome free = run(test::cube(), bare);
  expect_valid(free, test::cube());
  EXPECT_EQ(free.number("counts.tets_below_5_degrees_forced"), 0);
}
