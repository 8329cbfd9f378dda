// Smoothing of weights along a surface: the known factor for an eigenfunction, a comparison with a
// dense solve, and triangles for which a plain factorization fails.
#include "domain/surface_smoothing.h"

#include "geometry/laplacian.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
Eigen::MatrixXd smoothed(
  const TriangleMesh& mesh, const std::vector<Index>& fixed, double length, Eigen::MatrixXd values)
{
  ExecutionContext context;
  EXPECT_TRUE(smooth_on_surface(context, mesh.points, mesh.triangles, fixed, length, values));
  return values;
}
} // namespace

TEST(SurfaceSmoothing, ScalesAnEigenfunctionOfTheSphere)
{
  // On the unit sphere the Laplacian of z is -2 z, so smoothing with the length s divides z by 1 +
  // 4 s^4.
  const TriangleMesh ball = test::sphere(4);
  const Eigen::MatrixXd z = ball.points.col(2);
  const Eigen::MatrixXd w = smoothed(ball, {}, 0.5, z);
  EXPECT_LT((w - z / 1.25).cwiseAbs().maxCoeff(), 0.01);
}

TEST(SurfaceSmoothing, IsTheMinimizerWithFixedPoints)
{
  TriangleMesh sheet = test::grid(6, 5, 1.2, 1.0);
  sheet.points.col(2) = 0.1 * sheet.points.col(0).array().sin();
  const Index n = sheet.points.rows();
  const std::vector<Index> few{ 0, 17 };
  std::vector<Index> many; // some of these vertices are neighbors
  for (Index v = 0; v < n; v += 1 + v % 3)
  {
    many.push_back(v);
  }
  constexpr double length = 0.3;
  Eigen::MatrixXd given(n, 2);
  for (Index v = 0; v < n; ++v)
  {
    given.row(v) << std::sin(7.0 * v), static_cast<double>(v % 3);
  }
  const Points scaled = sheet.points / length;
  const Eigen::MatrixXd k = stiffness_matrix(scaled, sheet.triangles);
  const Eigen::VectorXd mass = lumped_mass(scaled, sheet.triangles);
  for (const std::vector<Index>& fixed : { few, many })
  {
    SCOPED_TRACE(fixed.size());
    Eigen::MatrixXd a = k * mass.cwiseInverse().asDiagonal() * k;
    a.diagonal() += mass;
    Eigen::MatrixXd b = mass.asDiagonal() * given;
    for (const Index v : fixed)
    {
      a.row(v).setZero();
      a(v, v) = 1.0;
      b.row(v) = given.row(v);
    }
    const Eigen::MatrixXd exact = a.fullPivLu().solve(b);
    EXPECT_LT((smoothed(sheet, fixed, length, given) - exact).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST(SurfaceSmoothing, SurvivesNeedleTriangles)
{
  // Two rows of points are 1e-9 apart, which gives cotangents of 1e9.
  TriangleMesh sheet = test::grid(12, 12, 1.0, 1.0);
  for (Index v = 0; v < sheet.points.rows(); ++v)
  {
    sheet.points(v, 1) = sheet.points(v, 1) > 0.5 ? sheet.points(v, 1) : 1e-9 * sheet.points(v, 1);
  }
  const Eigen::MatrixXd given = sheet.points.col(0).array().round();
  const Eigen::MatrixXd w = smoothed(sheet, {}, 0.2, given);
  ASSERT_TRUE(w.allFinite());
  EXPECT_GT((w - given).norm(), 0.0);
  // The values of a step function may overshoot, but the overshoot is bounded for any triangles.
  EXPECT_GT(w.minCoeff(), -0.5);
  EXPECT_LT(w.maxCoeff(), 1.5);
  const Eigen::MatrixXd constant = Eigen::MatrixXd::Constant(given.rows(), 1, 0.25);
  EXPECT_LT((smoothed(sheet, {}, 0.2, constant) - constant).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(SurfaceSmoothing, TrianglesWithAlmostNoHeightChangeLittle)
{
  // One vertex is almost on the opposite edge of one of its triangles, which gives cotangents of
  // both signs.
  const TriangleMesh sheet = test::grid(12, 12, 1.0, 1.0);
  Eigen::MatrixXd given(sheet.points.rows(), 3);
  given.col(0) = (sheet.points.col(0).array() > 0.5).cast<double>();
  given.col(1) = (1.0 - given.col(0).array()) * (sheet.points.col(1).array() > 0.4).cast<double>();
  given.col(2) = 1.0 - given.col(0).array() - given.col(1).array();
  const Eigen::MatrixXd wanted = smoothed(sheet, {}, 0.1, given);
  for (const double height : { 1e-5, 1e-9, 1e-13, 1e-16 })
  {
    SCOPED_TRACE(height);
    TriangleMesh bad = sheet;
    const auto t = sheet.triangles.row(sheet.triangles.rows() / 2);
    const Vec3 a = sheet.points.row(t[1]), b = sheet.points.row(t[2]);
    const Vec3 away = Vec3(0, 0, 1).cross(b - a).normalized();
    bad.points.row(t[0]) = 0.5 * (a + b) + height * away;
    const Eigen::MatrixXd w = smoothed(bad, {}, 0.1, given);
    EXPECT_LT((w.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-2);
    EXPECT_LT((w - wanted).cwiseAbs().maxCoeff(), 0.2);
  }
}

TEST(SurfaceSmoothing, IsTheSameForAnyNumberOfThreadsAndStopsWhenCanceled)
{
  const TriangleMesh ball = test::sphere(3);
  const Eigen::MatrixXd given = ball.points;
  Eigen::MatrixXd one = given, many = given;
  ExecutionContext single, several;
  single.set_threads(1);
  several.set_threads(4);
  ASSERT_TRUE(smooth_on_surface(single, ball.points, ball.triangles, {}, 0.3, one));
  ASSERT_TRUE(smooth_on_surface(several, ball.points, ball.triangles, {}, 0.3, many));
  EXPECT_TRUE((one.array() == many.array()).all());
  single.request_cancel();
  EXPECT_FALSE(smooth_on_surface(single, ball.points, ball.triangles, {}, 0.3, one));
}
