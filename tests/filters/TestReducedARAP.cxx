// vtkReducedARAP (reduced as-rigid-as-possible deformation): one bind for many poses, modes of
// handles, and errors that name the cause.
#include "vtkReducedARAP.h"

#include "TestFilter.h"
#include "arap/reduced_arap.h"
#include "conversion.h"
#include "data_of.h"
#include "report_field_data.h"
#include "vtkPoseHandles.h"
#include "vtkSkinningDeformation.h"
#include "weights_arrays.h"

#include "support/bars.h"
#include "support/meshes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// Pipeline of a bar as tets and as a surface, with its three handles and a pose file.
class ReducedARAPFilter : public testing::Test
{
protected:
  ReducedARAPFilter()
  {
    this->rig = test::bar(12);
    this->tets = to_unstructured_grid(this->rig.mesh.points, this->rig.mesh.tets);
    this->tets->GetPointData()->AddArray(
      to_weights_array("Weights", this->rig.weights, this->rig.handles));
    this->surface = to_polydata(this->rig.mesh.points, boundary_triangles(this->rig.mesh.tets));
    this->surface->GetPointData()->AddArray(
      to_weights_array("Weights", this->rig.weights, this->rig.handles));
    this->handles = test::to_polydata_with_mode_full(this->rig.handles);
    this->pose->SetInputData(this->handles);
    this->filter->SetInputData(0, this->tets);
    this->filter->SetInputConnection(1, this->pose->GetOutputPort());
    this->listener->listen(this->filter);
  }

  Points output() { return to_points(this->filter->GetOutput()).view(); }
  double report(const char* key)
  {
    return this->filter->GetReport().number(key, std::numeric_limits<double>::quiet_NaN());
  }
  void expect_error(const std::string& words)
  {
    this->listener->errors.clear();
    this->filter->Update();
    ASSERT_EQ(this->listener->errors.size(), 1u);
    EXPECT_THAT(this->listener->errors[0], HasSubstr(words));
    EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    EXPECT_EQ(this->filter->GetOutput()->GetNumberOfPoints(), 0);
  }

  test::Rig rig;
  vtkSmartPointer<vtkUnstructuredGrid> tets;
  vtkSmartPointer<vtkPolyData> surface;
  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkPoseHandles> pose;
  vtkNew<vtkReducedARAP> filter;
  vtkNew<test::Listener> listener;
};

std::string drag_right(double x, const char* mode = "position")
{
  return R"({"handles": {"left": {"mode": "full"}, "middle": {"mode": "free"},
    "right": {"mode": ")" +
    std::string(mode) + R"(", "translate": [)" + std::to_string(-0.1 * x) + ", " +
    std::to_string(x) + ", 0]}}}";
}
} // namespace

TEST_F(ReducedARAPFilter, RestStaysAtRestAndEverythingButThePointsIsShared)
{
  this->filter->Update();
  EXPECT_EQ(this->output(), this->rig.mesh.points);
  auto* grid = vtkUnstructuredGrid::SafeDownCast(this->filter->GetOutput());
  ASSERT_NE(grid, nullptr);
  EXPECT_EQ(grid->GetCells(), this->tets->GetCells());
  EXPECT_EQ(
    grid->GetPointData()->GetArray("Weights"), this->tets->GetPointData()->GetArray("Weights"));
  EXPECT_EQ(this->report("counts.tets"), this->rig.mesh.tets.rows());
  EXPECT_EQ(read_report(grid).text("method"), "tetrahedra");
  // If nothing has changed, Update() does not execute the filter again.
  const int starts = this->listener->starts;
  this->filter->Update();
  EXPECT_EQ(this->listener->starts, starts);
}

// A hundred poses with all modes need one bind.
TEST_F(ReducedARAPFilter, AHundredDragsOfAllModesBindOnce)
{
  for (int k = 0; k < 100; ++k)
  {
    const char* modes[] = { "position", "full", "free" };
    this->pose->SetPoseJSON(drag_right(0.01 * k, modes[k / 4 % 3]));
    this->filter->Update();
    ASSERT_TRUE(this->output().allFinite());
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  // Transforms and modes are edited in place, as a widget does.
  this->filter->SetInputData(1, this->handles);
  for (const char* name : { "Transform", "Mode", "Stretch", "Twist" })
  {
    vtkDataArray* array = this->handles->GetCellData()->GetArray(name);
    array->SetComponent(1, 0, 1.0);
    array->Modified();
    this->handles->Modified();
    this->filter->Update();
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  // A change of a pose parameter does not cause a bind. Changes of bind parameters, weights, points
  // and cells do.
  this->filter->SetMaximumIterations(50);
  this->filter->SetTolerance(1e-5);
  this->filter->WarmStartOff();
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  this->filter->SetNumberOfClusters(5);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 2);
  EXPECT_LE(this->report("counts.clusters"), 5);
  this->filter->SetEnergy(vtkReducedARAP::SPOKES_AND_RIMS);
  this->filter->SetNumberOfExtraWeights(4);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 3);
  int binds = 3;
  for (vtkObject* part : std::vector<vtkObject*>{ this->tets->GetPointData()->GetArray("Weights"),
         this->tets->GetPoints()->GetData(), this->tets->GetCells(),
         this->handles->GetPoints()->GetData() })
  {
    part->Modified();
    this->tets->Modified();
    this->handles->Modified();
    this->filter->Update();
    EXPECT_EQ(this->filter->GetNumberOfBinds(), ++binds);
  }
}

TEST_F(ReducedARAPFilter, AnUpstreamFilterThatRunsAgainDoesNotBind)
{
  vtkNew<test::TestFilter> upstream; // this filter makes a shallow copy at each execution
  upstream->SetInputData(this->surface);
  this->filter->SetInputConnection(0, upstream->GetOutputPort());
  this->filter->Update();
  upstream->Modified();
  this->filter->Update();
  EXPECT_EQ(upstream->Executions, 2);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
}

TEST_F(ReducedARAPFilter, ModesAreRespected)
{
  this->pose->SetPoseJSON(drag_right(1.0));
  this->filter->SetMaximumIterations(1000);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK)
    << this->filter->GetStatusMessage();
  const Points bent = this->output();
  double middle = 0.0;
  for (Index v = 0; v < bent.rows(); ++v)
  {
    const Eigen::RowVector3d rest = this->rig.mesh.points.row(v);
    if (rest.x() < 1e-9)
    {
      EXPECT_LT((bent.row(v) - rest).norm(), 1e-12); // mode full
    }
    if ((rest - Eigen::RowVector3d(4, 0.5, 0.5)).norm() < 1e-9)
    {
      EXPECT_LT((bent.row(v) - Eigen::RowVector3d(3.9, 1.5, 0.5)).norm(), 1e-12); // mode position
    }
    if ((rest - Eigen::RowVector3d(2, 0.5, 0.5)).norm() < 1e-9)
    {
      // Mode free: the middle handle moves in the same direction as the right handle, but less far.
      middle = bent(v, 1) - rest.y();
    }
  }
  EXPECT_GT(middle, 0.1);
  EXPECT_LT(middle, 0.9);
  EXPECT_LT(this->report("constraint_residual"), 1e-9);
  EXPECT_GT(this->report("energy"), 0.0);
  EXPECT_GT(this->report("microseconds_per_iteration"), 0.0);

  // Linear blend skinning with the transforms that the filter found reproduces its output.
  vtkDataArray* found = this->filter->GetOutput()->GetFieldData()->GetArray("HandleTransforms");
  ASSERT_NE(found, nullptr);
  ASSERT_EQ(found->GetNumberOfTuples(), 3);
  std::vector<Affine> transforms(3);
  for (int h = 0; h < 3; ++h)
  {
    found->GetTuple(h, transforms[static_cast<std::size_t>(h)].data());
  }
  Skinning skinning;
  ExecutionContext context;
  ASSERT_TRUE(skinning.bind(context, this->rig.weights).ok());
  Points blended;
  ASSERT_TRUE(skinning.linear_blend(context, this->rig.mesh.points, transforms, blended).ok());
  EXPECT_EQ(blended, bent);
}

TEST_F(ReducedARAPFilter, AllFullEqualsTheSkinningFilter)
{
  this->pose->SetPoseJSON(R"({"handles": {
    "right": {"rotate": {"axis": [0, 0, 1], "degrees": 60}, "translate": [0, 1, 0]},
    "middle": {"rotate": {"axis": [1, 1, 0], "degrees": -20}, "scale": 1.2}}})");
  vtkNew<vtkSkinningDeformation> skinning;
  skinning->SetInputData(0, this->tets);
  skinning->SetInputConnection(1, this->pose->GetOutputPort());
  skinning->Update();
  this->filter->Update();
  // The filters compute positions relative to different centers, so round-off differs.
  EXPECT_LT(
    (this->output() - to_points(skinning->GetOutput()).view()).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_F(ReducedARAPFilter, RotationArraysTellWhatEachVertexIsTurnedBy)
{
  const char* turned = R"({"handles": {
    "left": {"rotate": {"axis": [0, 0, 1], "degrees": 50}, "space": "world"},
    "middle": {"mode": "free"}, "right": {"mode": "free"}}})";
  this->pose->SetPoseJSON(turned);
  this->filter->Update();
  EXPECT_FALSE(this->filter->GetOutput()->GetPointData()->HasArray("RotationCluster"));
  EXPECT_FALSE(this->filter->GetOutput()->GetPointData()->HasArray("Rotation"));
  this->filter->RotationArraysOn();
  this->filter->SetMaximumIterations(10000);
  this->filter->SetTolerance(0.0);
  for (const int energy : { vtkReducedARAP::TETRAHEDRA, vtkReducedARAP::SPOKES_AND_RIMS })
  {
    this->filter->SetEnergy(energy);
    this->filter->Update();
    vtkDataSet* posed = this->filter->GetOutput();
    vtkDataArray* clusters = posed->GetPointData()->GetArray("RotationCluster");
    ASSERT_NE(clusters, nullptr);
    ASSERT_EQ(clusters->GetNumberOfTuples(), posed->GetNumberOfPoints());
    std::set<int> seen;
    for (vtkIdType v = 0; v < posed->GetNumberOfPoints(); ++v)
    {
      seen.insert(static_cast<int>(clusters->GetComponent(v, 0)));
      // The whole bar moves with its one constrained handle.
      const Vec3 turn(posed->GetPointData()->GetArray("Rotation")->GetTuple3(v));
      EXPECT_LT((turn - Vec3(0, 0, 50)).norm(), 1e-4) << v;
    }
    EXPECT_EQ(*seen.begin(), 0);
    EXPECT_LE(*seen.rbegin(), this->report("counts.clusters") - 1);
    EXPECT_GT(seen.size(), 4u);
    // If only the pose changes, the output keeps the array object. After another bind, the output
    // has a new array object.
    this->pose->SetPoseJSON(drag_right(0.5));
    this->filter->Update();
    EXPECT_EQ(this->filter->GetOutput()->GetPointData()->GetArray("RotationCluster"), clusters);
    this->pose->SetPoseJSON(turned);
    this->filter->SetNumberOfClusters(this->filter->GetNumberOfClusters() + 5);
    this->filter->Update();
    EXPECT_NE(this->filter->GetOutput()->GetPointData()->GetArray("RotationCluster"), clusters);
  }
}

TEST_F(ReducedARAPFilter, SurfacesBendToo)
{
  this->filter->SetInputData(0, this->surface);
  this->pose->SetPoseJSON(drag_right(0.8));
  for (const auto& [energy, word] :
    { std::pair<int, const char*>{ vtkReducedARAP::AUTO, "spokes_and_rims" },
      { vtkReducedARAP::TRIANGLES, "triangles" } })
  {
    this->filter->SetEnergy(energy);
    this->filter->Update();
    EXPECT_EQ(read_report(this->filter->GetOutput()).text("method"), word);
    EXPECT_LT(this->report("constraint_residual"), 1e-9);
    EXPECT_EQ(this->filter->GetOutput()->GetNumberOfCells(), this->surface->GetNumberOfCells());
  }
  this->filter->SetEnergy(vtkReducedARAP::TETRAHEDRA);
  this->expect_error("needs a tet mesh");
  this->filter->SetInputData(0, this->tets);
  this->filter->SetEnergy(vtkReducedARAP::TRIANGLES);
  this->expect_error("needs a surface");
}

// The filter gives the same bits as the kernel, for any number of threads.
TEST_F(ReducedARAPFilter, ThreadsAndTheKernelAgreeToTheBit)
{
  this->pose->SetPoseJSON(drag_right(0.5));
  this->filter->SetNumberOfThreads(1);
  this->filter->Update();
  const Points one = this->output();
  vtkNew<vtkReducedARAP> other;
  other->SetInputData(0, this->tets);
  other->SetInputConnection(1, this->pose->GetOutputPort());
  other->SetNumberOfThreads(4);
  other->Update();
  EXPECT_EQ(to_points(other->GetOutput()).view(), one);

  ExecutionContext context;
  ReducedArap arap;
  ASSERT_TRUE(arap
                .bind(context, this->rig.mesh.points, this->rig.mesh.tets, this->rig.weights,
                  this->rig.handles)
                .ok());
  Pose bent(3);
  bent[1].mode = HandleMode::free;
  bent[2].mode = HandleMode::position;
  bent[2].transform.col(3) << -0.05, 0.5, 0;
  ASSERT_TRUE(arap.solve(context, bent).usable());
  Points kernel;
  ASSERT_TRUE(arap.deform(context, this->rig.mesh.points, kernel).ok());
  EXPECT_EQ(kernel, one);
}

TEST_F(ReducedARAPFilter, FloatWeightsAndPointsAreTaken)
{
  vtkNew<vtkFloatArray> floats;
  floats->DeepCopy(this->tets->GetPointData()->GetArray("Weights"));
  floats->SetName("Painted");
  this->tets->GetPointData()->AddArray(floats);
  this->filter->SetArrayName("Painted");
  this->pose->SetPoseJSON(drag_right(0.5));
  this->filter->Update();
  EXPECT_TRUE(this->listener->errors.empty());
  EXPECT_LT(this->report("constraint_residual"), 1e-9);
}

TEST_F(ReducedARAPFilter, TooFewIterationsAreNotConverged)
{
  this->pose->SetPoseJSON(drag_right(1.0));
  this->filter->SetMaximumIterations(2);
  this->filter->SetTolerance(1e-9);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED);
  EXPECT_EQ(this->filter->GetOutput()->GetNumberOfPoints(), this->rig.mesh.points.rows());
  EXPECT_TRUE(this->listener->errors.empty());
}

TEST_F(ReducedARAPFilter, WhatDoesNotFitIsNamed)
{
  this->filter->SetArrayName("Wrong");
  this->expect_error("no point array 'Wrong'");
  this->filter->SetArrayName("Weights");

  // The weights are those of another mesh and have too many tuples.
  auto array = to_weights_array("Weights", this->rig.weights, this->rig.handles);
  array->InsertNextTuple3(1, 0, 0);
  this->tets->GetPointData()->AddArray(array);
  this->expect_error("use the mesh for which the weights were computed");

  // The weights are those of other handles: one component has another name.
  array = to_weights_array("Weights", this->rig.weights, this->rig.handles);
  array->SetComponentName(1, "elbow");
  this->tets->GetPointData()->AddArray(array);
  this->expect_error("'elbow'");

  array = to_weights_array("Weights", Weights(this->rig.weights.leftCols(2)), Handles(2));
  this->tets->GetPointData()->AddArray(array);
  this->expect_error("2 components, but there are 3 handles");

  Weights bad = this->rig.weights;
  bad(5, 2) = std::numeric_limits<double>::infinity();
  this->tets->GetPointData()->AddArray(to_weights_array("Weights", bad, this->rig.handles));
  this->expect_error("vertex 5");

  // If rows do not sum to 1, the filter computes a result and issues one warning.
  this->tets->GetPointData()->AddArray(
    to_weights_array("Weights", Weights(0.5 * this->rig.weights), this->rig.handles));
  this->listener->errors.clear();
  this->filter->Update();
  EXPECT_TRUE(this->listener->errors.empty());
  ASSERT_EQ(this->listener->warnings.size(), 1u);
  EXPECT_THAT(this->listener->warnings[0], HasSubstr("0.5"));
  EXPECT_NEAR(this->report("row_sum_error"), 0.5, 1e-12);

  // A failure of an upstream filter makes this filter fail. After the upstream filter is repaired,
  // this filter works again.
  this->pose->SetPoseJSON(R"({"handles": {"elbow": {}}})");
  vtkNew<test::Listener> quiet;
  quiet->listen(this->pose);
  this->expect_error("'elbow'");
  this->pose->SetPoseJSON("");
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
}

TEST_F(ReducedARAPFilter, AnAbortEndsTheBindAndTheNextUpdateBinds)
{
  this->listener->on_progress = [](vtkAlgorithm* algorithm) { algorithm->SetAbortExecute(1); };
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  EXPECT_EQ(this->filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(this->listener->errors.empty());
  this->listener->on_progress = nullptr;
  this->filter->SetAbortExecute(0);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  EXPECT_EQ(this->output(), this->rig.mesh.points);
}

TEST_F(ReducedARAPFilter, PrintSelfNamesEveryParameter)
{
  std::ostringstream text;
  this->filter->Print(text);
  for (const char* word : { "ArrayName: Weights", "NumberOfBinds: 0", "Energy: auto",
         "NumberOfClusters: 0", "NumberOfExtraWeights: 0", "MaximumIterations: 100",
         "Tolerance: 1e-06", "WarmStart: on", "MixedPrecision: on", "RotationArrays: off" })
  {
    EXPECT_THAT(text.str(), HasSubstr(word));
  }
}

TEST_F(ReducedARAPFilter, ATimeBudgetIsReportedAndReplayed)
{
  this->pose->SetPoseJSON(drag_right(1.0));
  this->filter->SetTolerance(1e-15);
  this->filter->SetMaximumIterations(1000000);
  this->filter->SetTimeBudget(5.0);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED);
  EXPECT_GE(this->report("residual"), 0.0);
  const Points first = this->output();
  vtkNew<vtkReducedARAP> again;
  again->SetInputData(0, this->tets);
  again->SetInputConnection(1, this->pose->GetOutputPort());
  again->SetTolerance(0.0);
  again->SetMaximumIterations(static_cast<int>(this->report("iterations")));
  again->Update();
  EXPECT_EQ(to_points(again->GetOutput()).view(), first);
}

TEST_F(ReducedARAPFilter, MixedPrecisionChangesTheWayNotTheResult)
{
  this->pose->SetPoseJSON(drag_right(1.0));
  this->filter->SetTolerance(1e-12);
  this->filter->SetMaximumIterations(1000);
  this->filter->SetWarmStart(false);
  this->filter->Update();
  const Points mixed = this->output();
  const double energy = this->report("energy");
  EXPECT_GT(this->report("single_precision_iterations"), 0.0);
  EXPECT_LT(this->report("single_precision_iterations"), this->report("iterations"));
  this->filter->MixedPrecisionOff();
  this->filter->Update();
  EXPECT_EQ(this->report("single_precision_iterations"), 0.0);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
  EXPECT_NEAR(this->report("energy"), energy, 1e-9 * energy);
  EXPECT_LT((this->output() - mixed).cwiseAbs().maxCoeff(), 1e-4);
  this->filter->MixedPrecisionOn();
  this->filter->Update();
  EXPECT_EQ(this->output(), mixed);
}

TEST_F(ReducedARAPFilter, EigenmodesAreABindParameterAndLowerTheEnergy)
{
  this->pose->SetPoseJSON(drag_right(1.0));
  this->filter->Update();
  const double plain = this->report("energy");
  this->filter->SetNumberOfExtraWeights(15);
  this->filter->SetExtraWeightsKind(vtkReducedARAP::EIGENMODES);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 2);
  EXPECT_EQ(this->report("counts.extra_weights"), 15.0);
  EXPECT_LT(this->report("energy"), plain);
}

TEST_F(ReducedARAPFilter, ReflectionsAndCollapsedScalesAreNamedAndDestroyNothing)
{
  Handles list;
  std::vector<Index> cells;
  ASSERT_TRUE(to_handles(this->handles, list, &cells).ok());
  vtkNew<vtkSkinningDeformation> linear, dual;
  dual->SetMethod(vtkSkinningDeformation::DUAL_QUATERNION);
  vtkNew<test::Listener> quiet;
  for (vtkPoseAlgorithm* algorithm :
    std::initializer_list<vtkPoseAlgorithm*>{ this->filter, linear, dual })
  {
    algorithm->SetInputData(0, this->tets);
    quiet->listen(algorithm);
    // The transforms are a reflection, a reflection by a negative scale, a collapse to a plane, a
    // collapse to a point, and a valid scale.
    for (const Vec3& scale :
      { Vec3(1, 1, -1), Vec3(-2, -2, -2), Vec3(1, 0, 1), Vec3(0, 0, 0), Vec3(2, 1, 0.5) })
    {
      Pose bent(3);
      bent[2].transform.leftCols<3>() = scale.asDiagonal();
      bent[1].mode = algorithm == this->filter ? HandleMode::free : HandleMode::full;
      vtkNew<vtkPolyData> posed;
      posed->ShallowCopy(this->handles);
      set_pose(posed, cells, bent);
      algorithm->SetInputData(1, posed);
      quiet->warnings.clear();
      algorithm->Update();
      EXPECT_TRUE(algorithm->GetStatus() == vtkBindposeAlgorithm::OK ||
        algorithm->GetStatus() == vtkBindposeAlgorithm::NOT_CONVERGED);
      const Points result = to_points(algorithm->GetOutput()).view();
      ASSERT_EQ(result.rows(), this->rig.mesh.points.rows());
      EXPECT_TRUE(result.allFinite());
      EXPECT_LT(result.cwiseAbs().maxCoeff(), 100.0);
      const double volume = scale.prod();
      const std::string words = volume < 0.0 ? "are reflections" : "scale a direction to zero";
      const bool is_reported = std::any_of(quiet->warnings.begin(), quiet->warnings.end(),
        [&](const std::string& warning)
        {
          return warning.find(words) != std::string::npos &&
            warning.find("'" + list[2].name + "'") != std::string::npos;
        });
      EXPECT_EQ(is_reported, volume <= 0.0) << scale.transpose();
    }
  }
}
