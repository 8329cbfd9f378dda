// vtkMovingLeastSquaresWarp needs no weights, binds once for many poses, and rotates flat meshes in
// their plane.
#include "TestFilter.h"

#include "vtkMovingLeastSquaresWarp.h"
#include "vtkPoseHandles.h"

#include "conversion.h"
#include "report_field_data.h"
#include "support/meshes.h"

#include "vtkCellData.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
class MovingLeastSquaresWarp : public testing::Test
{
protected:
  MovingLeastSquaresWarp()
  {
    const TriangleMesh square = test::grid(10, 10);
    this->mesh = to_polydata(square.points, square.triangles);
    Handles list(2);
    list[0].name = "low";
    list[0].head = list[0].tail = Vec3(0, 0, 0);
    list[1].name = "high";
    list[1].head = list[1].tail = Vec3(1, 1, 0);
    this->handles = to_polydata(list);
    this->pose->SetInputData(this->handles);
    this->filter->SetInputData(0, this->mesh);
    this->filter->SetInputConnection(1, this->pose->GetOutputPort());
    this->listener->listen(this->filter);
  }

  Vec3 posed(vtkIdType v)
  {
    double p[3];
    this->filter->GetOutput()->GetPoint(v, p);
    return Vec3(p[0], p[1], p[2]);
  }

  vtkSmartPointer<vtkPolyData> mesh;
  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkPoseHandles> pose;
  vtkNew<vtkMovingLeastSquaresWarp> filter;
  vtkNew<Listener> listener;
};
} // namespace

TEST_F(MovingLeastSquaresWarp, AQuarterTurnWithoutWeights)
{
  // The second point is rotated by 90 degrees about the first point.
  this->pose->SetPoseJSON(R"({"handles": {"high": {"translate": [-2, 0, 0]}}})");
  this->filter->Update();
  ASSERT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK)
    << this->filter->GetStatusMessage();
  for (vtkIdType v = 0; v < this->mesh->GetNumberOfPoints(); ++v)
  {
    double p[3];
    this->mesh->GetPoint(v, p);
    EXPECT_NEAR((this->posed(v) - Vec3(-p[1], p[0], 0)).norm(), 0.0, 1e-12);
  }
  const Report report = read_report(this->filter->GetOutput());
  EXPECT_EQ(report.text("method"), "mls");
  EXPECT_EQ(report.number("planar", -1), 1);
  EXPECT_EQ(report.number("exponent", -1), 1);
}

TEST_F(MovingLeastSquaresWarp, DragsBindOnceAndTheExponentBindsAgain)
{
  for (int k = 0; k < 20; ++k)
  {
    this->pose->SetPoseJSON(
      R"({"handles": {"high": {"translate": [0, )" + std::to_string(0.1 * k) + ", 0]}}}");
    this->filter->Update();
    EXPECT_NEAR((this->posed(120) - Vec3(1, 1 + 0.1 * k, 0)).norm(), 0.0, 1e-12) << "a handle";
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  this->filter->SetExponent(2.0);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 2);
  std::ostringstream text;
  this->filter->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("Exponent: 2"));
}

TEST_F(MovingLeastSquaresWarp, TetsAreWarpedToo)
{
  const TetMesh box = test::tet_box(2, 2, 2);
  this->filter->SetInputData(0, to_unstructured_grid(box.points, box.tets));
  this->pose->SetPoseJSON(
    R"({"handles": {"low": {"translate": [1, 2, 3]}, "high": {"translate": [1, 2, 3]}}})");
  this->filter->Update();
  ASSERT_TRUE(vtkUnstructuredGrid::SafeDownCast(this->filter->GetOutput()));
  EXPECT_EQ(this->filter->GetOutput()->GetNumberOfCells(), 48);
  EXPECT_NEAR((this->posed(0) - Vec3(1, 2, 3)).norm(), 0.0, 1e-12);
  EXPECT_EQ(read_report(this->filter->GetOutput()).number("planar", -1), 0);
}

TEST_F(MovingLeastSquaresWarp, WhatCannotBeIsOneSentence)
{
  this->filter->SetExponent(0.5);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  ASSERT_EQ(this->listener->errors.size(), 1u);
  EXPECT_THAT(this->listener->errors[0], HasSubstr("exponent"));
  this->filter->SetExponent(1.0);
  this->pose->SetPoseJSON(R"({"handles": {"low": {"mode": "free"}, "high": {"mode": "free"}}})");
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
  ASSERT_EQ(this->listener->warnings.size(), 1u);
  EXPECT_THAT(this->listener->warnings[0], HasSubstr("free"));
  vtkNew<vtkPolyData> empty;
  this->filter->SetInputData(0, empty);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
}
