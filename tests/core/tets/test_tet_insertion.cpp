// Insertion of vertices into tets: the new vertices exist, and the rest of the mesh does not
// change.
#include "tets/tet_insertion.h"

#include "inside/tetrahedralize.h"
#include "tets/tet_quality.h"

#include "core/inside/tet_outcome.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace bindpose;
using test::Cdt;
using test::expect_valid;
using test::run;
using Outcome = test::TetOutcome;

namespace
{
double longest_boundary_edge(const TetMesh& mesh)
{
  double longest = 0.0;
  for (const Edge& edge : mesh_edges(boundary_triangles(mesh.tets)))
  {
    longest = std::max(longest, (mesh.points.row(edge.a) - mesh.points.row(edge.b)).norm());
  }
  return longest;
}

/// Expect that the mesh still fills the unit cube.
void expect_cube(const TetMesh& mesh)
{
  EXPECT_TRUE(check_tets(mesh.points, mesh.tets).ok());
  EXPECT_NEAR(tet_volumes(mesh.points, mesh.tets).sum(), 1.0, 1e-12);
  EXPECT_NEAR(surface_area(mesh.points, boundary_triangles(mesh.tets)), 6.0, 1e-12);
}
} // namespace

TEST(TetInsertion, LongEdgesOfTheBoundaryAreSplit)
{
  TetMesh mesh = test::tet_box(1, 1, 1);
  const Points before = mesh.points;
  ExecutionContext context;
  ASSERT_TRUE(split_long_edges(context, mesh, 0.3, 1000000));
  expect_cube(mesh);
  EXPECT_EQ(mesh.points.topRows(8), before);
  EXPECT_LE(longest_boundary_edge(mesh), 0.3);
  EXPECT_GT(longest_boundary_edge(mesh), 0.15) << "none is shorter than it must be";
}

TEST(TetInsertion, SplittingEndsAtTheNumberOfTets)
{
  TetMesh mesh = test::tet_box(2, 2, 2);
  ExecutionContext context;
  ASSERT_TRUE(split_long_edges(context, mesh, 0.01, 500));
  EXPECT_GE(mesh.tets.rows(), 500);
  EXPECT_LT(mesh.tets.rows(), 520);
}

TEST(TetInsertion, PlacesBecomeVertices)
{
  TetMesh mesh = test::tet_box(1, 1, 1);
  Points positions(4, 3);
  // The points are in general position, on the cube's diagonal, on its boundary, and outside.
  positions << 0.3, 0.41, 0.2, 0.5, 0.5, 0.5, 0.0, 0.31, 0.4, 1.5, 0.5, 0.5;
  std::vector<Index> vertices;
  ExecutionContext context;
  ASSERT_TRUE(insert_vertices(context, mesh, positions, vertices));
  ASSERT_EQ(vertices.size(), 4u);
  for (const int i : { 0, 1 })
  {
    ASSERT_GE(vertices[i], 8);
    EXPECT_EQ(mesh.points.row(vertices[i]), positions.row(i));
  }
  EXPECT_EQ(vertices[2], -1);
  EXPECT_EQ(vertices[3], -1);
  EXPECT_EQ(mesh.points.rows(), 10);
  EXPECT_EQ(boundary_triangles(mesh.tets).rows(), 12);
  expect_cube(mesh);
}

TEST(TetInsertion, ManyPlacesAreInserted)
{
  TetMesh mesh = test::tet_box(3, 3, 3);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(0.05, 0.95);
  Points positions(500, 3);
  std::generate_n(positions.data(), positions.size(), [&] { return within(random); });
  std::vector<Index> vertices;
  ExecutionContext context;
  ASSERT_TRUE(insert_vertices(context, mesh, positions, vertices));
  EXPECT_EQ(std::count(vertices.begin(), vertices.end(), -1), 0);
  expect_cube(mesh);
}

TEST(TetInsertion, PlacesAreFoundAgainWhenReplacedTetsAreDropped)
{
  // Each insertion replaces about 20 tets by new tets with new ids. After all insertions, there are
  // several times as many ids as tets.
  TetMesh mesh = test::tet_box(3, 3, 3);
  test::Random random(23);
  Points positions(20000, 3);
  for (Index i = 0; i < positions.rows(); ++i)
  {
    positions.row(i) = random.in_box(Vec3::Constant(0.01), Vec3::Constant(0.99));
  }
  std::vector<Index> vertices;
  ExecutionContext context;
  ASSERT_TRUE(insert_vertices(context, mesh, positions, vertices));
  EXPECT_EQ(std::count(vertices.begin(), vertices.end(), -1), 0);
  for (Index i = 0; i < positions.rows(); ++i)
  {
    EXPECT_EQ(mesh.points.row(vertices[i]), positions.row(i));
  }
  expect_cube(mesh);
}

TEST(TetInsertion, ThreadsMakeNoDifference)
{
  // There are ten points per tet of the box. Most points are in tets that earlier insertions
  // created, and many points of one batch need the same tets.
  const TetMesh box = test::tet_box(3, 3, 3);
  test::Random random(17);
  Points positions(10 * box.tets.rows(), 3);
  for (Index i = 0; i < positions.rows(); ++i)
  {
    positions.row(i) = random.in_box(Vec3::Constant(0.01), Vec3::Constant(0.99));
  }
  TetMesh one;
  for (const int threads : { 1, 2, 8 })
  {
    SCOPED_TRACE(threads);
    TetMesh mesh = box;
    ExecutionContext context;
    context.set_threads(threads);
    std::vector<Index> vertices;
    ASSERT_TRUE(insert_vertices(context, mesh, positions, vertices));
    expect_cube(mesh);
    for (Index i = 0; i < positions.rows(); ++i)
    {
      ASSERT_GE(vertices[i], box.points.rows()) << i;
      ASSERT_EQ(mesh.points.row(vertices[i]), positions.row(i)) << i;
    }
    if (threads == 1)
    {
      one = mesh;
    }
    EXPECT_EQ(mesh.points, one.points);
    EXPECT_EQ(mesh.tets, one.tets);
  }
}

TEST(TetInsertion, CancelLeavesAMesh)
{
  TetMesh mesh = test::tet_box(1, 1, 1);
  ExecutionContext context;
  context.request_cancel();
  EXPECT_FALSE(split_long_edges(context, mesh, 0.01, 1000000));
  std::vector<Index> vertices;
  EXPECT_FALSE(insert_vertices(context, mesh, Points::Constant(9, 3, 0.4), vertices));
  expect_cube(mesh);
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

TEST_F(Cdt, AnEllipsoidIsFilledWithoutSlivers)
{
  // All vertices are on one quadric. Without additional vertices, all tets would be slivers that
  // extend through the whole shape.
  TriangleMesh spindle = test::sphere(5);
  spindle.points.leftCols(2) *= 0.45;
  const Outcome outcome = run(spindle, TetMethod::cdt);
  expect_valid(outcome, spindle);
  EXPECT_LT(outcome.number("counts.tets_below_5_degrees"),
    0.01 * static_cast<double>(outcome.result.mesh.tets.rows()));
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
  // The boxes have 12 triangles. The triangles of the 100 x 1 x 1 box have corners of 0.57 degrees.
  TetrahedralizeOptions bare;
  bare.method = TetMethod::cdt;
  bare.bare = true;
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
