// Pictures of isosurfaces, clouds (volume renderings) and boundary curves. Each test also asserts
// numbers that do not depend on the baseline.
#include "render/drawing.h"
#include "render/shapes.h"

#include "conversion.h"
#include "support/meshes.h"

#include "vtkImageData.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
/// Return the bounding rectangle, in pixels, of a sphere around the origin in the picture.
Eigen::AlignedBox2d sphere_on_paper(const Drawing& drawing, double radius)
{
  const TriangleMesh ball = sphere(5, radius);
  Eigen::AlignedBox2d box;
  for (Index v = 0; v < ball.points.rows(); ++v)
  {
    box.extend(drawing.geometry.project(0, ball.points.row(v).transpose()));
  }
  return box;
}

bool is_painted(const Pixel& p)
{
  return !is_background(p);
}

bool is_green(const Pixel& p)
{
  return p.g > p.r + 40 && p.g > p.b + 10;
}
} // namespace

TEST(Render, isosurface)
{
  PictureOptions options = small_picture();
  options.isosurfaces = { 0.75 };
  const Drawing drawing = draw({ { cone_field(), nullptr, "" } }, options);
  // The isosurface has the size of the analytic sphere, within one pixel.
  const Eigen::AlignedBox2d expected = sphere_on_paper(drawing, 0.75);
  const Eigen::AlignedBox2d painted_box = drawing.extent(is_painted);
  EXPECT_LT((painted_box.min() - expected.min()).cwiseAbs().maxCoeff(), 1.0);
  EXPECT_LT((painted_box.max() - expected.max()).cwiseAbs().maxCoeff(), 1.0);
  // The isosurface is lit: its upper side is lighter. It is smooth: the lightness of neighboring
  // pixels along the middle differs little.
  EXPECT_GT(lightness(drawing.at(Vec3(0, 0.65, 0.3))), lightness(drawing.at(Vec3(0, -0.65, 0.3))));
  const int row = static_cast<int>(expected.center().y());
  for (int x = static_cast<int>(expected.min().x()) + 12; x < expected.max().x() - 12; ++x)
  {
    EXPECT_NEAR(lightness(pixel_at(drawing.image, x, row)),
      lightness(pixel_at(drawing.image, x + 1, row)), 6.0)
      << x;
  }
  // The isosurface has the hue of its level, which is orange.
  const Pixel middle = drawing.at(Vec3(0, 0, 0.75));
  EXPECT_GT(middle.r, middle.b + 30);
  // Another level gives another picture, although the camera fits its view to each isosurface.
  options.isosurfaces = { 0.25 };
  const Drawing other = draw({ { cone_field(), nullptr, "" } }, options);
  const Pixel blue = other.at(Vec3(0, 0, 1.25));
  EXPECT_GT(blue.b, blue.r + 10);
  EXPECT_FALSE(passes(compare(drawing.image, other.image)));
  expect_baseline(drawing.image);
}

TEST(Render, isosurfaces_nested)
{
  PictureOptions options = small_picture();
  options.isosurfaces = { 0.75, 0.25, 0.25, 0.9 };
  options.legend = true;
  const Drawing drawing = draw({ { cone_field(), nullptr, "" } }, options);
  // The legend has one field per level. Each field has the color of its level, and the fields of
  // higher levels are higher.
  const ColorMap map = winding_map();
  double previous_height = 0.0;
  for (const double level : { 0.25, 0.75, 0.9 })
  {
    const auto field = [&](const Pixel& p) { return distance(p, color_of(map, level)) <= 1.0; };
    EXPECT_GT(drawing.count(field), 60) << level;
    const double height = drawing.extent(field).center().y();
    EXPECT_GT(height, previous_height) << level;
    previous_height = height;
  }
  // The inner isosurfaces are visible through the outer ones. The innermost isosurface is opaque,
  // so the color at its middle does not depend on anything behind it.
  const auto rim = [&](double radius)
  { return lightness(drawing.at(radius * Vec3(-0.88, 0.0, 0.47).normalized())); };
  EXPECT_LT(rim(0.7), rim(1.2)) << "the inner sphere lies under glass, the outer on paper";
  const Pixel middle = drawing.at(Vec3(0, 0, 0.6));
  EXPECT_GT(middle.r, middle.b + 20);
  // Change one level by 0.03; the comparison must fail.
  options.isosurfaces = { 0.75, 0.25, 0.87 };
  const Difference moved =
    compare(drawing.image, draw({ { cone_field(), nullptr, "" } }, options).image);
  EXPECT_GT(moved.pixels, 10 * allowed_pixels());
  expect_baseline(drawing.image);
}

TEST(Render, winding_cloud)
{
  PictureOptions options = small_picture();
  options.volume = true;
  const auto volume = three_spheres();
  const Drawing drawing = draw({ { volume, nullptr, "" } }, options);
  // The cloud is transparent where the winding number is 0: between the spheres and outside of
  // their outlines.
  EXPECT_TRUE(is_background(drawing.at(Vec3(1.0, 0.9, 0.0))));
  EXPECT_TRUE(is_background(drawing.at(Vec3(-0.3, 1.1, 0.0))));
  const double radius = (drawing.geometry.project(0, Vec3(-0.8, sphere_radius, 0)) -
    drawing.geometry.project(0, Vec3(-0.8, 0, 0)))
                          .norm();
  const double lens_and_discs = 3.0 * 3.14159265 * radius * radius;
  const auto covered = static_cast<double>(drawing.count(is_painted));
  EXPECT_LT(covered, 1.25 * lens_and_discs);
  EXPECT_GT(covered, 0.75 * lens_and_discs);
  // Winding number 1 is pale orange, 2 is deep orange, and -1 is violet.
  const Pixel winding_one = drawing.at(sphere_centers[0] - Vec3(0.3, 0, 0));
  const Pixel winding_two = drawing.at(0.5 * (sphere_centers[0] + sphere_centers[1]));
  const Pixel winding_minus_one = drawing.at(sphere_centers[2]);
  EXPECT_GT(winding_one.r, winding_one.b + 8);
  EXPECT_GT(lightness(winding_one), 150.0);
  EXPECT_LT(lightness(winding_two), lightness(winding_one) - 60.0);
  EXPECT_GT(winding_two.r, winding_two.b + 20);
  EXPECT_GT(winding_minus_one.b, winding_minus_one.r + 20);
  // Rotate the camera by one degree; the comparison must fail.
  options.view.azimuth = 1.0;
  const Difference turned =
    compare(drawing.image, draw({ { volume, nullptr, "" } }, options).image);
  EXPECT_GT(turned.pixels, 10 * allowed_pixels());
  expect_baseline(drawing.image);
}

TEST(Render, boundary_curves)
{
  PictureOptions options = small_picture();
  options.isosurfaces = { 0.75 };
  const TriangleMesh ball = sphere(4, 1.1);
  Tile tile{ cone_field(), nullptr, "" };
  tile.context = { to_polydata(ball.points, ball.triangles), two_circles() };
  const Drawing drawing = draw({ tile }, options);
  // The curves are drawn at their projected positions. They are opaque in front, and faint where
  // the isosurface covers them.
  Tile tile_without_curves = tile;
  tile_without_curves.context.pop_back();
  const Drawing without_curves = draw({ tile_without_curves }, options);
  const Vec3 toward_camera(0.45, 0.28, 0.85);
  for (int i = 0; i < 24; ++i)
  {
    const double angle = 2.0 * 3.14159265358979 * i / 24;
    for (const double y : { -0.5, 0.5 })
    {
      const Vec3 position(std::cos(angle), y, std::sin(angle));
      const Pixel with_curve = drawing.at(position);
      EXPECT_LT(with_curve.r, without_curves.at(position).r - 20) << i << " at " << y;
      if (Vec3(position.x(), 0.0, position.z()).dot(toward_camera) > 0.0)
      {
        EXPECT_TRUE(is_green(with_curve)) << i << " at " << y;
      }
    }
  }
  // A curve of multiplicity 2 is drawn wider than one of multiplicity 1.
  const auto width = [&](double y)
  {
    const Eigen::Vector2d at = drawing.geometry.project(0, Vec3(0, y, 1));
    int count = 0;
    for (int row = static_cast<int>(at.y()) - 8; row <= static_cast<int>(at.y()) + 8; ++row)
    {
      count += is_green(pixel_at(drawing.image, at.x(), row));
    }
    return count;
  };
  EXPECT_GE(width(-0.5), 2);
  EXPECT_GT(width(0.5), width(-0.5));
  // The surface is translucent, so the orange of the isosurface is visible.
  const Pixel middle = drawing.at(Vec3(0, 0, 1.1));
  EXPECT_GT(middle.r, middle.b + 20);
  expect_baseline(drawing.image);
}
