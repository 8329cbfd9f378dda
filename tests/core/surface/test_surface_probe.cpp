// Picking on a surface with a ray: thickness along the ray and nearest points, for known shapes.
#include "support/meshes.h"
#include "surface/surface_probe.h"

#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
const Vec3 far_left(-7.0, 0.11, 0.07);

// Return the distance of p from the plane through the origin that is perpendicular to `direction`.
double off_center(const Vec3& p, const Vec3& direction)
{
  return std::abs(p.dot(direction.normalized()));
}
} // namespace

TEST(SurfaceProbe, MidThicknessOfASphereIsItsCenterPlane)
{
  const TriangleMesh ball = test::sphere(3);
  const SurfaceProbe probe(ball.points, ball.triangles);
  test::Random random(3);
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 direction = random.in_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)).normalized();
    const Vec3 aside = 0.4 * direction.cross(random.in_box(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
    LineSpan through;
    LineSpan back;
    ASSERT_TRUE(probe.first_inside(aside - 5.0 * direction, direction, through));
    ASSERT_TRUE(probe.first_inside(aside + 5.0 * direction, -direction, back));
    EXPECT_LT((through.entry - back.exit).norm(), 1e-9);
    EXPECT_LT((through.middle() - back.middle()).norm(), 1e-9);
    const double chord = 2.0 * std::sqrt(1.0 - aside.squaredNorm());
    EXPECT_NEAR((through.exit - through.entry).norm(), chord, 0.06);
    EXPECT_LT(off_center(through.middle(), direction), 0.03);
  }
  LineSpan span;
  // This line passes through the center of the polyhedron, which is symmetric about its center. The
  // midpoint of the chord is therefore exact.
  ASSERT_TRUE(probe.first_inside(Vec3(-5, 0, 0), Vec3(2, 0, 0), span));
  EXPECT_LT(span.middle().norm(), 1e-12);
  EXPECT_FALSE(probe.first_inside(Vec3(-5, 2, 0), Vec3(1, 0, 0), span)) << "past it";
  EXPECT_FALSE(probe.first_inside(Vec3(-5, 0, 0), Vec3(-1, 0, 0), span)) << "away from it";
}

TEST(SurfaceProbe, EdgesAndVerticesCountOnce)
{
  const TriangleMesh cube = test::cube(-1.0, 1.0);
  const SurfaceProbe probe(cube.points, cube.triangles);
  // The rays pass through the diagonal of a face of the cube, through the middle of an edge, and
  // through corners.
  for (const Vec3& origin : { Vec3(-5, 0, 0), Vec3(-5, -5, 0), Vec3(-5, -5, -5) })
  {
    EXPECT_EQ(probe.hits(origin, -origin).size(), 2u) << origin.transpose();
    LineSpan span;
    ASSERT_TRUE(probe.first_inside(origin, -origin, span));
    EXPECT_LT(span.middle().norm(), 1e-12);
  }
}

TEST(SurfaceProbe, OverlapsAreOneThicknessAndCavitiesEndIt)
{
  const TriangleMesh outer = test::sphere(2, 2.0);
  const TriangleMesh inner = test::sphere(2, 1.0);
  LineSpan span;
  {
    const TriangleMesh nested = test::join(outer, inner);
    const SurfaceProbe probe(nested.points, nested.triangles);
    ASSERT_TRUE(probe.first_inside(far_left, Vec3::UnitX(), span));
    EXPECT_LT(std::abs(span.middle()[0]), 0.05) << "2 inside 1 is inside";
    EXPECT_NEAR((span.exit - span.entry).norm(), 4.0, 0.1);
  }
  {
    const TriangleMesh shell = test::join(outer, test::flipped(inner));
    const SurfaceProbe probe(shell.points, shell.triangles);
    ASSERT_TRUE(probe.first_inside(far_left, Vec3::UnitX(), span));
    EXPECT_NEAR(span.middle()[0], -1.5, 0.05) << "between the walls";
  }
  {
    const TriangleMesh overlap = test::join(
      test::translated(inner, Vec3(-0.5, 0, 0)), test::translated(inner, Vec3(0.5, 0, 0)));
    const SurfaceProbe probe(overlap.points, overlap.triangles);
    ASSERT_TRUE(probe.first_inside(far_left, Vec3::UnitX(), span));
    EXPECT_NEAR((span.exit - span.entry).norm(), 3.0, 0.05);
  }
}

TEST(SurfaceProbe, InsideOutAndOpenSurfacesHaveAThicknessStill)
{
  LineSpan span;
  const TriangleMesh turned = test::flipped(test::sphere(3));
  const SurfaceProbe inside_out(turned.points, turned.triangles);
  ASSERT_TRUE(inside_out.first_inside(far_left, Vec3::UnitX(), span));
  EXPECT_LT(std::abs(span.middle()[0]), 0.02);

  const TriangleMesh open = test::open_cube();
  const SurfaceProbe probe(open.points, open.triangles);
  ASSERT_TRUE(probe.first_inside(Vec3(0.3, 0.2, 5), -Vec3::UnitZ(), span));
  EXPECT_EQ(span.entry, span.exit) << "only the bottom is met, through the hole";
  EXPECT_NEAR(span.middle()[2], -1.0, 1e-12);
  ASSERT_TRUE(probe.first_inside(Vec3(-5, 0.2, 0.1), Vec3::UnitX(), span));
  EXPECT_LT((span.middle() - Vec3(0, 0.2, 0.1)).norm(), 1e-12);
}

TEST(SurfaceProbe, NearestIsTheNearestOfAllTriangles)
{
  const TriangleMesh ball = test::sphere(3);
  const SurfaceProbe probe(ball.points, ball.triangles);
  test::Random random(5);
  for (int i = 0; i < 100; ++i)
  {
    const Vec3 p = random.in_box(Vec3(-2, -2, -2), Vec3(2, 2, 2));
    Vec3 place;
    ASSERT_TRUE(probe.nearest(p, place));
    EXPECT_NEAR((p - place).norm(), std::abs(p.norm() - 1.0), 0.02);
    // No vertex is nearer to the query point p than the result `place`.
    const double nearest = (ball.points.rowwise() - p.transpose()).rowwise().norm().minCoeff();
    EXPECT_LE((p - place).norm(), nearest + 1e-12);
  }
  const TriangleMesh none{ Points(0, 3), Triangles(0, 3) };
  const SurfaceProbe empty(none.points, none.triangles);
  Vec3 place;
  EXPECT_FALSE(empty.nearest(Vec3::Zero(), place));
  EXPECT_TRUE(empty.hits(Vec3::Zero(), Vec3::UnitX()).empty());
  EXPECT_TRUE(probe.hits(Vec3::Zero(), Vec3::Zero()).empty());
}
