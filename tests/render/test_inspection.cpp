// Pictures for the inspection of weights: strongest handles, slices, extrema, row sums,
// differences. Each test also asserts numbers that do not depend on the baseline.
#include "render/drawing.h"
#include "render/harness.h"
#include "render/shapes.h"

#include "base/constants.h"
#include "conversion.h"
#include "scene/categories.h"
#include "scene/colors.h"
#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
using Column = std::function<double(const Vec3&)>;

void add_array(vtkDataSet* data, const char* name, const std::vector<Column>& columns)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(columns.size()));
  for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v)
  {
    for (const Column& column : columns)
    {
      array->InsertNextValue(column(Vec3(data->GetPoint(v))));
    }
  }
  data->GetPointData()->AddArray(array);
}

/// Return the unit square in the plane z = 0, divided into 24 x 24 cells.
vtkSmartPointer<vtkPolyData> square()
{
  constexpr Index n = 24;
  Points points((n + 1) * (n + 1), 3);
  Triangles triangles(2 * n * n, 3);
  for (Index y = 0; y <= n; ++y)
  {
    for (Index x = 0; x <= n; ++x)
    {
      points.row(y * (n + 1) + x) << x / double(n), y / double(n), 0.0;
    }
  }
  for (Index y = 0; y < n; ++y)
  {
    for (Index x = 0; x < n; ++x)
    {
      const Index a = y * (n + 1) + x;
      triangles.row(2 * (y * n + x)) << a, a + 1, a + n + 2;
      triangles.row(2 * (y * n + x) + 1) << a, a + n + 2, a + n + 1;
    }
  }
  return to_polydata(points, triangles);
}

/// Return the value at p of a function on the square. The function has five maxima (corners and
/// center) and four minima (midpoints of the sides).
double waves(const Vec3& p)
{
  return std::cos(2.0 * pi * p[0]) * std::cos(2.0 * pi * p[1]);
}

std::vector<Vec3> maxima(double z)
{
  return { { 0, 0, z }, { 1, 0, z }, { 0, 1, z }, { 1, 1, z }, { 0.5, 0.5, z } };
}

std::vector<Vec3> minima(double z)
{
  return { { 0.5, 0, z }, { 0, 0.5, z }, { 1, 0.5, z }, { 0.5, 1, z } };
}

/// Draw the tile and set `report` to its report.
Drawing draw_with_report(const Tile& tile, const PictureOptions& options, Report& report)
{
  Drawing drawing;
  const Status status = render_to_image({ tile }, options, drawing.image, &drawing.geometry);
  EXPECT_TRUE(status.ok()) << status.message;
  report = status.report;
  return drawing;
}

using Counts = std::vector<std::int64_t>;

Counts counts(const Report& report, const std::string& key)
{
  const Report::Value* value = report.find("picture.extrema[]." + key);
  return value ? std::get<Counts>(*value) : Counts();
}
} // namespace

TEST(Render, handles_of_surface)
{
  PictureOptions options = small_picture();
  options.color_by = ColorBy::handle;
  const Drawing drawing = draw({ { finger(), nullptr, "" } }, options);
  // The left half has the color of the first handle, the right half has the color of the second
  // handle.
  const std::vector<Category> handles = handle_categories({ "left", "right" });
  for (const double x : { -1.7, -0.9, -0.2, 0.2, 0.9, 1.7 })
  {
    const double section_radius = std::sqrt(1.0 - x * x / 4.0);
    const Vec3 ridge(
      x, 0.2 * section_radius + 0.5 * std::cos(0.8 * x), 0.7 * section_radius * 0.968);
    EXPECT_LT(hue_distance(drawing.at(ridge), handles[x < 0 ? 0 : 1].color), 0.06) << x;
    EXPECT_GT(hue_distance(drawing.at(ridge), handles[x < 0 ? 1 : 0].color), 0.15) << x;
  }
  expect_baseline(drawing.image);
}

TEST(Render, handles_of_tets)
{
  // There are three handles along x. The middle handle is the strongest one between x = 0.4 and
  // 1.2.
  const auto brick = tet_brick();
  add_array(brick, "Weights",
    { [](const Vec3& p) { return std::max(0.0, 1.0 - p[0] / 0.8); },
      [](const Vec3& p) { return 1.0 - std::abs(p[0] / 0.8 - 1.0); },
      [](const Vec3& p) { return std::max(0.0, p[0] / 0.8 - 1.0); } });
  PictureOptions options = small_picture();
  options.color_by = ColorBy::handle;
  Report report;
  const Drawing drawing = draw_with_report({ brick, nullptr, "" }, options, report);
  const std::vector<Category> handles = handle_categories({ "a", "b", "c" });
  // These points are on the cut face, which faces the camera.
  const double x_values[] = { 0.2, 0.8, 1.4 };
  for (int k = 0; k < 3; ++k)
  {
    // Edges are drawn over the face, so some pixels around a point do not have the color of the
    // handle.
    int close = 0;
    for (int dx = -3; dx <= 3; ++dx)
    {
      for (int dy = -3; dy <= 3; ++dy)
      {
        const Vec3 position(x_values[k] + 0.02 * dx, 0.5 + 0.02 * dy, 0.6);
        close += hue_distance(drawing.at(position), handles[k].color) < 0.06;
      }
    }
    EXPECT_GT(close, 30) << k;
  }
  const Counts cells = std::get<Counts>(*report.find("picture.colors[].count"));
  EXPECT_EQ(cells[0] + cells[1] + cells[2], brick->GetNumberOfCells());
  EXPECT_EQ(cells[0], cells[2]) << "the brick and its weights are symmetric";
  expect_baseline(drawing.image);
}

TEST(Render, tets_slice)
{
  // The first weight is linear along x, so its value is known at every point of the plane.
  const TetMesh mesh = tet_box(20, 12, 12, Vec3::Zero(), Vec3(2, 1, 1));
  const auto box = to_unstructured_grid(mesh.points, mesh.tets);
  const Column left = [](const Vec3& p) { return 1.0 - 0.5 * p[0]; };
  add_array(box, "Weights", { left, [&](const Vec3& p) { return 1.0 - left(p); } });
  PictureOptions options = small_picture();
  options.array = "Weights";
  options.component = "0";
  options.slice = true;
  // The oblique plane passes through tets. It is not parallel to any of their facets.
  const Plane plane{ Vec3(1.0, 0.5, 0.52), Vec3(0.13, 0.31, 1.0) };
  options.section_plane = plane;
  options.view.azimuth = 25.0;
  options.view.elevation = 25.0;
  Report report;
  const Drawing drawing = draw_with_report({ box, nullptr, "" }, options, report);
  const ColorMap map = weight_map();
  const auto on_plane = [&](double x, double y)
  {
    const Vec3& n = plane.normal;
    const double z =
      plane.origin[2] - ((x - plane.origin[0]) * n[0] + (y - plane.origin[1]) * n[1]) / n[2];
    return Vec3(x, y, z);
  };
  const auto lightness_at = [&](double x, double y)
  { return lightness(drawing.at(on_plane(x, y))); };
  for (const double y : { 0.15, 0.5, 0.85 })
  {
    for (int band = 0; band < 10; ++band)
    {
      // Inside of a band, the slice has exactly one color of the legend, which does not depend on
      // the lighting.
      for (const double within : { 0.2, 0.5, 0.8 })
      {
        const double x = 0.2 * (band + within);
        EXPECT_LE(distance(drawing.at(on_plane(x, y)), color_of(map, left(Vec3(x, y, 0)))), 2.0)
          << x << " " << y;
      }
      // A dark line separates neighboring bands. The first bands are skipped, because they are as
      // dark as the lines.
      const double x = 0.2 * band;
      if (band > 2)
      {
        const double line = lightness_at(x, y);
        EXPECT_LT(line, lightness_at(x - 0.05, y) - 10) << x << " " << y;
        EXPECT_LT(line, lightness_at(x + 0.05, y) - 10) << x << " " << y;
      }
    }
  }
  // The tets in front of the plane are removed. The background is therefore visible at the first
  // point, which is near the lower edge of the box's front face. The second point is on the slice.
  EXPECT_TRUE(is_background(drawing.at(Vec3(1.0, 0.02, 0.98))));
  EXPECT_FALSE(is_background(drawing.at(on_plane(1.0, 0.02))));
  // The slice contains exactly the tets with vertices on both sides of the plane.
  Index expected_tets = 0;
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    int corners_in_front = 0;
    for (int k = 0; k < 4; ++k)
    {
      const Vec3 corner = mesh.points.row(mesh.tets(t, k));
      corners_in_front += (corner - plane.origin).dot(plane.normal) >= 0.0;
    }
    expected_tets += corners_in_front > 0 && corners_in_front < 4;
  }
  EXPECT_EQ(report.number("picture.tets", 0), expected_tets);
  // Without isolines no band has a dark border.
  options.isolines = false;
  const Drawing without_isolines = draw({ { box, nullptr, "" } }, options);
  EXPECT_LE(
    distance(without_isolines.at(on_plane(0.21, 0.5)), color_of(map, left(Vec3(0.21, 0.5, 0)))),
    2.0);
  EXPECT_GT(lightness(without_isolines.at(on_plane(0.8, 0.5))), lightness_at(0.8, 0.5) + 10);
  expect_baseline(drawing.image);
}

TEST(Render, tets_slice_by_handle)
{
  // For values per tet, the slice shows every tet in the color of its strongest handle.
  const auto brick = tet_brick();
  PictureOptions options = small_picture();
  options.color_by = ColorBy::handle;
  options.slice = true;
  options.section_plane = Plane{ Vec3(0, 0, 0.71), Vec3::UnitZ() };
  const Drawing drawing = draw({ { brick, nullptr, "" } }, options);
  const std::vector<Category> handles = handle_categories({ "left", "right" });
  for (const double y : { 0.2, 0.5, 0.8 })
  {
    EXPECT_LE(distance(drawing.at(Vec3(0.4, y, 0.71)), handles[0].color), 2.0) << y;
    EXPECT_LE(distance(drawing.at(Vec3(1.2, y, 0.71)), handles[1].color), 2.0) << y;
  }
  expect_baseline(drawing.image);
}

TEST(Render, extrema)
{
  // There is a handle at the center of the square, so the maximum at the center is not spurious.
  const auto surface = square();
  add_array(surface, "Weights", { [](const Vec3& p) {
    return (p - Vec3(0.5, 0.5, 0)).norm() < 1e-9 ? 1.0 : 0.5 + 0.49 * waves(p);
  } });
  add_array(surface, "Waves", { waves });
  PictureOptions options = small_picture();
  options.array = "Weights";
  options.extrema = true;
  options.view.zoom = 0.9;
  Report report;
  const Drawing drawing = draw_with_report({ surface, nullptr, "" }, options, report);
  EXPECT_EQ(counts(report, "maxima"), Counts{ 4 });
  EXPECT_EQ(counts(report, "minima"), Counts{ 4 });
  EXPECT_EQ(counts(report, "drawn"), Counts{ 8 });
  const std::vector<Category>& kinds = extremum_categories();
  for (const Vec3& position : maxima(0.0))
  {
    const bool handle = position[0] == 0.5;
    EXPECT_EQ(hue_distance(drawing.at(position), kinds[1].color) < 0.08, !handle) << position;
  }
  for (const Vec3& position : minima(0.0))
  {
    EXPECT_LT(hue_distance(drawing.at(position), kinds[0].color), 0.06) << position;
  }
  // The function "Waves" is 1 at all its maxima. Only the array "Weights" identifies which maximum
  // is at the handle.
  options.array = "Waves";
  draw_with_report({ surface, nullptr, "" }, options, report);
  EXPECT_EQ(counts(report, "maxima"), Counts{ 4 });
  surface->GetPointData()->RemoveArray("Weights");
  draw_with_report({ surface, nullptr, "" }, options, report);
  EXPECT_EQ(counts(report, "maxima"), Counts{ 5 });
  EXPECT_EQ(counts(report, "minima"), Counts{ 4 });
  expect_baseline(drawing.image);
}

TEST(Render, extrema_of_tets)
{
  // The waves grow toward the camera, so all extrema are on the side that faces the camera.
  const TetMesh mesh = tet_box(16, 16, 8, Vec3::Zero(), Vec3(1, 1, 0.5));
  const auto grid = to_unstructured_grid(mesh.points, mesh.tets);
  add_array(grid, "Waves", { [](const Vec3& p) { return waves(p) * (1.0 + p[2]); } });
  PictureOptions options = small_picture();
  options.array = "Waves";
  options.extrema = true;
  options.cut = false;
  Report report;
  const Drawing drawing = draw_with_report({ grid, nullptr, "" }, options, report);
  EXPECT_EQ(counts(report, "maxima"), Counts{ 5 });
  EXPECT_EQ(counts(report, "minima"), Counts{ 4 });
  EXPECT_EQ(counts(report, "drawn"), Counts{ 9 });
  for (const Vec3& position : maxima(0.5))
  {
    EXPECT_LT(hue_distance(drawing.at(position), extremum_categories()[1].color), 0.08) << position;
  }
  // The cut removes the side that shows the extrema.
  options.cut = true;
  draw_with_report({ grid, nullptr, "" }, options, report);
  EXPECT_EQ(counts(report, "maxima"), Counts{ 5 });
  EXPECT_EQ(counts(report, "drawn"), Counts{ 0 });
  expect_baseline(drawing.image);
}

TEST(Render, row_sum)
{
  // The row sum grows from 0.8 on the left to 1.2 on the right.
  const auto surface = finger();
  add_array(surface, "RawWeights",
    { [](const Vec3&) { return 0.5; }, [](const Vec3& p) { return 0.5 + 0.1 * p[0]; } });
  PictureOptions options = small_picture();
  options.color_by = ColorBy::row_sum;
  Report report;
  const Drawing drawing = draw_with_report({ surface, nullptr, "" }, options, report);
  EXPECT_NEAR(report.number("picture.row_sum.minimum", 0), 0.8, 1e-12);
  EXPECT_NEAR(report.number("picture.row_sum.maximum", 0), 1.2, 1e-12);
  for (const double x : { -1.6, 0.0, 1.6 })
  {
    const double section_radius = std::sqrt(1.0 - x * x / 4.0);
    const Vec3 ridge(
      x, 0.2 * section_radius + 0.5 * std::cos(0.8 * x), 0.7 * section_radius * 0.968);
    EXPECT_LT(hue_distance(drawing.at(ridge), diverging_color(x / 2.0)), 0.06) << x;
  }
  expect_baseline(drawing.image);
}

TEST(Render, difference)
{
  // The dataset has two linear functions of x, whose difference is -0.25 x.
  const auto subtracted = vtkSmartPointer<vtkPolyData>::New();
  const auto surface = finger();
  subtracted->DeepCopy(surface);
  add_array(surface, "Shown", { [](const Vec3& p) { return 0.25 * p[0]; } });
  add_array(subtracted, "Shown", { [](const Vec3& p) { return 0.5 * p[0]; } });
  PictureOptions options = small_picture();
  options.array = "Shown";
  options.subtracted_data = subtracted;
  Report report;
  const Drawing drawing = draw_with_report({ surface, nullptr, "" }, options, report);
  double squares = 0.0;
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v)
  {
    squares += std::pow(0.25 * surface->GetPoint(v)[0], 2) / surface->GetNumberOfPoints();
  }
  EXPECT_NEAR(report.number("picture.difference.largest", 0), 0.5, 1e-12);
  EXPECT_NEAR(report.number("picture.difference.rms", 0), std::sqrt(squares), 1e-12);
  // On the left, both values are negative. The subtracted value is larger in magnitude, so the
  // difference is positive.
  for (const double x : { -1.6, 0.0, 1.6 })
  {
    const double section_radius = std::sqrt(1.0 - x * x / 4.0);
    const Vec3 ridge(
      x, 0.2 * section_radius + 0.5 * std::cos(0.8 * x), 0.7 * section_radius * 0.968);
    EXPECT_LT(hue_distance(drawing.at(ridge), diverging_color(-x / 2.0)), 0.06) << x;
  }
  // The difference between a dataset and itself is zero.
  options.subtracted_data = surface;
  const Drawing zero_difference = draw_with_report({ surface, nullptr, "" }, options, report);
  EXPECT_EQ(report.number("picture.difference.largest", -1), 0.0);
  EXPECT_EQ(zero_difference.count([](const Pixel& p) { return std::abs(p.r - p.b) > 30; }), 0);
  expect_baseline(drawing.image);
}

TEST(Render, handle_names)
{
  // There are more handles than fit into the legend. The legend lists them from top to bottom in
  // the order of the components of the array.
  const auto surface = finger();
  std::vector<Column> columns;
  constexpr int handle_count = 40;
  for (int j = 0; j < handle_count; ++j)
  {
    columns.emplace_back([j](const Vec3& p)
      { return std::max(0.0, 1.0 - std::abs((p[0] + 2.0) / 4.0 * (handle_count - 1) - j)); });
  }
  add_array(surface, "Weights", columns);
  PictureOptions options = small_picture();
  options.color_by = ColorBy::handle;
  options.legend = true;
  const Drawing drawing = draw({ { surface, nullptr, "" } }, options);
  const std::vector<Category> handles = handle_categories({ "a", "b", "c" });
  // These are the pixels of the legend, which is drawn without lighting.
  const int right = drawing.geometry.tiles[0].x + drawing.geometry.tiles[0].width;
  int previous_lowest = 300;
  for (const Category& handle : handles)
  {
    int lowest = 300;
    int highest = -1;
    for (int y = 0; y < 300; ++y)
    {
      for (int x = right; x < 400; ++x)
      {
        if (distance(pixel_at(drawing.image, x, y), handle.color) <= 1.0)
        {
          lowest = std::min(lowest, y);
          highest = std::max(highest, y);
        }
      }
    }
    EXPECT_GE(highest, lowest) << handle.name;
    EXPECT_LT(highest, previous_lowest) << handle.name;
    previous_lowest = lowest;
  }
  expect_baseline(drawing.image);
}
