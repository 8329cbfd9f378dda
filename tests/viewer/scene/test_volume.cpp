// Isosurfaces, slices and other views of volumes are compared with closed forms. Invalid input is
// refused.
#include "scene/colors.h"
#include "scene/curves.h"
#include "scene/volume.h"
#include "scene/volume_rendering.h"

#include "base/constants.h"
#include "conversion.h"
#include "support/meshes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
constexpr const char* name = "WindingNumber";

vtkSmartPointer<vtkImageData> field(
  int x, int y, int z, const std::function<double(const Vec3&)>& value)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(x, y, z);
  image->SetSpacing(0.1, 0.1, 0.1);
  image->SetOrigin(-1.5, -1.5, -1.5);
  vtkNew<vtkDoubleArray> values;
  values->SetName(name);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(value(Vec3(image->GetPoint(i))));
  }
  image->GetPointData()->AddArray(values);
  return image;
}

vtkSmartPointer<vtkImageData> cone()
{
  return field(31, 31, 31, [](const Vec3& p) { return 1.5 - p.norm(); });
}

vtkSmartPointer<vtkPolyData> lines(const std::vector<std::vector<vtkIdType>>& cells)
{
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 5; ++i)
  {
    points->InsertNextPoint(i, i * i, 0);
  }
  vtkNew<vtkCellArray> array;
  for (const auto& cell : cells)
  {
    array->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(array);
  return data;
}

void add_multiplicity(vtkPolyData* data, const std::vector<int>& values)
{
  vtkNew<vtkIntArray> array;
  array->SetName("Multiplicity");
  for (const int value : values)
  {
    array->InsertNextValue(value);
  }
  data->GetCellData()->AddArray(array);
}
} // namespace

TEST(Volume, AnIsosurfaceHasTheAreaAndTheNormalsOfItsSphere)
{
  const auto image = cone();
  for (const double level : { 0.25, 0.5, 0.9 })
  {
    const double radius = 1.5 - level;
    const auto surface = isosurface(image, name, level);
    EXPECT_NEAR(
      surface_area(surface), 4.0 * pi * radius * radius, 0.01 * 4.0 * pi * radius * radius);
    vtkDataArray* normals = surface->GetPointData()->GetNormals();
    ASSERT_NE(normals, nullptr);
    for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v)
    {
      const Vec3 position(surface->GetPoint(v));
      EXPECT_NEAR(position.norm(), radius, 0.005);
      EXPECT_GT(std::abs(position.normalized().dot(Vec3(normals->GetTuple3(v)))), 0.99);
    }
  }
  EXPECT_EQ(isosurface(image, name, 7.0)->GetNumberOfPolys(), 0);
}

TEST(Volume, ASliceLiesInItsPlaneAndCarriesTheField)
{
  const auto linear = [](const Vec3& p) { return 0.3 * p.x() - 0.2 * p.y() + 0.1 * p.z(); };
  const auto image = field(31, 31, 31, linear);
  for (const Vec3& normal : { Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0.6, 0.0, 0.8), Vec3(1, 1, 1) })
  {
    const Vec3 origin(0.11, -0.07, 0.23);
    const auto cut = slice(image, name, origin, normal);
    ASSERT_GT(cut->GetNumberOfPolys(), 100);
    vtkDataArray* values = cut->GetPointData()->GetArray(name);
    ASSERT_NE(values, nullptr);
    for (vtkIdType v = 0; v < cut->GetNumberOfPoints(); ++v)
    {
      const Vec3 position(cut->GetPoint(v));
      EXPECT_NEAR((position - origin).dot(normal), 0.0, 1e-5);
      EXPECT_NEAR(values->GetComponent(v, 0), linear(position), 1e-6);
    }
  }
  EXPECT_NEAR(surface_area(slice(image, name, Vec3(0, 0, 0.23), Vec3(0, 0, 1))), 9.0, 1e-6);
}

TEST(Volume, AValueBetweenSamplesIsLinearInEachDirection)
{
  const auto product = [](const Vec3& p) { return 1.0 + p.x() * p.y() - 2.0 * p.z() * p.x(); };
  const auto image = field(31, 31, 31, product);
  double value = 0.0;
  for (const Vec3& position :
    { Vec3(0.123, 0.456, -0.789), Vec3(1.5, 1.5, 1.5), Vec3(-1.5, 0.01, 0) })
  {
    ASSERT_TRUE(value_at(image, name, position, value));
    EXPECT_NEAR(value, product(position), 1e-12);
  }
  EXPECT_FALSE(value_at(image, name, Vec3(1.51, 0, 0), value));
}

TEST(Volume, TheOccupiedBoxHoldsTheIsosurfaceTightly)
{
  const auto image = cone();
  const Box box = occupied_box(image, name, { 0.75 }, false);
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(box.upper[axis], 0.8, 0.0501);
    EXPECT_NEAR(box.lower[axis], -0.8, 0.0501);
  }
  EXPECT_NEAR(occupied_box(image, name, { 9.0 }, false).diagonal(), 3.0 * std::sqrt(3.0), 1e-9);
}

TEST(Volume, WhatIsNoVolumeIsSaid)
{
  const auto message = [](vtkDataSet* data, const char* array = name)
  { return check_volume(data, array).message; };
  EXPECT_TRUE(check_volume(cone(), name).ok());
  EXPECT_EQ(check_volume(cone(), name).report.number("volume.maximum", 0.0), 1.5);
  EXPECT_THAT(message(nullptr), HasSubstr("a volume"));
  EXPECT_THAT(message(vtkNew<vtkImageData>()), HasSubstr("no samples"));
  EXPECT_THAT(message(cone(), "Heat"), HasSubstr("'Heat'; available: WindingNumber"));
  EXPECT_THAT(message(field(5, 5, 1, [](const Vec3&) { return 0.0; })),
    HasSubstr("one sample thick along z"));
  const auto holes = field(5, 5, 5,
    [](const Vec3& p) { return p.x() > -1.15 ? std::numeric_limits<double>::quiet_NaN() : 0.0; });
  EXPECT_THAT(message(holes), HasSubstr("25 of the 125 values of 'WindingNumber' are not finite"));
  const auto vectors = cone();
  vtkNew<vtkDoubleArray> pairs;
  pairs->SetName("Pairs");
  pairs->SetNumberOfComponents(2);
  pairs->SetNumberOfTuples(vectors->GetNumberOfPoints());
  pairs->Fill(0.0);
  vectors->GetPointData()->AddArray(pairs);
  EXPECT_THAT(message(vectors, "Pairs"), HasSubstr("has 2 components"));
}

TEST(Volume, TheOutsideIsClearAndWhatIsWrongIsNot)
{
  for (const double step : { 0.1, 1.0, 6.0 }) // spacings of fine and coarse grids
  {
    for (const double outside : { -0.02, 0.0, 0.01, 0.02 })
    {
      EXPECT_EQ(winding_opacity(outside, step), 0.0);
    }
    const double inside = winding_opacity(1.0, step);
    // 3 % of the light is absorbed per unit of length, for any spacing of the grid.
    EXPECT_NEAR(std::pow(1.0 - inside, 1.0 / step), 0.97, 1e-12);
    EXPECT_NEAR(winding_opacity(0.5, step), 0.6, 1e-12);
    for (const double wrong_number : { -1.0, 2.0 })
    {
      EXPECT_GT(winding_opacity(wrong_number, step), 4.0 * inside);
      EXPECT_EQ(winding_opacity(wrong_number, step), winding_opacity(7.0 * wrong_number, step));
    }
    // The opacity has no jump that would be visible as an edge.
    for (double w = -1.0; w < 2.0; w += 0.001)
    {
      EXPECT_NEAR(winding_opacity(w, step), winding_opacity(w + 0.001, step), 0.005) << w;
    }
  }
}

TEST(Volume, ALegendOfLevelsNamesEachInItsColor)
{
  const ColorMap map = winding_map();
  const ColorMap legend = level_map(map, { -0.5, 0.25, 1.5 });
  EXPECT_THAT(legend.texts, testing::ElementsAre("-0.5", "0.25", "1.5"));
  for (int i = 0; i < 3; ++i)
  {
    const Rgb expected = winding_color(std::array<double, 3>{ -0.5, 0.25, 1.5 }[i]);
    const Rgb field_color = color_of(legend, legend.ticks[i]);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(field_color[k], expected[k], 0.02);
    }
  }
  // In the legend, the level 0.45 replaces the tick 0.5. The other ticks are kept.
  EXPECT_THAT(
    with_levels(map, { 0.45 }).ticks, testing::UnorderedElementsAre(0.45, -1.0, 0.0, 1.0, 2.0));
}

TEST(Curves, AreToldFromBones)
{
  EXPECT_TRUE(is_curve_data(lines({ { 0, 1, 2, 3 } })));
  EXPECT_FALSE(is_curve_data(lines({ { 0, 1 }, { 1, 2 } })));
  const auto edges = lines({ { 0, 1 }, { 1, 2 } });
  add_multiplicity(edges, { 1, 1 });
  EXPECT_TRUE(is_curve_data(edges));
  const TriangleMesh cube = test::cube(-1, 1);
  EXPECT_FALSE(is_curve_data(to_polydata(cube.points, cube.triangles)));
  EXPECT_FALSE(is_curve_data(to_polydata(Handles(1))));
  EXPECT_FALSE(is_curve_data(nullptr));
}

TEST(Curves, ThoseThatCountNothingAreLeftOut)
{
  const auto edges = lines({ { 0, 1 }, { 1, 2 }, { 2, 3 } });
  EXPECT_EQ(make_curves(edges, 0.1, 1.0).size(), 2u) << "tubes, and faint lines before all";
  add_multiplicity(edges, { 0, 0, 0 });
  EXPECT_TRUE(make_curves(edges, 0.1, 1.0).empty());
  edges->GetCellData()->RemoveArray("Multiplicity");
  add_multiplicity(edges, { 1, -2, 7 });
  EXPECT_EQ(make_curves(edges, 0.1, 1.0).size(), 6u);
}
