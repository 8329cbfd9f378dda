// Points inside of closed surfaces: their positions, spacing and number.
#include "inside/inner_points.h"

#include "base/constants.h"

#include "support/meshes.h"
#include "support/sanitized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

using namespace bindpose;

namespace
{
SizingField constant_sizes(double length)
{
  return SizingField(Points(0, 3), Eigen::VectorXd(0), 0.0, length);
}

Points points_in(const TriangleMesh& mesh, SizingField sizes, Index maximum_count, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  Interior interior;
  EXPECT_TRUE(interior.build(context, mesh.points, mesh.triangles).ok());
  Points inner;
  EXPECT_TRUE(inner_points(context, interior, sizes, maximum_count, inner));
  return inner;
}

/// Return the distance from point i to its nearest neighbor.
double spacing(const Points& points, Index i)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < points.rows(); ++k)
  {
    nearest = k == i ? nearest : std::min(nearest, (points.row(k) - points.row(i)).norm());
  }
  return nearest;
}
} // namespace

TEST(InnerPoints, AreInsideAndAsFarApartAsTheSizesSay)
{
  const TriangleMesh sphere = test::sphere(4); // of radius 1
  const double length = 0.2;
  const Points inner = points_in(sphere, constant_sizes(length), 100000);
  for (Index i = 0; i < inner.rows(); ++i)
  {
    EXPECT_LE(inner.row(i).norm(), 1.0 - 0.5 * length + 1e-3);
    // Cells are halved until they are small enough, so their size is 0.55 to 1.1 times the
    // requested length.
    EXPECT_GE(spacing(inner, i), 0.47 * length);
    EXPECT_LE(spacing(inner, i), 1.1 * length);
  }
  // Each cell contributes two points.
  const double volume = 4.0 / 3.0 * pi * std::pow(1.0 - 0.5 * length, 3.0);
  EXPECT_GE(static_cast<double>(inner.rows()), 2.0 * volume / std::pow(1.1 * length, 3.0) * 0.9);
  EXPECT_LE(static_cast<double>(inner.rows()), 2.0 * volume / std::pow(0.55 * length, 3.0) * 1.1);
}

TEST(InnerPoints, AreDenserWhereTheSurfaceIs)
{
  Points site(1, 3);
  site << 1.0, 0.0, 0.0;
  const SizingField sizes(site, Eigen::VectorXd::Constant(1, 0.02), 0.5, 10.0);
  const Points inner = points_in(test::sphere(4), sizes, 100000);
  ASSERT_GT(inner.rows(), 50);
  for (Index i = 0; i < inner.rows(); ++i)
  {
    const double target = sizes.at(inner.row(i));
    EXPECT_GE(spacing(inner, i), 0.2 * target);
    EXPECT_LE(spacing(inner, i), 2.0 * target);
  }
}

TEST(InnerPoints, AreNotManyMoreThanAskedFor)
{
  const TriangleMesh sphere = test::sphere(3);
  const SizingField sizes(
    sphere.points, Eigen::VectorXd::Constant(sphere.points.rows(), 0.02), 0.5, 10.0);
  const Points inner = points_in(sphere, sizes, 300);
  EXPECT_LE(inner.rows(), 360);
  EXPECT_GE(inner.rows(), 100);
}

TEST(InnerPoints, EvenGridsGiveSomePointsAndNotTooMany)
{
  // The requested length is the same at all points of the surface. If this length decreases, all
  // cells at the surface are subdivided at once. The number of points then changes abruptly.
  for (const double height : { 1.0, 0.2, 0.05 })
  {
    const TetMesh box = test::tet_box(20, 20, 4, Vec3::Zero(), Vec3(1.0, 1.0, height));
    const TriangleMesh mesh{ box.points, boundary_triangles(box.tets) };
    const SizingField sizes(
      mesh.points, Eigen::VectorXd::Constant(mesh.points.rows(), 0.05), 0.75, 2.0);
    for (const Index maximum_count : { 20, 200, 1000 })
    {
      const Points inner = points_in(mesh, sizes, maximum_count);
      EXPECT_GT(inner.rows(), 0) << height << " " << maximum_count;
      EXPECT_LE(inner.rows(), 2 * maximum_count) << height << " " << maximum_count;
    }
  }
}

TEST(InnerPoints, AShapeMuchThinnerThanTheRequestedLengthTakesLittleTime)
{
  // The surface intersects 20 million cells of the requested size. No cell is inside.
  TriangleMesh disk = test::sphere(3);
  disk.points.col(2) *= 1e-8;
  const auto start = std::chrono::steady_clock::now();
  const Points inner = points_in(disk, constant_sizes(4e-4), 200);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  EXPECT_LE(inner.rows(), 400);
  EXPECT_LT(elapsed.count(), test::sanitized ? 60.0 : 10.0);
}

TEST(InnerPoints, AHollowStaysEmpty)
{
  TriangleMesh shell = test::sphere(4);
  const TriangleMesh inner = test::sphere(4);
  const Index vertices = shell.points.rows();
  const Index triangles = shell.triangles.rows();
  shell.points.conservativeResize(2 * vertices, 3);
  shell.points.bottomRows(vertices) = 0.5 * inner.points;
  shell.triangles.conservativeResize(2 * triangles, 3);
  shell.triangles.bottomRows(triangles) =
    inner.triangles.rowwise().reverse().array() + vertices; // reversed orientation
  const Points points = points_in(shell, constant_sizes(0.1), 100000);
  ASSERT_GT(points.rows(), 1000);
  EXPECT_GT(points.rowwise().norm().minCoeff(), 0.5);
}

TEST(InnerPoints, DoNotDependOnThreads)
{
  const TriangleMesh sphere = test::sphere(3);
  const SizingField sizes(
    sphere.points, Eigen::VectorXd::Constant(sphere.points.rows(), 0.05), 0.5, 10.0);
  EXPECT_EQ(points_in(sphere, sizes, 1000, 1), points_in(sphere, sizes, 1000, 2));
}

TEST(InnerPoints, CancelEndsTheSearch)
{
  const TriangleMesh sphere = test::sphere(3);
  ExecutionContext context;
  Interior interior;
  ASSERT_TRUE(interior.build(context, sphere.points, sphere.triangles).ok());
  context.request_cancel();
  SizingField sizes = constant_sizes(0.01);
  Points inner;
  EXPECT_FALSE(inner_points(context, interior, sizes, 1000000, inner));
}
