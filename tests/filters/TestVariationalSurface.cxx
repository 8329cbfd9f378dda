// Tests of vtkVariationalSurface: constraints by handles and by arrays of the mesh, one bind for
// many poses, fairing without handles, and error messages that name the cause.
#include "vtkVariationalSurface.h"

#include "TestFilter.h"
#include "conversion.h"
#include "core/arap/full_arap_cases.h"
#include "report_field_data.h"
#include "vtkPoseHandles.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
constexpr int squares = 12;

/// Fixture with a flat square and the filter. A band along the border of the square is fixed, and
/// the middle of the square is region 1, which a handle can move.
class VariationalSurfaceFilter : public testing::Test
{
protected:
  VariationalSurfaceFilter()
  {
    this->mesh = test::grid(squares, squares);
    this->surface = to_polydata(this->mesh.points, this->mesh.triangles);
    this->fixed->SetName("Fixed");
    this->labels->SetName("RegionId");
    for (Index v = 0; v < this->mesh.points.rows(); ++v)
    {
      const double x = this->mesh.points(v, 0), y = this->mesh.points(v, 1);
      const auto depth = std::lround(std::min({ x, y, 1.0 - x, 1.0 - y }) * squares);
      this->fixed->InsertNextValue(depth < 3);
      this->labels->InsertNextValue(depth >= 5);
    }
    this->surface->GetPointData()->AddArray(this->fixed);
    this->surface->GetPointData()->AddArray(this->labels);
    this->pose->SetInputData(
      to_polydata(Handles{ test::region_handle("middle", 1, Vec3(0.5, 0.5, 0)) }));
    this->filter->SetInputData(0, this->surface);
    this->listener->listen(this->filter);
  }

  void pose_middle(double height)
  {
    this->filter->SetInputConnection(1, this->pose->GetOutputPort());
    this->pose->SetPoseJSON(
      R"({"handles": {"middle": {"translate": [0, 0, )" + std::to_string(height) + "]}}}");
  }

  double height(double x, double y)
  {
    const auto v = static_cast<vtkIdType>(std::lround(y * squares) * (squares + 1));
    return this->filter->GetOutput()->GetPoint(v + std::lround(x * squares))[2];
  }

  void expect_error(const char* sentence)
  {
    this->listener->errors.clear();
    this->filter->Update();
    EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    ASSERT_EQ(this->listener->errors.size(), 1u);
    EXPECT_THAT(this->listener->errors[0], HasSubstr(sentence));
  }

  TriangleMesh mesh;
  vtkSmartPointer<vtkPolyData> surface;
  vtkNew<vtkIntArray> fixed, labels;
  vtkNew<vtkPoseHandles> pose;
  vtkNew<vtkVariationalSurface> filter;
  vtkNew<Listener> listener;
};
} // namespace

TEST_F(VariationalSurfaceFilter, HandlesAndFixedPointsAreHeld)
{
  this->pose_middle(0.5);
  for (int order = 1; order <= 3; ++order)
  {
    this->filter->SetOrder(order);
    this->filter->Update();
    ASSERT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK)
      << this->filter->GetStatusMessage();
    EXPECT_EQ(this->height(0.0, 0.5), 0.0);
    EXPECT_EQ(this->height(0.5, 0.5), 0.5);
    const double between = this->height(4.0 / squares, 0.5);
    EXPECT_GT(between, 0.05);
    EXPECT_LT(between, 0.45);
    const Report report = read_report(this->filter->GetOutput());
    EXPECT_EQ(report.text("method"), "variational");
    EXPECT_EQ(report.text("boundary"), "region");
    EXPECT_EQ(report.number("order", 0), order);
    EXPECT_GT(report.number("condition", 0), 1.0);
    EXPECT_LT(report.number("constraint_residual", 1), 1e-14);
    EXPECT_EQ(report.number("counts.free", 0), 7 * 7 - 3 * 3);
  }
}

TEST_F(VariationalSurfaceFilter, DragsBindOnceAndBindParametersBindAgain)
{
  for (int k = 0; k < 5; ++k)
  {
    this->pose_middle(0.1 * k);
    this->filter->Update();
    ASSERT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  int binds = 1;
  const auto again = [&]()
  {
    this->filter->Update();
    EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
    EXPECT_EQ(this->filter->GetNumberOfBinds(), ++binds);
  };
  this->filter->SetOrder(3);
  again();
  this->filter->SetBoundary(vtkVariationalSurface::TANGENT);
  again();
  this->filter->SetTangentSource(vtkVariationalSurface::CLAMPED);
  again();
  this->filter->FairOn();
  again();
  this->fixed->Modified();
  again();
  std::ostringstream text;
  this->filter->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("Order: 3\n"));
  EXPECT_THAT(text.str(), HasSubstr("Boundary: tangent\n"));
  EXPECT_THAT(text.str(), HasSubstr("TangentSource: clamped\n"));
  EXPECT_THAT(text.str(), HasSubstr("Fair: on\n"));
}

TEST_F(VariationalSurfaceFilter, WithoutHandlesAPatchIsMadeAnew)
{
  // A square has a dent in its middle. The array "Parameterization" contains the positions of the
  // square without the dent, so fairing removes the dent.
  vtkNew<vtkDoubleArray> domain;
  domain->SetName("Parameterization");
  domain->SetNumberOfComponents(2);
  for (Index v = 0; v < this->mesh.points.rows(); ++v)
  {
    domain->InsertNextTuple2(this->mesh.points(v, 0), this->mesh.points(v, 1));
  }
  this->surface->GetPointData()->AddArray(domain);
  const vtkIdType middle = (squares + 1) * (squares + 1) / 2;
  this->surface->GetPoints()->SetPoint(middle, 0.5, 0.5, -0.7);
  this->filter->FairOn();
  this->filter->Update();
  ASSERT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_NEAR(this->height(0.5, 0.5), 0.0, 1e-13);
  // A load lifts the patch.
  vtkNew<vtkDoubleArray> load;
  load->SetName("Load");
  load->SetNumberOfComponents(3);
  load->SetNumberOfTuples(this->mesh.points.rows());
  for (Index v = 0; v < this->mesh.points.rows(); ++v)
  {
    load->SetTuple3(v, 0.0, 0.0, 100.0);
  }
  this->surface->GetPointData()->AddArray(load);
  this->surface->Modified();
  this->filter->Update();
  EXPECT_GT(this->height(0.5, 0.5), 1e-3);
  // With Fair off, displacements are smoothed. Without handles all displacements are zero, so the
  // dent stays.
  this->surface->GetPointData()->RemoveArray("Load");
  this->filter->FairOff();
  this->filter->Update();
  EXPECT_EQ(this->height(0.5, 0.5), -0.7);
}

TEST_F(VariationalSurfaceFilter, WhatCannotBeIsOneSentence)
{
  this->pose_middle(0.5);
  this->filter->SetBoundary(vtkVariationalSurface::TANGENT);
  this->filter->SetTangentSource(vtkVariationalSurface::GIVEN);
  this->expect_error("no point array 'Tangents'");
  this->filter->SetBoundary(vtkVariationalSurface::REGION);
  this->filter->SetParameterArrayName("Fixed");
  this->expect_error("'Fixed' must have 2 or 3 components");
  this->filter->SetParameterArrayName("");
  this->filter->SetRegionArrayName("Nowhere");
  this->expect_error("region 'middle' needs a point array of labels");
  this->filter->SetRegionArrayName("RegionId");
  this->filter->FairOn();
  this->filter->SetFixedArrayName("Nowhere");
  this->pose->SetPoseJSON(R"({"handles": {"middle": {"mode": "free"}}})");
  this->expect_error("must have at least one fixed point");
}
