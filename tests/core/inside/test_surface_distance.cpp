// Distance between a surface and the boundary of its tets, for boxes with known distances.
#include "inside/surface_distance.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
SurfaceDistance distance_of(const TetMesh& mesh, const TriangleMesh& surface)
{
  const WindingNumber winding(surface.points, surface.triangles);
  const RegionBoundary region(surface.points, surface.triangles, winding, 0.5);
  ExecutionContext context;
  SurfaceDistance distance;
  EXPECT_TRUE(measure_distance(context, mesh, region, distance));
  return distance;
}

TetMesh box_of_tets(const Vec3& lower, const Vec3& upper)
{
  return test::tet_box(6, 6, 6, lower, upper);
}
} // namespace

TEST(SurfaceDistance, OfBoxesIsKnown)
{
  const TriangleMesh cube = test::cube();
  const SurfaceDistance none = distance_of(box_of_tets(Vec3(-1, -1, -1), Vec3(1, 1, 1)), cube);
  EXPECT_NEAR(none.maximum, 0.0, 1e-12);
  EXPECT_NEAR(none.mean, 0.0, 1e-12);
  EXPECT_GT(none.samples, 12);
  // The top of the tets is too low by 0.25. The top has a sixth of the surface's area, and a
  // slightly larger fraction of the area of the tets' boundary.
  const SurfaceDistance low = distance_of(box_of_tets(Vec3(-1, -1, -1), Vec3(1, 1, 0.75)), cube);
  EXPECT_NEAR(low.maximum, 0.25, 1e-12);
  EXPECT_GT(low.mean, 0.25 / 7.0);
  EXPECT_LT(low.mean, 0.25 / 3.0);
  // The box is too large by 0.1 on all sides, so the distance at its corners is 0.1 sqrt(3).
  const SurfaceDistance large =
    distance_of(box_of_tets(Vec3(-1.1, -1.1, -1.1), Vec3(1.1, 1.1, 1.1)), cube);
  EXPECT_NEAR(large.maximum, 0.1 * std::sqrt(3.0), 1e-12);
  EXPECT_GT(large.mean, 0.1);
  EXPECT_LT(large.mean, 0.13);
}

TEST(SurfaceDistance, MissingPartsCountFromTheSurface)
{
  const TriangleMesh two =
    test::join(test::cube(), test::translated(test::cube(), Vec3(10.0, 0.0, 0.0)));
  const SurfaceDistance distance = distance_of(box_of_tets(Vec3(-1, -1, -1), Vec3(1, 1, 1)), two);
  EXPECT_NEAR(distance.maximum, 10.0, 1e-9);
}

TEST(SurfaceDistance, LidsDoNotCount)
{
  // The tets of the open cube end at the top of its bounding box, where the surface has no
  // triangles.
  const SurfaceDistance open =
    distance_of(box_of_tets(Vec3(-1, -1, -1), Vec3(1, 1, 1)), test::open_cube());
  EXPECT_NEAR(open.maximum, 0.0, 1e-9);
}

TEST(SurfaceDistance, InnerPartsDoNotCount)
{
  // The winding number is 1 between the cubes and 2 in the inner cube. The inner surface is
  // therefore not on the boundary of the tets.
  const TriangleMesh nested = test::join(test::cube(), test::cube(-0.4, 0.4));
  const SurfaceDistance distance =
    distance_of(box_of_tets(Vec3(-1, -1, -1), Vec3(1, 1, 1)), nested);
  EXPECT_NEAR(distance.maximum, 0.0, 1e-12);
}

TEST(SurfaceDistance, NoTetsAreInfinitelyFar)
{
  EXPECT_TRUE(std::isinf(distance_of(TetMesh(), test::cube()).maximum));
}
