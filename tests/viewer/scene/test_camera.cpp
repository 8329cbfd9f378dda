// The camera shows the whole shape, as large as possible, from the direction that the documentation
// defines.
#include "scene/camera.h"
#include "support/meshes.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
// Return normalized device coordinates. The viewport is [-1, 1]^2, and visible points have a depth
// in [-1, 1].
Points project(vtkCamera* camera, double aspect, const Points& points)
{
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(
    camera->GetCompositeProjectionTransformMatrix(aspect, -1.0, 1.0)->GetData());
  Points result(points.rows(), 3);
  for (Index i = 0; i < points.rows(); ++i)
  {
    result.row(i) = (matrix * points.row(i).transpose().homogeneous()).hnormalized().transpose();
  }
  return result;
}

Points random_points(Index count, const Vec3& lower, const Vec3& upper)
{
  test::Random random(7);
  Points points(count, 3);
  for (Index i = 0; i < count; ++i)
  {
    points.row(i) = random.in_box(lower, upper).transpose();
  }
  return points;
}

Eigen::Matrix3d rotation_matrix(double degrees, const Vec3& axis)
{
  return Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, axis.normalized()).toRotationMatrix();
}

const Eigen::Matrix3d tilted = rotation_matrix(35.0, Vec3(1.0, 0.4, 0.2));
} // namespace

TEST(Camera, FitsTightlyFromEverywhereWithoutClipping)
{
  for (const double size : { 1e-6, 1.0, 1e5 })
  {
    const Points points = size * random_points(200, Vec3(-1.0, -3.0, 10.0), Vec3(2.0, 1.0, 11.0));
    for (const double azimuth : { -150.0, -28.0, 0.0, 60.0 })
    {
      for (const double aspect : { 0.5, 1.0, 2.0 })
      {
        View view;
        view.azimuth = azimuth;
        view.elevation = 0.3 * azimuth;
        vtkNew<vtkCamera> camera;
        fit_camera(camera, points, choose_frame(bounding_box(points), "auto"), view, aspect, 0.05);
        const Points projected = project(camera, aspect, points);
        const Eigen::Vector2d upper = projected.leftCols<2>().colwise().maxCoeff();
        const Eigen::Vector2d lower = projected.leftCols<2>().colwise().minCoeff();
        // In one direction both margins have exactly the requested size. In the other direction
        // they are at least this large.
        const double tightest = std::max(upper[0] - lower[0], upper[1] - lower[1]);
        EXPECT_NEAR(tightest, 1.8, 1e-6);
        EXPECT_LE(upper.maxCoeff(), 0.9 + 1e-6);
        EXPECT_GE(lower.minCoeff(), -0.9 - 1e-6);
        EXPECT_LT(projected.col(2).cwiseAbs().maxCoeff(), 1.0) << "clipped";
      }
    }
  }
}

TEST(Camera, LooksAtTheBroadSide)
{
  const auto direction = [](const Vec3& size, const std::string& up)
  {
    Box box;
    box.add(Vec3::Zero());
    box.add(size);
    return view_direction(choose_frame(box, up), View());
  };
  // If y is up, shapes that are wide in x are viewed from +z, and shapes that are wide in z are
  // viewed from +x. The camera is always a little above the shape.
  EXPECT_GT(direction(Vec3(3, 2, 1), "auto")[2], 0.8);
  EXPECT_GT(direction(Vec3(1, 2, 3), "auto")[0], 0.8);
  EXPECT_GT(direction(Vec3(3, 2, 1), "auto")[1], 0.2);
  // If z is up, shapes are viewed from -y, or from +x if they are long in y.
  EXPECT_LT(direction(Vec3(3, 1, 2), "z")[1], -0.8);
  EXPECT_GT(direction(Vec3(1, 3, 2), "z")[0], 0.8);
  EXPECT_GT(direction(Vec3(3, 1, 2), "z")[2], 0.2);
  // Flat shapes are viewed perpendicularly.
  EXPECT_NEAR(direction(Vec3(3, 2, 0), "auto")[2], 1.0, 1e-12);
  EXPECT_NEAR(direction(Vec3(3, 0, 2), "auto")[1], -1.0, 1e-12);
  EXPECT_NEAR(direction(Vec3(0, 3, 2), "auto")[0], 1.0, 1e-12);
}

TEST(Camera, ZoomEnlargesAndAPointIsNoTrouble)
{
  const Points points = random_points(50, Vec3(-1, -1, -0.01), Vec3(1, 1, 0.01));
  const Frame frame = choose_frame(bounding_box(points), "auto");
  vtkNew<vtkCamera> camera;
  View view;
  fit_camera(camera, points, frame, view, 1.0);
  const double width = project(camera, 1.0, points).col(0).maxCoeff();
  view.zoom = 2.0;
  fit_camera(camera, points, frame, view, 1.0);
  EXPECT_NEAR(project(camera, 1.0, points).col(0).maxCoeff() / width, 2.0, 1e-9);

  const Points single_point = random_points(1, Vec3(5, 5, 5), Vec3(6, 6, 6));
  fit_camera(camera, single_point, choose_frame(bounding_box(single_point), "auto"), View(), 1.0);
  EXPECT_LT(project(camera, 1.0, single_point).cwiseAbs().maxCoeff(), 1.0);
}

TEST(Camera, AnotherShapeOfTheViewKeepsAllInItFromTheSameSide)
{
  const Points points = random_points(200, Vec3(-1.0, -3.0, 10.0), Vec3(2.0, 1.0, 11.0));
  const Frame frame = choose_frame(bounding_box(points), "auto");
  for (const bool parallel : { false, true })
  {
    for (const double old_aspect : { 0.6, 1.0, 2.0 })
    {
      for (const double new_aspect : { 0.5, 1.0, 1.9 })
      {
        View view;
        view.azimuth = 20.0;
        vtkNew<vtkCamera> camera;
        fit_camera(camera, points, frame, view, old_aspect, 0.1);
        if (parallel)
        {
          camera->ParallelProjectionOn();
          camera->SetParallelScale(
            camera->GetDistance() * std::tan(0.5 * camera->GetViewAngle() * EIGEN_PI / 180.0));
        }
        const Vec3 sight(camera->GetDirectionOfProjection()), up(camera->GetViewUp());
        const auto extent = [&](double aspect)
        { return project(camera, aspect, points).leftCols<2>().cwiseAbs().maxCoeff(); };
        const double extent_before = extent(old_aspect);
        ASSERT_LE(extent_before, 1.0);
        keep_in_view(camera, points, old_aspect, new_aspect);
        EXPECT_LE(extent(new_aspect), 1.0) << old_aspect << " to " << new_aspect;
        EXPECT_GT(extent(new_aspect), 0.8 * extent_before) << old_aspect << " to " << new_aspect;
        EXPECT_LT((Vec3(camera->GetDirectionOfProjection()) - sight).norm(), 1e-9);
        EXPECT_LT((Vec3(camera->GetViewUp()) - up).norm(), 1e-9);
      }
    }
  }
}

TEST(Camera, WhoLooksAtAPartGoesOnLookingAtIt)
{
  const Points points = test::sphere(3).points;
  vtkNew<vtkCamera> camera;
  fit_camera(camera, points, choose_frame(bounding_box(points), "auto"), View(), 2.0);
  const Vec3 focus(0.2, 0.3, 0.4);
  camera->SetFocalPoint(focus.data());
  // This camera position is within the extent of the shape.
  camera->SetPosition(Vec3(focus + Vec3(0.5, -0.6, 0.3)).data());
  keep_in_view(camera, points, 2.0, 1.0);
  EXPECT_EQ(Vec3(camera->GetFocalPoint()), focus);
  EXPECT_GT(project(camera, 1.0, points).leftCols<2>().cwiseAbs().maxCoeff(), 1.0);
  // If the aspect ratio does not change, or if the shape is empty, the camera does not change.
  const Vec3 position(camera->GetPosition());
  keep_in_view(camera, points, 1.0, 1.0);
  keep_in_view(camera, Points(0, 3), 1.0, 2.0);
  EXPECT_EQ(Vec3(camera->GetPosition()), position);
}

TEST(Plane, IsFoundWhateverItIs)
{
  const Points square = test::grid(5, 5).points;
  Vec3 normal;
  ASSERT_TRUE(find_plane(square, normal));
  EXPECT_EQ(normal, Vec3(0, 0, 1));
  ASSERT_TRUE(
    find_plane(Points(square * rotation_matrix(180.0, Vec3::UnitX()).transpose()), normal));
  EXPECT_LT((normal - Vec3(0, 0, 1)).norm(), 1e-9) << "looked at from +z, whichever way it faces";
  ASSERT_TRUE(
    find_plane(Points(square * rotation_matrix(90.0, Vec3::UnitY()).transpose()), normal));
  EXPECT_LT((normal - Vec3(1, 0, 0)).norm(), 1e-9);
  ASSERT_TRUE(
    find_plane(Points(square * rotation_matrix(90.0, Vec3::UnitX()).transpose()), normal));
  EXPECT_LT((normal - Vec3(0, -1, 0)).norm(), 1e-9);
  ASSERT_TRUE(find_plane(Points(square * tilted.transpose()), normal));
  EXPECT_LT((normal - tilted.col(2)).norm(), 1e-9);
  Points lopsided = square; // after tilting, the center of the bounding box is not in the plane
  lopsided.col(1) += square.col(0).cwiseAbs2();
  ASSERT_TRUE(find_plane(Points(lopsided * tilted.transpose()), normal));
  EXPECT_LT((normal - tilted.col(2)).norm(), 1e-9);
  // Planar points that were rounded to single precision, as in files, count as planar. Solid shapes
  // and lines do not.
  const Points rounded = Points(1e4 * square * tilted.transpose()).cast<float>().cast<double>();
  EXPECT_TRUE(find_plane(rounded, normal));
  EXPECT_FALSE(find_plane(test::sphere(2).points, normal));
  Points bent = square;
  bent(7, 2) = 1e-4;
  EXPECT_FALSE(find_plane(bent, normal));
  EXPECT_FALSE(find_plane(Points(square.col(0) * Eigen::RowVector3d(1, 2, 3)), normal));
}
