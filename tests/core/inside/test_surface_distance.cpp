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
  EXPECT_TRUE(measure_distance(mesh, region, distance, context));
  return distance;
}

TetMesh box(const Vec3& lower, const Vec3& upper)
{
  return test::tet_box(6, 6, 6, lower, upper);
}
} // namespace

TEST(SurfaceDistance, OfBoxesIsKnown)
{
  const TriangleMesh cube = test::cube();
  const SurfaceDistance none = distance_of(box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), cube);
  EXPECT_NEAR(none.maximum, 0.0, 1e-12);
  EXPECT_NEAR(none.mean, 0.0, 1e-12);
  EXPECT_GT(none.samples, 12);
  // Too low by 0.25: only the top is off, a sixth of the surface (and of the tets' box a bit more).
  const SurfaceDistance low = distance_of(box(Vec3(-1, -1, -1), Vec3(1, 1, 0.75)), cube);
  EXPECT_NEAR(low.maximum, 0.25, 1e-12);
  EXPECT_GT(low.mean, 0.25 / 7.0);
  EXPECT_LT(low.mean, 0.25 / 3.0);
  // Everywhere 0.1 too large: at the corners sqrt(3) of that.
  const SurfaceDistance large = distance_of(box(Vec3(-1.1, -1.1, -1.1), Vec3(1.1, 1.1, 1.1)), cube);
  EXPECT_NEAR(large.maximum, 0.1 * std::sqrt(3.0), 1e-12);
  EXPECT_GT(large.mean, 0.1);
  EXPECT_LT(large.mean, 0.13);
}

TEST(SurfaceDistance, MissingPartsCountFromTheSurface)
{
  const TriangleMesh two =
    test::join(test::cube(), test::translated(test::cube(), Vec3(10.0, 0.0, 0.0)));
  const SurfaceDistance distance = distance_of(box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), two);
  EXPECT_NEAR(distance.maximum, 10.0, 1e-9);
}

TEST(SurfaceDistance, LidsDoNotCount)
{
  // The region of the open cube ends at the top of its box, where there is no triangle.
  const SurfaceDistance open = distance_of(box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), test::open_cube());
  EXPECT_NEAR(open.maximum, 0.0, 1e-9);
}

TEST(SurfaceDistance, InnerPartsDoNotCount)
{
  // A solid within a solid winds twice: its surface bounds nothing.
  const TriangleMesh nested = test::join(test::cube(), test::cube(-0.4, 0.4));
  const SurfaceDistance distance = distance_of(box(Vec3(-1, -1, -1), Vec3(1, 1, 1)), nested);
  EXPECT_NEAR(distance.maximum, 0.0, 1e-12);
}

TEST(SurfaceDistance, NoTetsAreInfinitelyFar)
{
  EXPECT_TRUE(std::isinf(distance_of(TetMesh(), test::cube()).maximum));
}
