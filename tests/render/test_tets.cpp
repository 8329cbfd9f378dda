// Pictures of tets and of surface defects. Each test also asserts numbers that do not depend on the
// baseline.
#include "render/drawing.h"
#include "render/harness.h"
#include "render/shapes.h"

#include "conversion.h"
#include "scene/categories.h"
#include "scene/colors.h"
#include "support/meshes.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkPolyData.h"
#include "vtkSurfaceDefects.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
long long painted_pixels(const Drawing& drawing)
{
  return drawing.count([](const Pixel& p) { return !is_background(p); });
}
} // namespace

TEST(Render, tets_shrunk)
{
  PictureOptions options = small_picture();
  options.section_plane = Plane{ Vec3(0, 0, 0.6), Vec3(0, 0, 2) };
  const Drawing whole = draw({ { tet_brick(), nullptr, "" } }, options);
  options.shrink = 0.5;
  const Drawing drawing = draw({ { tet_brick(), nullptr, "" } }, options);
  // Nothing is drawn outside of the pixels that the unshrunk tets cover, and the gaps between the
  // tets show the background.
  long long gaps = 0;
  for (int y = 0; y < 300; ++y)
  {
    for (int x = 0; x < 400; ++x)
    {
      const bool before = !is_background(pixel_at(whole.image, x, y));
      const bool after = !is_background(pixel_at(drawing.image, x, y));
      EXPECT_FALSE(after && !before) << x << " " << y;
      gaps += before && !after;
    }
  }
  EXPECT_GT(gaps, painted_pixels(whole) / 50);
  // If the tets are smaller, fewer pixels are covered. At size 1 there are no gaps.
  options.shrink = 0.25;
  EXPECT_LT(painted_pixels(draw({ { tet_brick(), nullptr, "" } }, options)),
    3 * painted_pixels(drawing) / 4);
  options.shrink = 1.0;
  EXPECT_EQ(painted_pixels(draw({ { tet_brick(), nullptr, "" } }, options)), painted_pixels(whole));
  // The part of the box in front of the plane, as seen from the camera, is removed. The direction
  // of the plane's normal has no effect.
  options.section_plane->normal *= -1.0;
  EXPECT_EQ(painted_pixels(draw({ { tet_brick(), nullptr, "" } }, options)), painted_pixels(whole));
  expect_baseline(drawing.image);
}

TEST(Render, tets_labels)
{
  // There are four adjacent blocks, one per label.
  TetMesh mesh = tet_box(8, 4, 4, Vec3::Zero(), Vec3(2, 1, 1));
  const auto grid = to_unstructured_grid(mesh.points, mesh.tets);
  vtkNew<vtkIntArray> labels;
  labels->SetName("Label");
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    double x = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      x += 0.25 * mesh.points(mesh.tets(t, k), 0);
    }
    labels->InsertNextValue(static_cast<int>(std::floor(2.0 * x)) - 1);
  }
  grid->GetCellData()->AddArray(labels);
  PictureOptions options = small_picture();
  options.color_by = ColorBy::label;
  options.cut = false;
  const Drawing drawing = draw({ { grid, nullptr, "" } }, options);
  for (const Category& category : label_categories())
  {
    const Pixel pixel = drawing.at(Vec3(0.25 + 0.5 * (category.value + 1), 0.4, 1.0));
    EXPECT_LT(hue_distance(pixel, category.color), 0.06) << category.name;
  }
  expect_baseline(drawing.image);
}

TEST(Render, tets_quality)
{
  // The smallest dihedral angle of every tet of the subdivided cube is 45 degrees.
  const TetMesh mesh = tet_box(4, 4, 4);
  PictureOptions options = small_picture();
  options.color_by = ColorBy::quality;
  options.cut = false;
  const Drawing drawing =
    draw({ { to_unstructured_grid(mesh.points, mesh.tets), nullptr, "" } }, options);
  const Rgb expected = sequential_color(45.0 / 70.528779);
  for (const Vec3& position : { Vec3(0.31, 0.4, 1.0), Vec3(0.71, 0.83, 1.0), Vec3(1.0, 0.3, 0.6) })
  {
    EXPECT_LT(hue_distance(drawing.at(position), expected), 0.06) << position.transpose();
  }
  expect_baseline(drawing.image);
}

TEST(Render, defects)
{
  const TriangleMesh mesh = join(open_cube(), translated(sphere(2, 0.5), Vec3(-0.2, 0.9, 0.1)));
  const auto surface = to_polydata(mesh.points, mesh.triangles);
  vtkNew<vtkSurfaceDefects> filter;
  filter->SetInputData(surface);
  filter->Update();
  PictureOptions options = small_picture();
  Tile tile{ surface, nullptr, "" };
  tile.defects = vtkPolyData::SafeDownCast(filter->GetOutput());
  const Drawing drawing = draw({ tile }, options);
  const auto& kinds = defect_categories();
  // The first point is on the border of the opening. The second point is on the face y = 1 of the
  // cube, whose two triangles cross the sphere.
  EXPECT_LT(hue_distance(drawing.at(Vec3(0.3, -1.0, 1.0)), kinds[2].color), 0.08);
  EXPECT_LT(hue_distance(drawing.at(Vec3(0.85, 1.0, 0.7)), kinds[7].color), 0.08);
  // Triangles without defects are translucent gray.
  const Pixel gray = drawing.at(Vec3(1.0, 0.0, 0.0));
  EXPECT_LT(std::max({ gray.r, gray.g, gray.b }) - std::min({ gray.r, gray.g, gray.b }), 30);
  expect_baseline(drawing.image);
}
