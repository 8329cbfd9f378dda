// vtkReducedDynamics provides time steps. The result for a time does not depend on earlier
// requests.
#include "vtkReducedDynamics.h"

#include "TestFilter.h"
#include "conversion.h"
#include "data_of.h"
#include "report_field_data.h"
#include "vtkPoseHandles.h"
#include "vtkReducedARAP.h"
#include "weights_arrays.h"

#include "support/bars.h"
#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// The right end of the bar is moved aside for the first tenth of a second, then released.
const char* const drawn_and_let_go = R"({"fps": 10, "frames": [
  {"handles": {"middle": {"mode": "free"}, "right": {"mode": "position", "translate": [0, 1, 0]}}},
  {"handles": {"middle": {"mode": "free"}, "right": {"mode": "free"}}}]})";

class ReducedDynamicsFilter : public testing::Test
{
protected:
  ReducedDynamicsFilter()
  {
    this->rig = test::bar();
    this->tets = to_unstructured_grid(this->rig.mesh.points, this->rig.mesh.tets);
    this->tets->GetPointData()->AddArray(
      to_weights_array("Weights", this->rig.weights, this->rig.handles));
    this->handles = test::to_polydata_with_mode_full(this->rig.handles);
    this->pose->SetInputData(this->handles);
    this->pose->SetPoseJSON(drawn_and_let_go);
    this->connect(this->filter);
    this->listener->listen(this->filter);
  }

  void connect(vtkReducedDynamics* dynamics)
  {
    dynamics->SetInputData(0, this->tets);
    dynamics->SetInputConnection(1, this->pose->GetOutputPort());
    dynamics->SetTimeStep(0.02);
    dynamics->SetStiffness(100.0);
    dynamics->SetNumberOfSteps(50);
  }
  static Points at(vtkReducedDynamics* dynamics, double time)
  {
    dynamics->UpdateTimeStep(time);
    return to_points(vtkPointSet::SafeDownCast(dynamics->GetOutput())).view();
  }
  double report(const char* key)
  {
    return read_report(this->filter->GetOutput()).number(key, -1.0);
  }

  test::Rig rig;
  vtkSmartPointer<vtkUnstructuredGrid> tets;
  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkPoseHandles> pose;
  vtkNew<vtkReducedDynamics> filter;
  vtkNew<test::Listener> listener;
};
} // namespace

TEST_F(ReducedDynamicsFilter, OffersItsSteps)
{
  this->filter->UpdateInformation();
  vtkInformation* info = this->filter->GetOutputInformation(0);
  ASSERT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 51);
  EXPECT_DOUBLE_EQ(info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE())[1], 1.0);
}

TEST_F(ReducedDynamicsFilter, BeginsWhereReducedARAPIs)
{
  vtkNew<vtkReducedARAP> still;
  still->SetInputData(0, this->tets);
  still->SetInputConnection(1, this->pose->GetOutputPort());
  still->SetMaximumIterations(1000);
  still->Update();
  const Points expected = to_points(vtkPointSet::SafeDownCast(still->GetOutput())).view();
  EXPECT_EQ(at(this->filter, 0.0), expected);
  EXPECT_EQ(this->report("steps"), 0.0);
}

TEST_F(ReducedDynamicsFilter, TheSameTimeGivesTheSameBitsInAnyOrder)
{
  std::vector<Points> forward;
  for (int step = 0; step <= 20; ++step)
  {
    forward.push_back(at(this->filter, 0.02 * step));
    EXPECT_EQ(this->report("steps"), step);
    EXPECT_NEAR(this->report("time"), 0.02 * step, 1e-12);
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  EXPECT_GT((forward[20] - forward[5]).cwiseAbs().maxCoeff(), 1e-3); // the body moves
  EXPECT_EQ(at(this->filter, 0.14), forward[7]);
  EXPECT_EQ(at(this->filter, 0.4), forward[20]);
  // A time between two steps gives the result of the earlier step.
  EXPECT_EQ(at(this->filter, 0.15), forward[7]);
  vtkNew<vtkReducedDynamics> fresh;
  this->connect(fresh);
  fresh->SetNumberOfThreads(1);
  EXPECT_EQ(at(fresh, 0.26), forward[13]);
  // Steps are requested by their number, without times.
  vtkNew<vtkReducedDynamics> counted;
  this->connect(counted);
  counted->SetStep(13);
  counted->Update();
  EXPECT_EQ(to_points(vtkPointSet::SafeDownCast(counted->GetOutput())).view(), forward[13]);
}

TEST_F(ReducedDynamicsFilter, WhatChangesStartsAnew)
{
  const Points before = at(this->filter, 0.3);
  this->filter->SetGravity(0, -5, 0);
  const Points heavy = at(this->filter, 0.3);
  EXPECT_LT(heavy.col(1).mean(), before.col(1).mean() - 0.01);
  this->filter->SetGravity(0, 0, 0);
  EXPECT_EQ(at(this->filter, 0.3), before);
  this->pose->SetPoseJSON(R"({"handles": {}})");
  EXPECT_EQ(at(this->filter, 0.3), this->rig.mesh.points);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  this->tets->GetPoints()->GetData()->Modified();
  this->tets->Modified();
  this->pose->SetPoseJSON(drawn_and_let_go);
  EXPECT_EQ(at(this->filter, 0.3), before);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 2);
}

TEST_F(ReducedDynamicsFilter, MixedPrecisionChangesNoMotion)
{
  const Points mixed = at(this->filter, 0.3);
  EXPECT_GT(this->report("single_precision_iterations"), 0.0);
  this->filter->MixedPrecisionOff();
  const Points in_double = at(this->filter, 0.3); // MixedPrecisionOff() restarts at step 0
  EXPECT_EQ(this->report("single_precision_iterations"), 0.0);
  EXPECT_EQ(this->report("steps"), 15.0);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  EXPECT_LT((in_double - mixed).cwiseAbs().maxCoeff(), 1e-2);
  this->filter->MixedPrecisionOn();
  EXPECT_EQ(at(this->filter, 0.3), mixed);
}

TEST_F(ReducedDynamicsFilter, InteractiveStepsOnceAnUpdate)
{
  this->filter->InteractiveOn();
  for (int step = 0; step < 5; ++step)
  {
    this->filter->Modified();
    this->filter->Update();
    EXPECT_EQ(this->report("steps"), step);
  }
  this->filter->Restart();
  this->filter->Update();
  EXPECT_EQ(this->report("steps"), 0.0);
}

TEST_F(ReducedDynamicsFilter, BadNumbersAndPosesEndIt)
{
  this->filter->SetStiffness(0.0);
  this->filter->Update();
  ASSERT_EQ(this->listener->errors.size(), 1u);
  EXPECT_THAT(this->listener->errors[0], HasSubstr("stiffness"));
  EXPECT_EQ(this->filter->GetOutput()->GetNumberOfPoints(), 0);
  this->filter->SetStiffness(100.0);
  EXPECT_EQ(at(this->filter, 0.1).rows(), this->rig.mesh.points.rows());
  // The expression becomes invalid during the motion.
  this->pose->SetPoseJSON(
    R"json({"handles": {"right": {"translate": [0, "sqrt(0.1 - t)", 0]}}})json");
  vtkNew<test::Listener> upstream;
  upstream->listen(this->pose);
  EXPECT_EQ(at(this->filter, 0.3).rows(), 0);
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  EXPECT_THAT(this->filter->GetStatusMessage(), HasSubstr("sqrt(0.1 - t)"));
  EXPECT_EQ(at(this->filter, 0.04).rows(), this->rig.mesh.points.rows());
}
