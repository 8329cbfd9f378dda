// vtkFullARAP (full as-rigid-as-possible deformation) needs no weights, binds once for many poses,
// and finds regions by their labels. Error messages name the cause.
#include "vtkFullARAP.h"

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
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
/// Pipeline of a bar with regions at its ends and in the middle, as tets and as a surface.
class FullARAPFilter : public testing::Test
{
protected:
  FullARAPFilter()
  {
    this->bar = test::labeled_bar(8);
    this->tets = to_unstructured_grid(this->bar.mesh.points, this->bar.mesh.tets);
    this->surface = to_polydata(this->bar.mesh.points, boundary_triangles(this->bar.mesh.tets));
    this->labels->SetName("RegionId");
    for (const Index label : this->bar.labels)
    {
      this->labels->InsertNextValue(static_cast<int>(label));
    }
    this->tets->GetPointData()->AddArray(this->labels);
    this->surface->GetPointData()->AddArray(this->labels);
    this->pose->SetInputData(to_polydata(this->bar.handles));
    this->filter->SetInputData(0, this->tets);
    this->filter->SetInputConnection(1, this->pose->GetOutputPort());
    this->listener->listen(this->filter);
  }

  Vec3 posed(vtkIdType v)
  {
    double p[3];
    this->filter->GetOutput()->GetPoint(v, p);
    return Vec3(p[0], p[1], p[2]);
  }

  test::LabeledBar bar;
  vtkSmartPointer<vtkUnstructuredGrid> tets;
  vtkSmartPointer<vtkPolyData> surface;
  vtkNew<vtkIntArray> labels;
  vtkNew<vtkPoseHandles> pose;
  vtkNew<vtkFullARAP> filter;
  vtkNew<Listener> listener;
};

std::string lifted(double height)
{
  return R"({"handles": {"right": {"translate": [-1, 0, )" + std::to_string(height) +
    R"(], "rotate": {"axis": [0, 1, 0], "degrees": -60}}, "middle": {"mode": "free"}}})";
}
} // namespace

TEST_F(FullARAPFilter, HandlesHaveTheirTransformsOnTetsAndSurfaces)
{
  for (const bool volume : { true, false })
  {
    this->filter->SetInputData(
      0, volume ? static_cast<vtkPointSet*>(this->tets) : this->surface.Get());
    this->pose->SetPoseJSON(lifted(1.0));
    this->filter->Update();
    ASSERT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK)
      << this->filter->GetStatusMessage();
    const Report& report = this->filter->GetReport();
    EXPECT_EQ(report.text("method"), volume ? "tetrahedra" : "spokes_and_rims");
    EXPECT_GT(report.number("energy", 0), 0.0);
    EXPECT_GE(report.number("iterations", 0), 1);
    EXPECT_GT(report.number("microseconds_per_iteration", 0), 0.0);
    EXPECT_LT(report.number("constraint_residual", 1), 1e-9);
    EXPECT_EQ(report.number("counts.handles", 0), 3);
    EXPECT_GE(report.number("seconds.solve", -1), 0.0);
    for (vtkIdType v = 0; v < this->tets->GetNumberOfPoints(); ++v)
    {
      if (this->bar.labels[static_cast<std::size_t>(v)] == 1)
      {
        EXPECT_LT((this->posed(v) - Vec3(this->bar.mesh.points.row(v))).norm(), 1e-14);
      }
    }
  }
}

TEST_F(FullARAPFilter, RotationArraysTellWhatEachVertexIsTurnedBy)
{
  this->pose->SetPoseJSON(R"({"handles": {
    "left": {"rotate": {"axis": [0, 0, 1], "degrees": 40}}, "middle": {"mode": "free"},
    "right": {"mode": "free"}}})"); // the whole bar moves with the handle "left"
  this->filter->RotationArraysOn();
  this->filter->SetMaximumIterations(10000);
  this->filter->SetTolerance(0.0);
  for (const int energy : { vtkFullARAP::TETRAHEDRA, vtkFullARAP::SPOKES_AND_RIMS })
  {
    this->filter->SetEnergy(energy);
    this->filter->Update();
    vtkDataArray* turns = this->filter->GetOutput()->GetPointData()->GetArray("Rotation");
    ASSERT_NE(turns, nullptr);
    ASSERT_TRUE(this->filter->GetOutput()->GetPointData()->HasArray("RotationCluster"));
    for (vtkIdType v = 0; v < turns->GetNumberOfTuples(); ++v)
    {
      EXPECT_LT((Vec3(turns->GetTuple3(v)) - Vec3(0, 0, 40)).norm(), 1e-4) << v;
    }
  }
}

TEST_F(FullARAPFilter, DragsBindOnceAndBindParametersBindAgain)
{
  for (int k = 0; k < 10; ++k)
  {
    this->pose->SetPoseJSON(lifted(0.1 * k));
    this->filter->Update();
    ASSERT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  this->filter->SetTolerance(1e-4);
  this->filter->SetMaximumIterations(50);
  this->filter->SetAndersonWindow(0);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  this->filter->SetEnergy(vtkFullARAP::SPOKES);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 2);
  EXPECT_EQ(read_report(this->filter->GetOutput()).text("method"), "spokes");
  this->labels->Modified();
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 3);
  std::ostringstream text;
  this->filter->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("Energy: spokes\n"));
  EXPECT_THAT(text.str(), HasSubstr("AndersonWindow: 0"));
}

TEST_F(FullARAPFilter, WhatCannotBeIsOneSentence)
{
  this->pose->SetPoseJSON(lifted(1.0));
  const auto expect_error = [&](const char* sentence)
  {
    this->listener->errors.clear();
    this->filter->Update();
    EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    ASSERT_EQ(this->listener->errors.size(), 1u);
    EXPECT_THAT(this->listener->errors[0], HasSubstr(sentence));
  };
  this->filter->SetEnergy(vtkFullARAP::TRIANGLES);
  expect_error("energy triangles needs a surface");
  this->filter->SetEnergy(vtkFullARAP::AUTO);
  this->filter->SetRegionArrayName("Nowhere");
  expect_error("region 'left' needs a point array of labels");
  this->filter->SetRegionArrayName("RegionId");
  this->filter->SetMaximumIterations(1);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED);
  EXPECT_EQ(this->filter->GetOutput()->GetNumberOfPoints(), this->tets->GetNumberOfPoints());
}
