// Tests of the filters that use weights: vtkWeightedColors, vtkDepthOrder and vtkCutAlongBones. The
// tests check output arrays, reports, the names in error messages, and which of two crossing limbs
// is in front.
#include "TestFilter.h"

#include "vtkBoundedBiharmonicWeights.h"
#include "vtkCutAlongBones.h"
#include "vtkDepthOrder.h"
#include "vtkSkinningDeformation.h"
#include "vtkWeightedColors.h"

#include "conversion.h"
#include "report_field_data.h"
#include "support/handles.h"
#include "support/meshes.h"
#include "weights_input.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
void set_cells(vtkPolyData* handles, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  const auto cells = static_cast<int>(handles->GetNumberOfCells());
  array->SetNumberOfComponents(static_cast<int>(values.size()) / cells);
  array->SetNumberOfTuples(cells);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  handles->GetCellData()->AddArray(array);
}

/// Return a U-shaped surface with 8 x 8 cells per unit square. The base is at 0 < y < 1. The two
/// limbs are at 0 < x < 1 and at 2 < x < 3.
vtkSmartPointer<vtkPolyData> two_limbs()
{
  const TriangleMesh all = test::grid(24, 24, 3.0, 3.0);
  std::vector<Index> kept;
  for (Index t = 0; t < all.triangles.rows(); ++t)
  {
    const Vec3 middle = (all.points.row(all.triangles(t, 0)) + all.points.row(all.triangles(t, 1)) +
                          all.points.row(all.triangles(t, 2)))
                          .transpose() /
      3.0;
    if (middle[1] < 1.0 || middle[0] < 1.0 || middle[0] > 2.0)
    {
      kept.push_back(t);
    }
  }
  std::vector<Index> number(static_cast<std::size_t>(all.points.rows()), -1);
  std::vector<Index> used;
  Triangles triangles(static_cast<Index>(kept.size()), 3);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      Index& v = number[static_cast<std::size_t>(all.triangles(kept[t], k))];
      if (v < 0)
      {
        v = static_cast<Index>(used.size());
        used.push_back(all.triangles(kept[t], k));
      }
      triangles(t, k) = v;
    }
  }
  Points points(static_cast<Index>(used.size()), 3);
  for (Index v = 0; v < points.rows(); ++v)
  {
    points.row(v) = all.points.row(used[static_cast<std::size_t>(v)]);
  }
  return to_polydata(points, triangles);
}

/// Return the z coordinate of the posed shape at (x, y) on one of the limbs, or NaN if this limb
/// does not cover (x, y). The function tests every triangle.
double height_of(vtkPolyData* rest, vtkPolyData* posed, bool right_limb, double x, double y)
{
  SurfaceInput surface;
  EXPECT_TRUE(to_surface(posed, surface).ok());
  const PointsView p = surface.points.view();
  double height = std::nan("");
  for (Index t = 0; t < surface.triangles.view().rows(); ++t)
  {
    Index v[3];
    Eigen::Matrix3d corners;
    double middle[2] = { 0.0, 0.0 };
    for (int k = 0; k < 3; ++k)
    {
      v[k] = surface.triangles.view()(t, k);
      corners.col(k) = Vec3(p(v[k], 0), p(v[k], 1), 1.0);
      double at[3];
      rest->GetPoint(v[k], at);
      middle[0] += at[0] / 3.0;
      middle[1] += at[1] / 3.0;
    }
    if (middle[1] < 1.0 || (middle[0] > 1.5) != right_limb)
    {
      continue;
    }
    const Vec3 coordinates = corners.inverse() * Vec3(x, y, 1.0);
    if (coordinates.minCoeff() >= 0.0)
    {
      height =
        coordinates[0] * p(v[0], 2) + coordinates[1] * p(v[1], 2) + coordinates[2] * p(v[2], 2);
    }
  }
  return height;
}

class WeightUses : public testing::Test
{
protected:
  WeightUses()
  {
    this->rest = two_limbs();
    this->handles = to_polydata({ test::bone_handle("base", Vec3(0.5, 0.5, 0), Vec3(2.5, 0.5, 0)),
      test::bone_handle("left", Vec3(0.5, 1.5, 0), Vec3(0.5, 2.75, 0)),
      test::bone_handle("right", Vec3(2.5, 1.5, 0), Vec3(2.5, 2.75, 0)) });
    this->weights->SetInputData(0, this->rest);
    this->weights->SetInputData(1, this->handles);
    this->skinning->SetInputConnection(0, this->weights->GetOutputPort());
    this->skinning->SetInputData(1, this->handles);
    for (vtkAlgorithm* filter :
      { static_cast<vtkAlgorithm*>(this->colors), static_cast<vtkAlgorithm*>(this->depth) })
    {
      filter->SetInputConnection(0, this->skinning->GetOutputPort());
      this->listener->listen(filter);
    }
    this->colors->SetInputData(1, this->handles);
    this->depth->SetInputData(1, this->handles);
  }

  /// Rotate both limbs inwards by 50 degrees, so that they cross.
  void cross_limbs()
  {
    vtkDataArray* transforms = this->handles->GetCellData()->GetArray("Transform");
    for (const int limb : { 1, 2 })
    {
      const double angle = (limb == 1 ? -50.0 : 50.0) * std::acos(-1.0) / 180.0;
      const Vec3 pivot(limb == 1 ? 0.5 : 2.5, 1.5, 0);
      Affine t = identity_affine();
      t.leftCols<3>() = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
      t.col(3) = pivot - t.leftCols<3>() * pivot;
      transforms->SetTuple(limb, t.data());
    }
    transforms->Modified();
    this->handles->Modified();
  }

  /// Return the name of the limb that is in front where the limbs cross.
  std::string owner()
  {
    this->depth->Update();
    EXPECT_EQ(this->depth->GetStatus(), vtkBindposeAlgorithm::OK);
    // Compare vertices in the middle of the crossing. The mesh is the output of the weights filter,
    // which has split triangles.
    auto* mesh = vtkPolyData::SafeDownCast(this->weights->GetOutput());
    auto* posed = vtkPolyData::SafeDownCast(this->depth->GetOutput());
    const double left = height_of(mesh, posed, false, 1.5, 2.3);
    const double right = height_of(mesh, posed, true, 1.5, 2.3);
    EXPECT_TRUE(std::isfinite(left) && std::isfinite(right)) << "the limbs cross here";
    return left > right ? "left" : "right";
  }

  vtkSmartPointer<vtkPolyData> rest;
  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkBoundedBiharmonicWeights> weights;
  vtkNew<vtkSkinningDeformation> skinning;
  vtkNew<vtkWeightedColors> colors;
  vtkNew<vtkDepthOrder> depth;
  vtkNew<Listener> listener;
};
} // namespace

TEST_F(WeightUses, LayersDecideWhichLimbIsInFront)
{
  this->cross_limbs();
  set_cells(this->handles, "Layer", { 0, 1, 0 });
  EXPECT_EQ(this->owner(), "left");
  set_cells(this->handles, "Layer", { 0, 0, 1 });
  EXPECT_EQ(this->owner(), "right");
  set_cells(this->handles, "Layer", { 0, -1, -2 });
  EXPECT_EQ(this->owner(), "left");
  EXPECT_EQ(this->weights->GetNumberOfBinds(), 1);
  EXPECT_EQ(this->skinning->GetNumberOfBinds(), 1);
  // With equal layers, the later handle is in front.
  set_cells(this->handles, "Layer", { 5, 5, 5 });
  EXPECT_EQ(this->owner(), "right");
  double range[2];
  this->depth->GetOutput()->GetPointData()->GetArray("Depth")->GetRange(range);
  EXPECT_EQ(range[0], 5.0);
  EXPECT_EQ(range[1], 5.0);
}

TEST_F(WeightUses, DepthDisplacesZAndNothingElse)
{
  set_cells(this->handles, "Layer", { 0, 2, -1 });
  this->depth->SetScale(0.25);
  this->depth->SetTie(0.0);
  this->depth->Update();
  vtkDataSet* ordered = this->depth->GetOutput();
  vtkDataArray* weight = ordered->GetPointData()->GetArray("Weights");
  vtkDataArray* depths = ordered->GetPointData()->GetArray("Depth");
  for (vtkIdType v = 0; v < ordered->GetNumberOfPoints(); ++v)
  {
    const double expected = 2.0 * weight->GetComponent(v, 1) - weight->GetComponent(v, 2);
    EXPECT_NEAR(depths->GetComponent(v, 0), expected, 1e-12);
    double p[3];
    double q[3];
    this->weights->GetOutput()->GetPoint(v, p);
    ordered->GetPoint(v, q);
    EXPECT_NEAR((Vec3(q[0], q[1], q[2]) - Vec3(p[0], p[1], 0.25 * expected)).norm(), 0.0, 1e-12);
  }
  const Report report = read_report(ordered);
  EXPECT_NEAR(report.number("least_depth", 0), -1.0, 1e-12);
  EXPECT_NEAR(report.number("largest_depth", 0), 2.0, 1e-12);
  EXPECT_EQ(report.number("scale", 0), 0.25);
  this->depth->DisplaceOff();
  this->depth->Update();
  double bounds[6];
  this->depth->GetOutput()->GetBounds(bounds);
  EXPECT_EQ(bounds[5], 0.0);
}

TEST_F(WeightUses, AHandleWithoutAColorOfItsOwnKeepsItsCategory)
{
  // A NaN in the array means that the handle has no color.
  const double none = std::numeric_limits<double>::quiet_NaN();
  this->colors->Update();
  const auto at_handle = [&](int handle)
  {
    vtkPointData* data = this->colors->GetOutput()->GetPointData();
    for (vtkIdType v = 0; v < this->colors->GetOutput()->GetNumberOfPoints(); ++v)
    {
      if (data->GetArray("Weights")->GetComponent(v, handle) == 1.0)
      {
        return Vec3(data->GetArray("ColorValues")->GetTuple3(v));
      }
    }
    return Vec3(-1, -1, -1);
  };
  const Vec3 category = at_handle(1);
  set_cells(this->handles, "Color", { 1, 0, 0, none, none, none, 0, 0, 1 });
  this->colors->Update();
  ASSERT_EQ(this->colors->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(at_handle(1), category);
  EXPECT_EQ(at_handle(0), Vec3(1, 0, 0));
  set_cells(this->handles, "Color", { 1, 0, 0, none, 0, none, 0, 0, 1 });
  this->colors->Update();
  EXPECT_EQ(this->colors->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT) << "half a color";
}

TEST_F(WeightUses, ColorsOfHandlesBytesAndNumbersAlike)
{
  set_cells(this->handles, "Color", { 1, 0, 0, 0, 0.2, 0, 0, 0, 1 });
  this->colors->Update();
  ASSERT_EQ(this->colors->GetStatus(), vtkBindposeAlgorithm::OK);
  vtkPointData* data = this->colors->GetOutput()->GetPointData();
  vtkSmartPointer<vtkDataArray> numbers = data->GetArray("ColorValues");
  auto* bytes = vtkUnsignedCharArray::SafeDownCast(data->GetArray("Color"));
  ASSERT_NE(bytes, nullptr);
  EXPECT_EQ(data->GetScalars(), bytes);
  vtkDataArray* weight = data->GetArray("Weights");
  for (vtkIdType v = 0; v < numbers->GetNumberOfTuples(); ++v)
  {
    for (int handle = 0; handle < 3; ++handle)
    {
      if (weight->GetComponent(v, handle) == 1.0)
      {
        EXPECT_NEAR(numbers->GetComponent(v, handle), handle == 1 ? 0.2 : 1.0, 1e-12);
      }
    }
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(bytes->GetComponent(v, k), std::lround(255.0 * numbers->GetComponent(v, k)));
    }
    EXPECT_EQ(data->GetArray("OutOfGamut")->GetComponent(v, 0), 0.0);
  }
  EXPECT_EQ(read_report(this->colors->GetOutput()).number("counts.out_of_gamut", -1), 0);
  // The same colors are given as bytes: 51 of 255 is 0.2.
  vtkNew<vtkUnsignedCharArray> same;
  same->SetName("Color");
  same->SetNumberOfComponents(3);
  for (const auto& rgb : { std::array<unsigned char, 3>{ 255, 0, 0 }, { 0, 51, 0 }, { 0, 0, 255 } })
  {
    same->InsertNextTypedTuple(rgb.data());
  }
  this->handles->GetCellData()->AddArray(same);
  this->colors->Update();
  vtkDataArray* again = this->colors->GetOutput()->GetPointData()->GetArray("ColorValues");
  for (vtkIdType v = 0; v < numbers->GetNumberOfTuples(); ++v)
  {
    EXPECT_NEAR(again->GetComponent(v, 1), numbers->GetComponent(v, 1), 1e-15);
  }
}

TEST_F(WeightUses, WithoutColorsHandlesGetTheirOwn)
{
  this->weights->KeepRawOn();
  this->colors->SetArrayName("RawWeights");
  this->colors->Update();
  ASSERT_EQ(this->colors->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(read_report(this->colors->GetOutput()).text("colors"), "categorical");
  std::ostringstream text;
  this->colors->Print(text);
  this->depth->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("ArrayName: RawWeights"));
  EXPECT_THAT(text.str(), HasSubstr("Tie: 0.001"));
}

TEST_F(WeightUses, WhatDoesNotFitIsNamed)
{
  const auto expect_error = [this](vtkBindposeAlgorithm* filter, const std::string& words)
  {
    this->listener->errors.clear();
    filter->Update();
    ASSERT_EQ(this->listener->errors.size(), 1u) << words;
    EXPECT_THAT(this->listener->errors[0], HasSubstr(words));
    EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  };
  set_cells(this->handles, "Color", { 1, 0, 0, 0, 2, 0, 0, 0, 1 });
  expect_error(this->colors, "'left'");
  set_cells(this->handles, "Color", { 1, 0, 0 });
  expect_error(this->colors, "1 components");
  set_cells(this->handles, "Layer", { 0, std::nan(""), 0 });
  expect_error(this->depth, "'left'");
  set_cells(this->handles, "Layer", { 0, 1, 0, 1, 0, 1 });
  expect_error(this->depth, "2 components");
  this->depth->SetArrayName("W");
  expect_error(this->depth, "no point array 'W'");
  this->colors->SetArrayName("W");
  expect_error(this->colors, "no point array 'W'");
  this->handles->GetCellData()->RemoveArray("Color");
  this->colors->SetArrayName("Weights");
  this->colors->SetInputData(
    1, to_polydata(Handles{ test::bone_handle("b", Vec3(0, 0, 0), Vec3(1, 0, 0)) }));
  expect_error(this->colors, "3 components, but there are 1 handles");
}

TEST(CutAlongBones, SidesAreRegionsThatWeightsTake)
{
  const TriangleMesh mesh = test::grid(16, 16);
  const auto square = to_polydata(mesh.points, mesh.triangles);
  vtkNew<vtkFloatArray> marks;
  marks->SetName("Mark");
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    marks->InsertNextValue(static_cast<float>(v));
  }
  square->GetPointData()->AddArray(marks);
  Handles list{ Handle(), test::bone_handle("curve", Vec3(0.25, 0.5, 0), Vec3(0.75, 0.5, 0)) };
  list[0].name = "dot";
  list[0].head = list[0].tail = Vec3(0.5, 0.875, 0);
  const auto handles = to_polydata(list);
  vtkNew<vtkCutAlongBones> cut;
  cut->SetInputData(0, square);
  cut->SetInputData(1, handles);
  vtkNew<Listener> listener;
  listener->listen(cut);
  set_cells(handles, "LeftColor", { 0, 0, 0, 1, 0, 0 });
  set_cells(handles, "RightColor", { 0, 0, 0, 0, 0, 1 });
  cut->Update();
  ASSERT_EQ(listener->errors.size(), 1u);
  EXPECT_THAT(listener->errors[0], HasSubstr("'dot'"));
  set_cells(handles, "Color", { 0, 1, 0, 0, 0, 0 });
  cut->Update();
  ASSERT_EQ(cut->GetStatus(), vtkBindposeAlgorithm::OK);
  const Report report = read_report(cut->GetOutput());
  EXPECT_EQ(report.number("counts.doubled_vertices", -1), 7);
  EXPECT_EQ(report.number("counts.handles", -1), 3);
  vtkPointData* data = cut->GetOutput()->GetPointData();
  for (vtkIdType v = 0; v < data->GetNumberOfTuples(); ++v)
  {
    EXPECT_EQ(data->GetArray("Mark")->GetComponent(v, 0),
      data->GetArray("OriginalPointIds")->GetComponent(v, 0));
  }

  vtkNew<vtkBoundedBiharmonicWeights> weights;
  weights->SetInputConnection(0, cut->GetOutputPort(0));
  weights->SetInputConnection(1, cut->GetOutputPort(1));
  vtkNew<vtkWeightedColors> colors;
  colors->SetInputConnection(0, weights->GetOutputPort());
  colors->SetInputConnection(1, cut->GetOutputPort(1));
  colors->Update();
  ASSERT_EQ(colors->GetStatus(), vtkBindposeAlgorithm::OK) << colors->GetStatusMessage();
  vtkPointData* painted = colors->GetOutput()->GetPointData();
  vtkDataArray* labels = painted->GetArray("RegionId");
  vtkDataArray* values = painted->GetArray("ColorValues");
  int sides[5] = { 0, 0, 0, 0, 0 };
  for (vtkIdType v = 0; v < labels->GetNumberOfTuples(); ++v)
  {
    // 3 and 4 are the labels of the two sides of the second handle, the bone.
    const int side = static_cast<int>(labels->GetComponent(v, 0));
    ASSERT_TRUE(side == 0 || side == 3 || side == 4);
    sides[side] += 1;
    if (side > 0)
    {
      EXPECT_NEAR(values->GetComponent(v, 0), side == 3 ? 1.0 : 0.0, 1e-12);
      EXPECT_NEAR(values->GetComponent(v, 2), side == 3 ? 0.0 : 1.0, 1e-12);
    }
  }
  EXPECT_EQ(sides[3], 7);
  EXPECT_EQ(sides[4], 7);
}

TEST(CutAlongBones, BonesOfOneCurveAreOnePairOfSides)
{
  const TriangleMesh mesh = test::grid(8, 8);
  const Vec3 corners[4] = { Vec3(0.25, 0.25, 0), Vec3(0.75, 0.25, 0), Vec3(0.75, 0.75, 0),
    Vec3(0.25, 0.75, 0) };
  Handles ring;
  for (int k = 0; k < 4; ++k)
  {
    ring.push_back(test::bone_handle("r" + std::to_string(k), corners[k], corners[(k + 1) % 4]));
  }
  const auto handles = to_polydata(ring);
  vtkNew<vtkCutAlongBones> cut;
  cut->SetInputData(0, to_polydata(mesh.points, mesh.triangles));
  cut->SetInputData(1, handles);
  cut->Update();
  EXPECT_EQ(read_report(cut->GetOutput()).number("counts.handles", -1), 8);
  set_cells(handles, "Curve", { 7, 7, 7, 7 });
  cut->Update();
  EXPECT_EQ(read_report(cut->GetOutput()).number("counts.handles", -1), 2);
  vtkDataArray* labels = cut->GetOutput()->GetPointData()->GetArray("RegionId");
  int sides[3] = { 0, 0, 0 };
  for (vtkIdType v = 0; v < labels->GetNumberOfTuples(); ++v)
  {
    sides[static_cast<int>(labels->GetComponent(v, 0))] += 1;
  }
  EXPECT_EQ(sides[1], 16) << "joints, too";
  EXPECT_EQ(sides[2], 16);
  set_cells(handles, "Curve", { 7, 7, 7, 7, 7, 7, 7, 7 });
  vtkNew<Listener> listener;
  listener->listen(cut);
  cut->Update();
  ASSERT_EQ(listener->errors.size(), 1u);
  EXPECT_THAT(listener->errors[0], HasSubstr("'Curve'"));
}

TEST(CutAlongBones, LabelsMustBeIntegersOfAllPoints)
{
  const TriangleMesh mesh = test::grid(2, 2);
  const auto square = to_polydata(mesh.points, mesh.triangles);
  std::vector<Index> labels;
  ASSERT_TRUE(to_region_ids(square, "RegionId", labels).ok());
  EXPECT_TRUE(labels.empty());
  vtkNew<vtkDoubleArray> array;
  array->SetName("RegionId");
  array->SetNumberOfTuples(mesh.points.rows());
  array->Fill(7.0);
  square->GetPointData()->AddArray(array);
  ASSERT_TRUE(to_region_ids(square, "RegionId", labels).ok());
  EXPECT_EQ(labels, std::vector<Index>(9, 7));
  for (const double wrong : { 0.5, std::nan(""), 1e300 })
  {
    array->SetValue(4, wrong);
    EXPECT_THAT(to_region_ids(square, "RegionId", labels).message,
      HasSubstr("label of point 4 in the array 'RegionId' must be an integer, not "));
  }
  array->SetNumberOfTuples(8);
  EXPECT_THAT(to_region_ids(square, "RegionId", labels).message,
    HasSubstr("has 8 values, but the mesh has 9 points"));
}

TEST(CutAlongBones, LabelsThatAreThereStay)
{
  const TriangleMesh mesh = test::grid(8, 8);
  const auto square = to_polydata(mesh.points, mesh.triangles);
  vtkNew<vtkIdTypeArray> old_labels;
  old_labels->SetName("RegionId");
  old_labels->SetNumberOfTuples(mesh.points.rows());
  old_labels->Fill(0);
  old_labels->SetValue(3, 4);
  square->GetPointData()->AddArray(old_labels);
  vtkNew<vtkCutAlongBones> cut;
  cut->SetInputData(0, square);
  cut->SetInputData(
    1, to_polydata(Handles{ test::bone_handle("b", Vec3(0.25, 0.5, 0), Vec3(0.75, 0.5, 0)) }));
  cut->Update();
  vtkDataArray* labels = cut->GetOutput()->GetPointData()->GetArray("RegionId");
  EXPECT_EQ(labels->GetComponent(3, 0), 4);
  EXPECT_EQ(labels->GetRange(0)[1], 6.0);
  vtkDataArray* regions =
    vtkDataSet::SafeDownCast(cut->GetOutput(1))->GetCellData()->GetArray("RegionId");
  EXPECT_EQ(regions->GetComponent(0, 0), 5);
  EXPECT_EQ(regions->GetComponent(1, 0), 6);
}

TEST(CutAlongBones, WhatCannotBeCutIsNamed)
{
  const TriangleMesh mesh = test::grid(8, 8);
  vtkNew<vtkCutAlongBones> cut;
  vtkNew<Listener> listener;
  listener->listen(cut);
  cut->SetInputData(0, to_polydata(mesh.points, mesh.triangles));
  const auto handles =
    to_polydata(Handles{ test::bone_handle("oblique", Vec3(0.1, 0.2, 0), Vec3(0.8, 0.7, 0)) });
  cut->SetInputData(1, handles);
  cut->Update();
  ASSERT_EQ(listener->errors.size(), 1u);
  EXPECT_THAT(listener->errors[0], HasSubstr("'oblique'"));
  EXPECT_EQ(cut->GetOutput()->GetNumberOfPoints(), 0);
  set_cells(handles, "LeftColor", { 1, 0, 0 });
  cut->Update();
  EXPECT_THAT(listener->errors.back(), HasSubstr("must have both"));
}
