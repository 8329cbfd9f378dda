// Pictures of surfaces, weights, slices, handles, tiles and legends. Each test also asserts numbers
// that do not depend on the baseline.
#include "render/drawing.h"
#include "render/harness.h"
#include "render/shapes.h"

#include "conversion.h"
#include "scene/colors.h"
#include "support/meshes.h"

#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;
using namespace bindpose::test;

TEST(Render, surface)
{
  const auto surface = sphere_and_cube();
  const Drawing drawing = draw({ { surface, nullptr, "" } }, small_picture());
  // The rectangle of the painted pixels equals the rectangle of the projected vertices.
  // Horizontally, this rectangle fills the picture up to the margin.
  Eigen::AlignedBox2d expected;
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v)
  {
    expected.extend(drawing.geometry.project(0, Vec3(surface->GetPoint(v))));
  }
  const Eigen::AlignedBox2d painted =
    drawing.extent([](const Pixel& p) { return !is_background(p); });
  EXPECT_LT((painted.min() - expected.min()).cwiseAbs().maxCoeff(), 1.5);
  EXPECT_LT((painted.max() - expected.max()).cwiseAbs().maxCoeff(), 1.5);
  EXPECT_NEAR(expected.min().x(), 0.04 * 400, 0.01);
  EXPECT_NEAR(expected.max().x(), 0.96 * 400, 0.01);
  // A face of the cube is flat, so it has a single shade.
  const Pixel side = drawing.at(Vec3(1.0, 0.3, 0.8));
  for (const Vec3& p : { Vec3(0.7, -0.4, 0.8), Vec3(1.6, 0.5, 0.8) })
  {
    EXPECT_NEAR(lightness(drawing.at(p)), lightness(side), 12.0);
  }
  // The top is lighter than the front because the key light is above.
  EXPECT_GT(lightness(drawing.at(Vec3(1.2, 0.8, 0.0))), lightness(side) + 5.0);
  expect_baseline(drawing.image);
}

TEST(Render, weights)
{
  const auto surface = finger();
  PictureOptions options = small_picture();
  options.array = "Weights";
  options.component = "right";
  const Drawing drawing = draw({ { surface, nullptr, "" } }, options);
  // Along the ridge that faces the camera, each band is darker than the previous one.
  std::vector<double> bands;
  for (int band = 0; band < 10; ++band)
  {
    const double x = -2.0 + 4.0 * (band + 0.5) / 10.0;
    const double section_radius = std::sqrt(std::max(0.0, 1.0 - x * x / 4.0));
    bands.push_back(lightness(drawing.at(
      Vec3(x, 0.2 * section_radius + 0.5 * std::cos(0.8 * x), 0.7 * section_radius * 0.968))));
  }
  for (int band = 1; band < 9; ++band)
  {
    EXPECT_LT(bands[band + 1], bands[band]) << "band " << band + 1;
  }
  // The other component has the mirrored colors: it is light where the first component is dark.
  options.component = "0";
  const Drawing other = draw({ { surface, nullptr, "" } }, options);
  const Vec3 right_end(1.8, 0.1, 0.25);
  EXPECT_GT(lightness(other.at(right_end)), lightness(drawing.at(right_end)) + 60.0);
  // The nine isolines are dark closed curves of some hundred pixels each.
  options.component = "right";
  options.isolines = false;
  const Drawing without_isolines = draw({ { surface, nullptr, "" } }, options);
  long long darker = 0;
  for (int y = 0; y < 300; ++y)
  {
    for (int x = 0; x < 400; ++x)
    {
      darker += lightness(pixel_at(drawing.image, x, y)) <
        lightness(pixel_at(without_isolines.image, x, y)) - 20.0;
    }
  }
  EXPECT_GT(darker, 500);
  EXPECT_LT(darker, 4000);
  expect_baseline(drawing.image);
}

TEST(Render, winding_slice)
{
  PictureOptions options = small_picture();
  const Drawing drawing = draw({ { three_spheres(), nullptr, "" } }, options);
  // The slice is half a sample away from z = 0. Where nothing is in front of the slice, its pixels
  // have exactly the colors of the color map.
  EXPECT_LT(distance(drawing.at(Vec3(-1.8, 1.2, 0.0)), winding_color(0.0)), 3.0);
  const Vec3 overlap = 0.5 * (sphere_centers[0] + sphere_centers[1]);
  const Pixel winding_one = drawing.at(sphere_centers[0] - Vec3(0.25, 0, 0));
  const Pixel winding_two = drawing.at(overlap);
  const Pixel winding_minus_one = drawing.at(sphere_centers[2]);
  // This point is behind the translucent isosurface.
  EXPECT_LT(distance(winding_one, winding_color(1.0)), 60.0);
  EXPECT_GT(winding_one.r, winding_one.b + 50) << "inside is orange";
  EXPECT_LT(lightness(winding_two), lightness(winding_one) - 60.0) << "twice inside is darker";
  EXPECT_LT(lightness(winding_minus_one), lightness(winding_one) - 60.0) << "inside out is dark";
  EXPECT_LT(distance(winding_minus_one, winding_color(-1.0)), 3.0) << "and has no glass before it";
  expect_baseline(drawing.image);
}

TEST(Render, tets_cut)
{
  PictureOptions options = small_picture();
  const Drawing cut = draw({ { tet_brick(), nullptr, "" } }, options);
  const auto is_cut = [](const Pixel& p) { return p.b > p.r + 20; };
  // The cut face is about as large as the rectangle 1.6 x 1.0 at z = 0.6, a cross section of the
  // box. Compare its number of pixels with the projected area of this rectangle.
  const Eigen::Vector2d a = cut.geometry.project(0, Vec3(0, 0, 0.6));
  const Eigen::Vector2d b = cut.geometry.project(0, Vec3(1.6, 0, 0.6));
  const Eigen::Vector2d c = cut.geometry.project(0, Vec3(0, 1, 0.6));
  const double area = std::abs((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
  EXPECT_NEAR(static_cast<double>(cut.count(is_cut)), area, 0.25 * area);
  options.cut = false;
  const Drawing whole = draw({ { tet_brick(), nullptr, "" } }, options);
  EXPECT_EQ(whole.count(is_cut), 0);
  EXPECT_GT(whole.count([](const Pixel& p) { return !is_background(p); }),
    cut.count([](const Pixel& p) { return !is_background(p); }));
  expect_baseline(cut.image);
}

TEST(Render, handles)
{
  // The handles are inside of a sphere. They must be visible.
  PictureOptions options = small_picture();
  const TriangleMesh ball = sphere(4, 1.8);
  const Drawing drawing =
    draw({ { to_polydata(ball.points, ball.triangles), handle_row(), "" } }, options);
  const Pixel full = drawing.at(Vec3(-1.0, -0.4, 0.0));
  const Pixel position = drawing.at(Vec3(0.0, -0.4, 0.0));
  const Pixel free = drawing.at(Vec3(1.0, -0.4, 0.0));
  EXPECT_GT(full.r, full.b + 80) << "full: orange";
  EXPECT_GT(position.b, position.r + 80) << "position: blue";
  EXPECT_LT(std::abs(free.r - free.b), 20) << "free: gray";
  const Pixel bone = drawing.at(Vec3(0.0, 0.5, 0.0));
  EXPECT_GT(bone.r, bone.b + 60) << "bone: orange";
  expect_baseline(drawing.image);
}

TEST(Render, tiles)
{
  PictureOptions options = small_picture();
  options.columns = 2;
  const auto surface = finger();
  const auto other = sphere_and_cube();
  const Drawing drawing = draw({ { surface, nullptr, "" }, { other, nullptr, "" },
                                 { other, nullptr, "" }, { surface, nullptr, "" } },
    options);
  // All tiles share one camera, so equal datasets look equal in all tiles.
  long long differing = 0;
  for (int y = 0; y < 150; ++y)
  {
    for (int x = 0; x < 200; ++x)
    {
      const Pixel first = pixel_at(drawing.image, x, y + 150);
      const Pixel last = pixel_at(drawing.image, x + 200, y);
      differing += std::abs(first.r - last.r) > channel_tolerance;
    }
  }
  EXPECT_LE(differing, allowed_pixels());
  EXPECT_EQ(drawing.geometry.tiles.size(), 4u);
  EXPECT_EQ(drawing.geometry.tiles[1].x, 200);
  EXPECT_EQ(drawing.geometry.tiles[1].y, 150);
  expect_baseline(drawing.image);
}

TEST(Render, transparent)
{
  PictureOptions options = small_picture();
  options.background = Background::transparent;
  const Drawing drawing = draw({ { finger(), nullptr, "" } }, options);
  ASSERT_EQ(drawing.image->GetNumberOfScalarComponents(), 4);
  const auto clear = drawing.count([](const Pixel& p) { return p.a == 0; });
  const auto solid = drawing.count([](const Pixel& p) { return p.a == 255; });
  EXPECT_EQ(pixel_at(drawing.image, 0, 0).a, 0);
  EXPECT_EQ(drawing.at(Vec3(0, 0.5, 0.7)).a, 255);
  // The remaining pixels are partly transparent. They are the silhouette, which is a thin line.
  EXPECT_GT(400 * 300 - clear - solid, 200);
  EXPECT_LT(400 * 300 - clear - solid, 2500);
  // If the picture is composited on white, it equals the picture that is drawn on white: colors are
  // not darkened at the silhouette.
  options.background = Background::white;
  const Drawing white = draw({ { finger(), nullptr, "" } }, options);
  long long differing = 0;
  for (int y = 0; y < 300; ++y)
  {
    for (int x = 0; x < 400; ++x)
    {
      const Pixel p = pixel_at(drawing.image, x, y);
      const Pixel q = pixel_at(white.image, x, y);
      differing += std::abs((p.r * p.a + 255 * (255 - p.a)) / 255 - q.r) > channel_tolerance;
    }
  }
  EXPECT_LE(differing, allowed_pixels());
  expect_baseline(drawing.image);
}

TEST(Render, legend)
{
  PictureOptions options = small_picture();
  options.array = "Weights";
  options.component = "right";
  options.legend = true;
  options.title = "Bounded biharmonic weights";
  const Drawing drawing =
    draw({ { finger(), nullptr, "rest" }, { finger(), nullptr, "posed" } }, options);
  // The legend is drawn without lighting, so all its ten colors occur unchanged.
  for (int band = 0; band < 10; ++band)
  {
    const Rgb color = sequential_color(band / 9.0);
    EXPECT_GT(drawing.count([&](const Pixel& p) { return distance(p, color) <= 2.0; }), 60)
      << "band " << band;
  }
  // The top rows of pixels contain the dark letters of the title. The upper corners of the picture
  // are background.
  EXPECT_TRUE(is_background(pixel_at(drawing.image, 2, 297)));
  EXPECT_TRUE(is_background(pixel_at(drawing.image, 397, 297)));
  long long dark = 0;
  for (int y = 270; y < 300; ++y)
  {
    for (int x = 0; x < 400; ++x)
    {
      dark += lightness(pixel_at(drawing.image, x, y)) < 100.0;
    }
  }
  EXPECT_GT(dark, 300);
  expect_baseline(drawing.image);
}
