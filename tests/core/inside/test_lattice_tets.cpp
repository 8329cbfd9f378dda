// Isosurface stuffing: tets of a lattice that fill the inside of a surface.
#include "inside/lattice_tets.h"

#include "tets/tet_quality.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
TetMesh stuff_surface(const TriangleMesh& mesh, Index resolution, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  const WindingNumber winding(mesh.points, mesh.triangles);
  const Box box = bounding_box(mesh.points, mesh.triangles);
  TetMesh tets;
  const Status status =
    stuff_lattice(context, winding, Lattice::around(box, resolution), box, 0.5, tets);
  EXPECT_TRUE(status.ok()) << status.message;
  return tets;
}
} // namespace

TEST(LatticeTets, StuffingHasGoodAnglesAndTheRightVolume)
{
  const TriangleMesh sphere = test::sphere(3);
  const double volume = signed_volume(sphere.points, sphere.triangles);
  double last_error = 1.0;
  for (const Index resolution : { 8, 16, 32 })
  {
    const TetMesh mesh = stuff_surface(sphere, resolution);
    ASSERT_TRUE(check_tets(mesh.points, mesh.tets).ok());
    const TetQuality quality = measure_tets(mesh.points, mesh.tets);
    EXPECT_GT(quality.min_volume, 0.0);
    EXPECT_TRUE(count_edges(boundary_triangles(mesh.tets)).closed);
    EXPECT_GE(quality.min_dihedral_angle, 10.7) << "bound proved by Labelle and Shewchuk";
    const double error = std::abs(quality.volume - volume) / volume;
    EXPECT_LT(error, 0.6 * last_error) << resolution;
    last_error = error;
    EXPECT_EQ(test::euler_characteristic(mesh), 1) << "a ball";
  }
  EXPECT_LT(last_error, 0.01);
}

TEST(LatticeTets, StuffingKeepsTheTopology)
{
  const TetMesh torus = stuff_surface(test::torus(48, 24, 1.0, 0.4), 24);
  EXPECT_EQ(test::euler_characteristic(torus), 0);
  const TetMesh shell =
    stuff_surface(test::join(test::sphere(3), test::flipped(test::sphere(3, 0.5))), 24);
  EXPECT_EQ(test::euler_characteristic(shell), 2) << "a ball with a cavity";
  EXPECT_GE(measure_tets(shell.points, shell.tets).min_dihedral_angle, 10.7);
}

TEST(LatticeTets, StuffingBoundaryLiesOnTheSurface)
{
  const TriangleMesh sphere = test::sphere(4);
  const TetMesh mesh = stuff_surface(sphere, 16);
  const double cube = 2.0 / 16.0;
  const Triangles skin = boundary_triangles(mesh.tets);
  for (Index k = 0; k < skin.size(); ++k)
  {
    // Boundary vertices are found by bisection, with an error of up to 1/256 of a lattice edge. The
    // vertices of the surface are on the unit sphere, but its triangles are up to 1e-3 inside of
    // the unit sphere.
    EXPECT_NEAR(mesh.points.row(skin.data()[k]).norm(), 1.0, cube / 256.0 + 3e-3);
  }
}

TEST(LatticeTets, StuffingOfAnOpenCubeEndsAtItsOpening)
{
  const TetMesh mesh = stuff_surface(test::open_cube(), 16);
  const TetQuality quality = measure_tets(mesh.points, mesh.tets);
  EXPECT_NEAR(quality.volume, 8.0, 0.25) << "edges of the cube are cut off";
  EXPECT_GE(quality.min_dihedral_angle, 10.7);
}

TEST(LatticeTets, NothingEnclosedGivesNothing)
{
  EXPECT_EQ(stuff_surface(test::grid(2, 2), 8).tets.rows(), 0);
}

TEST(LatticeTets, SameBitsForAnyNumberOfThreads)
{
  const TriangleMesh surface = test::torus(24, 12, 1.0, 0.4);
  const TetMesh serial = stuff_surface(surface, 16, 1), parallel = stuff_surface(surface, 16, 4);
  EXPECT_EQ(serial.points, parallel.points);
  EXPECT_EQ(serial.tets, parallel.tets);
}

TEST(LatticeTets, MovesAndScalesWithTheSurface)
{
  const TriangleMesh surface = test::torus(24, 12, 1.0, 0.4);
  TriangleMesh large = surface;
  large.points *= 1024.0; // scaling by a power of two does not round
  const TetMesh a = stuff_surface(surface, 12), b = stuff_surface(large, 12);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(Points(1024.0 * a.points), b.points);
}

TEST(LatticeTets, CancelEndsSoon)
{
  const TriangleMesh mesh = test::sphere(4);
  const WindingNumber winding(mesh.points, mesh.triangles);
  const Box box = bounding_box(mesh.points, mesh.triangles);
  ExecutionContext context;
  context.request_cancel();
  TetMesh tets;
  EXPECT_EQ(stuff_lattice(context, winding, Lattice::around(box, 60), box, 0.5, tets).code,
    StatusCode::canceled);
}
