// Curve skeletons computed by the helper program, on shapes with known medial axes.
#include "automatic/curve_skeleton.h"

#include "core/automatic/blocks.h"
#include "support/cancel_later.h"
#include "support/environment.h"
#include "support/meshes.h"
#include "support/needs_mesher.h"
#include "support/sanitized.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace bindpose;
using test::Block;
using test::Environment;
using testing::HasSubstr;

namespace
{
class CurveSkeletonTest : public test::MesherTest
{
};

Status run_curve_skeleton(const TriangleMesh& mesh, CurveSkeleton& skeleton, TriangleMesh& solid)
{
  ExecutionContext context;
  return curve_skeleton(
    context, mesh.points, mesh.triangles, CurveSkeletonOptions(), skeleton, solid);
}

CurveSkeleton run_curve_skeleton(const TriangleMesh& mesh, const std::string& surface = "clean")
{
  CurveSkeleton skeleton;
  TriangleMesh solid;
  const Status status = run_curve_skeleton(mesh, skeleton, solid);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("surface"), surface);
  EXPECT_EQ(skeleton.radii.size(), skeleton.points.rows());
  EXPECT_EQ(static_cast<Index>(skeleton.part_of_point.size()), skeleton.points.rows());
  return skeleton;
}

std::vector<Index> degrees(const CurveSkeleton& skeleton)
{
  std::vector<Index> degree(static_cast<std::size_t>(skeleton.points.rows()), 0);
  for (Index k = 0; k < skeleton.segments.size(); ++k)
  {
    ++degree[skeleton.segments.data()[k]];
  }
  return degree;
}

TriangleMesh bar_of_cubes(int length)
{
  return test::star({ { 1, 0, 0 } }, length - 1);
}

/// Return the number of independent cycles: segments - points + components.
Index cycles(const CurveSkeleton& skeleton)
{
  return skeleton.segments.rows() - skeleton.points.rows() +
    static_cast<Index>(skeleton.centroids.size());
}
} // namespace

TEST_F(CurveSkeletonTest, OfABarIsItsAxis)
{
  const CurveSkeleton skeleton = run_curve_skeleton(bar_of_cubes(8));
  const std::vector<Index> degree = degrees(skeleton);
  // The skeleton is a single path along the axis. In a build with sanitizers, round-off adds short
  // branches of one segment.
  const auto inner = std::count(degree.begin(), degree.end(), 2);
  const std::ptrdiff_t spurs = test::sanitized ? 2 : 0;
  EXPECT_GE(inner, static_cast<std::ptrdiff_t>(degree.size()) - 2 - 2 * spurs);
  EXPECT_GE(std::count(degree.begin(), degree.end(), 1), 2);
  EXPECT_LE(std::count(degree.begin(), degree.end(), 1), 2 + spurs);
  for (Index v = 0; v < skeleton.points.rows(); ++v)
  {
    if (degree[v] != 2 && !test::sanitized)
    {
      EXPECT_GT(std::abs(skeleton.points(v, 0) - 4.0), 3.0);
    }
    EXPECT_NEAR(skeleton.points(v, 1), 0.5, 0.03);
    EXPECT_NEAR(skeleton.points(v, 2), 0.5, 0.03);
    EXPECT_NEAR(skeleton.radii[v], 0.5, 0.05);
  }
  // The skeleton ends about half a thickness before the ends of the bar.
  EXPECT_LT(skeleton.points.col(0).minCoeff(), 0.7);
  EXPECT_GT(skeleton.points.col(0).maxCoeff(), 7.3);
  ASSERT_EQ(skeleton.centroids.size(), 1u);
  EXPECT_LT((skeleton.centroids[0] - Vec3(4.0, 0.5, 0.5)).norm(), 1e-12);
}

TEST_F(CurveSkeletonTest, OfATorusIsARing)
{
  const CurveSkeleton skeleton = run_curve_skeleton(test::torus(60, 24, 1.0, 0.3));
  EXPECT_EQ(cycles(skeleton), 1);
  for (Index v = 0; v < skeleton.points.rows(); ++v)
  {
    EXPECT_NEAR(std::hypot(skeleton.points(v, 0), skeleton.points(v, 1)), 1.0, 0.03);
    EXPECT_NEAR(skeleton.points(v, 2), 0.0, 0.03);
  }
}

TEST_F(CurveSkeletonTest, OfCrossingBarsIsThatOfTheirUnion)
{
  TriangleMesh second = bar_of_cubes(9);
  second.points = second.points.rowwise() - Eigen::RowVector3d(4.0, 0.0, 0.0);
  second.points.col(0).swap(second.points.col(1));
  second.triangles.col(0).swap(second.triangles.col(1)); // mirroring reverses the orientation
  second.points.col(0).array() += 4.07;
  second.points.col(2).array() += 0.03; // avoid coplanar triangles of the bars
  const CurveSkeleton skeleton = run_curve_skeleton(test::join(bar_of_cubes(9), second), "lattice");
  EXPECT_EQ(skeleton.centroids.size(), 1u);
  EXPECT_EQ(cycles(skeleton), 0);
  const std::vector<Index> degree = degrees(skeleton);
  EXPECT_EQ(std::count(degree.begin(), degree.end(), 1), 4);
}

TEST_F(CurveSkeletonTest, OfAnOpenBarIsNearItsAxis)
{
  // One end of the bar is removed.
  TriangleMesh open = bar_of_cubes(8);
  Triangles kept(0, 3);
  for (Index f = 0; f < open.triangles.rows(); ++f)
  {
    const bool end = open.points(open.triangles(f, 0), 0) == 8.0 &&
      open.points(open.triangles(f, 1), 0) == 8.0 && open.points(open.triangles(f, 2), 0) == 8.0;
    if (!end)
    {
      kept.conservativeResize(kept.rows() + 1, 3);
      kept.row(kept.rows() - 1) = open.triangles.row(f);
    }
  }
  open.triangles = kept;
  const CurveSkeleton skeleton = run_curve_skeleton(open, "lattice");
  EXPECT_EQ(cycles(skeleton), 0);
  for (Index v = 0; v < skeleton.points.rows(); ++v)
  {
    EXPECT_NEAR(skeleton.points(v, 1), 0.5, 0.1);
    EXPECT_NEAR(skeleton.points(v, 2), 0.5, 0.1);
  }
  EXPECT_LT(skeleton.points.col(0).minCoeff(), 0.7);
  EXPECT_GT(skeleton.points.col(0).maxCoeff(), 7.0);
}

TEST_F(CurveSkeletonTest, OfAFlatSheetIsItsMedialAxis)
{
  // A strip of 8 x 1 without thickness.
  const CurveSkeleton skeleton = run_curve_skeleton(test::grid(32, 4, 8.0, 1.0), "lattice");
  EXPECT_EQ(cycles(skeleton), 0);
  for (Index v = 0; v < skeleton.points.rows(); ++v)
  {
    // At the ends the skeleton branches toward the corners.
    if (std::abs(skeleton.points(v, 0) - 4.0) < 3.0)
    {
      EXPECT_NEAR(skeleton.points(v, 1), 0.5, 0.05);
    }
    EXPECT_NEAR(skeleton.points(v, 2), 0.0, 0.05);
  }
  EXPECT_LT(skeleton.points.col(0).minCoeff(), 1.0);
  EXPECT_GT(skeleton.points.col(0).maxCoeff(), 7.0);
}

TEST_F(CurveSkeletonTest, OfBoxesThatTouchIsOne)
{
  // Two closed bars touch end to end, like the parts of furniture.
  const TriangleMesh row =
    test::join(bar_of_cubes(4), test::translated(bar_of_cubes(4), Vec3(4.0, 0.0, 0.0)));
  const CurveSkeleton skeleton = run_curve_skeleton(row, "lattice");
  EXPECT_EQ(skeleton.centroids.size(), 1u);
  EXPECT_LT(skeleton.points.col(0).minCoeff(), 1.0);
  EXPECT_GT(skeleton.points.col(0).maxCoeff(), 7.0);
}

TEST_F(CurveSkeletonTest, OfADenseCleanSurfaceIsThatOfACoarseOne)
{
  CurveSkeletonOptions options;
  options.triangles = 4000;
  const TriangleMesh dense = test::torus(300, 80, 1.0, 0.3); // 48,000 triangles
  CurveSkeleton skeleton;
  TriangleMesh solid;
  ExecutionContext context;
  const Status status =
    curve_skeleton(context, dense.points, dense.triangles, options, skeleton, solid);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("surface"), "lattice");
  EXPECT_EQ(cycles(skeleton), 1);
  for (Index v = 0; v < skeleton.points.rows(); ++v)
  {
    EXPECT_NEAR(std::hypot(skeleton.points(v, 0), skeleton.points(v, 1)), 1.0, 0.05);
  }
}

TEST_F(CurveSkeletonTest, OfABallIsAPointAndHollowsAreFilled)
{
  const TriangleMesh shell = test::join(test::sphere(3), test::flipped(test::sphere(2, 0.4)));
  const CurveSkeleton skeleton = run_curve_skeleton(shell);
  ASSERT_EQ(skeleton.centroids.size(), 1u);
  for (Index v = 0; v < skeleton.points.rows(); ++v)
  {
    EXPECT_LT(skeleton.points.row(v).norm(), 0.1);
  }
}

TEST_F(CurveSkeletonTest, ComponentsHaveTheirOwnAndCrumbsNone)
{
  TriangleMesh mesh =
    test::join(bar_of_cubes(8), test::translated(bar_of_cubes(5), Vec3(0.0, 4.0, 0.0)));
  mesh = test::join(mesh, test::sphere(1, 0.05, Vec3(0.0, 0.0, 4.0)));
  CurveSkeleton skeleton;
  TriangleMesh solid;
  const Status status = run_curve_skeleton(mesh, skeleton, solid);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(skeleton.centroids.size(), 2u);
  EXPECT_EQ(status.report.number("counts.left_out_parts", 0.0), 1.0);
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("1 component has no skeleton"));
  const Vec3 expected[] = { Vec3(4.0, 0.5, 0.5), Vec3(2.5, 4.5, 0.5) };
  for (Index v = 0; v < skeleton.points.rows(); ++v)
  {
    const bool second = skeleton.points(v, 1) > 2.0;
    EXPECT_LT((skeleton.centroids[skeleton.part_of_point[v]] - expected[second]).norm(), 1e-9);
  }
}

TEST_F(CurveSkeletonTest, MovesAndGrowsWithTheShape)
{
  const TriangleMesh mesh = bar_of_cubes(8);
  const CurveSkeleton here = run_curve_skeleton(mesh);
  TriangleMesh moved = mesh;
  moved.points *= 1024.0;
  moved.points.col(1).array() += 4096.0;
  const CurveSkeleton there = run_curve_skeleton(moved);
  EXPECT_NEAR(there.points.col(0).minCoeff(), 1024.0 * here.points.col(0).minCoeff(), 5.0);
  EXPECT_NEAR(there.points.col(0).maxCoeff(), 1024.0 * here.points.col(0).maxCoeff(), 5.0);
  EXPECT_NEAR(there.points.col(1).mean(), 4608.0, 5.0);
}

TEST_F(CurveSkeletonTest, BadInputIsOneSentence)
{
  CurveSkeleton skeleton;
  TriangleMesh solid;
  const auto message = [&](const TriangleMesh& mesh)
  {
    const Status status = run_curve_skeleton(mesh, skeleton, solid);
    EXPECT_EQ(status.code, StatusCode::invalid_input);
    EXPECT_EQ(skeleton.points.rows(), 0);
    EXPECT_EQ(status.message.find('\n'), std::string::npos);
    return status.message;
  };
  EXPECT_THAT(message(TriangleMesh()), HasSubstr("no triangles"));
  TriangleMesh mesh = bar_of_cubes(4);
  mesh.points(3, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message(mesh), HasSubstr("finite"));
  ExecutionContext context;
  CurveSkeletonOptions options;
  options.triangles = 10;
  mesh = bar_of_cubes(4);
  EXPECT_THAT(
    curve_skeleton(context, mesh.points, mesh.triangles, options, skeleton, solid).message,
    HasSubstr("skeleton_triangles"));
}

TEST_F(CurveSkeletonTest, CanBeCanceledWhileItContracts)
{
  const TriangleMesh mesh = test::torus(200, 100, 1.0, 0.3);
  CurveSkeletonOptions options;
  options.triangles = 100000;
  CurveSkeleton skeleton;
  TriangleMesh solid;
  ExecutionContext context;
  test::DelayedCancel canceler(context, 1500);
  const Status status =
    curve_skeleton(context, mesh.points, mesh.triangles, options, skeleton, solid);
  EXPECT_LT(canceler.seconds_since_cancel(), 0.5);
  EXPECT_EQ(status.code, StatusCode::canceled);
}

TEST(CurveSkeleton, WithoutTheHelperItSaysSo)
{
  const Environment none("BINDPOSE_MESHER", "/nowhere/bindpose-mesher");
  CurveSkeleton skeleton;
  TriangleMesh solid;
  const Status status = run_curve_skeleton(bar_of_cubes(4), skeleton, solid);
  EXPECT_EQ(status.code, StatusCode::unavailable);
}
