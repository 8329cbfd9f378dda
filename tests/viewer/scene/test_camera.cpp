// The camera shows all of a shape, as large as can be, from the documented side.
#include "scene/camera.h"
#include "support/meshes.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;

namespace
{
// Normalised device coordinates: the viewport is [-1, 1]^2, what is drawn lies in depth [-1, 1].
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
        const Points seen = project(camera, aspect, points);
        const Eigen::Vector2d upper = seen.leftCols<2>().colwise().maxCoeff();
        const Eigen::Vector2d lower = seen.leftCols<2>().colwise().minCoeff();
        // In one direction both margins are met exactly; in the other the shape is within.
        const double tightest = std::max(upper[0] - lower[0], upper[1] - lower[1]);
        EXPECT_NEAR(tightest, 1.8, 1e-6);
        EXPECT_LE(upper.maxCoeff(), 0.9 + 1e-6);
        EXPECT_GE(lower.minCoeff(), -0.9 - 1e-6);
        EXPECT_LT(seen.col(2).cwiseAbs().maxCoeff(), 1.0) << "clipped";
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
  // y up; wide in x: from +z; wide in z: from +x; never from below.
  EXPECT_GT(direction(Vec3(3, 2, 1), "auto")[2], 0.8);
  EXPECT_GT(direction(Vec3(1, 2, 3), "auto")[0], 0.8);
  EXPECT_GT(direction(Vec3(3, 2, 1), "auto")[1], 0.2);
  // z up: from -y, or from +x for what is long in y.
  EXPECT_LT(direction(Vec3(3, 1, 2), "z")[1], -0.8);
  EXPECT_GT(direction(Vec3(1, 3, 2), "z")[0], 0.8);
  EXPECT_GT(direction(Vec3(3, 1, 2), "z")[2], 0.2);
  // Flat shapes straight from the front.
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

  const Points one = random_points(1, Vec3(5, 5, 5), Vec3(6, 6, 6));
  fit_camera(camera, one, choose_frame(bounding_box(one), "auto"), View(), 1.0);
  EXPECT_LT(project(camera, 1.0, one).cwiseAbs().maxCoeff(), 1.0);
}
