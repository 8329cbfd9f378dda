// vtkPoseAlgorithm::PosePoints() writes posed points into the memory of the caller without updating
// the pipeline. The points have the same bits as those of Update().
#include "vtkPoseAlgorithm.h"

#include "TestFilter.h"
#include "conversion.h"
#include "vtkArapAlgorithm.h"
#include "vtkFullARAP.h"
#include "vtkMovingLeastSquaresWarp.h"
#include "vtkPoseHandles.h"
#include "vtkReducedARAP.h"
#include "vtkReducedDynamics.h"
#include "vtkSkinningDeformation.h"
#include "weights_arrays.h"

#include "support/bars.h"
#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
std::string raised(double height)
{
  return R"({"version": 2, "handles": {"left": {"mode": "full"}, "right": {"mode": "position", "translate": [0, )" +
    std::to_string(height) + ", 0]}}}";
}

Points copy_of(vtkDoubleArray* array)
{
  return Eigen::Map<const Points>(array->GetPointer(0), array->GetNumberOfTuples(), 3);
}

class PosePoints : public testing::Test
{
protected:
  PosePoints()
  {
    const test::Rig rig = test::bar();
    this->tets = to_unstructured_grid(rig.mesh.points, rig.mesh.tets);
    this->tets->GetPointData()->AddArray(to_weights_array("Weights", rig.weights, rig.handles));
    this->handles = to_polydata(rig.handles);
  }

  /// Connect the mesh and the handles without a pose. The tests give the pose to PosePoints().
  void connect(vtkPoseAlgorithm* filter) const
  {
    filter->SetInputData(0, this->tets);
    filter->SetInputData(1, this->handles);
  }

  /// Create a filter, call its Update(), and return the posed points.
  template <typename Filter>
  Points by_update(const std::string& text) const
  {
    vtkNew<vtkPoseHandles> pose;
    pose->SetInputData(this->handles);
    pose->SetPoseJSON(text);
    vtkNew<Filter> filter;
    filter->SetInputData(0, this->tets);
    filter->SetInputConnection(1, pose->GetOutputPort());
    filter->Update();
    // There is a result unless the status code is greater than NOT_CONVERGED.
    EXPECT_LE(filter->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED);
    return to_points(vtkPointSet::SafeDownCast(filter->GetOutput())).view();
  }

  vtkSmartPointer<vtkUnstructuredGrid> tets;
  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkDoubleArray> points;
};

template <typename Filter>
class EveryPoseMethod : public PosePoints
{
};
using Filters =
  testing::Types<vtkSkinningDeformation, vtkReducedARAP, vtkFullARAP, vtkMovingLeastSquaresWarp>;
TYPED_TEST_SUITE(EveryPoseMethod, Filters);

TYPED_TEST(EveryPoseMethod, HasTheBitsOfUpdateAndBindsOnce)
{
  vtkNew<TypeParam> filter;
  this->connect(filter);
  ASSERT_TRUE(filter->PosePoints(raised(0.5), this->points)) << filter->GetStatusMessage();
  EXPECT_EQ(copy_of(this->points), this->template by_update<TypeParam>(raised(0.5)));
  EXPECT_THAT(filter->GetReportJSON(), HasSubstr("seconds"));

  if constexpr (std::is_base_of_v<vtkArapAlgorithm, TypeParam>)
  {
    filter->WarmStartOff();
  }
  ASSERT_TRUE(filter->PosePoints(raised(-0.25), this->points));
  EXPECT_EQ(copy_of(this->points), this->template by_update<TypeParam>(raised(-0.25)));
  EXPECT_EQ(filter->GetNumberOfBinds(), 1);
}
} // namespace

TEST_F(PosePoints, WritesIntoTheMemoryOfTheCaller)
{
  const Index rows = this->tets->GetNumberOfPoints();
  std::vector<double> memory(3 * rows, std::nan(""));
  this->points->SetNumberOfComponents(3);
  this->points->SetArray(memory.data(), 3 * rows, 1);
  vtkNew<vtkSkinningDeformation> filter;
  this->connect(filter);
  const vtkMTimeType before = this->points->GetMTime();
  ASSERT_TRUE(filter->PosePoints(raised(1.0), this->points));
  EXPECT_EQ(this->points->GetPointer(0), memory.data());
  EXPECT_GT(this->points->GetMTime(), before);
  EXPECT_EQ(Points(Eigen::Map<const Points>(memory.data(), rows, 3)),
    this->by_update<vtkSkinningDeformation>(raised(1.0)));
}

TEST_F(PosePoints, ResizesAnArrayOfAnotherSize)
{
  vtkNew<vtkSkinningDeformation> filter;
  this->connect(filter);
  this->points->SetNumberOfComponents(1);
  this->points->SetNumberOfTuples(5);
  ASSERT_TRUE(filter->PosePoints("", this->points));
  EXPECT_EQ(this->points->GetNumberOfComponents(), 3);
  EXPECT_EQ(copy_of(this->points), Points(to_points(this->tets).view()));
}

TEST_F(PosePoints, AnEmptyTextIsThePoseOfTheHandles)
{
  vtkNew<vtkPoseHandles> pose;
  pose->SetInputData(this->handles);
  pose->SetPoseJSON(raised(0.75));
  pose->Update();
  vtkNew<vtkSkinningDeformation> filter;
  filter->SetInputData(0, this->tets);
  filter->SetInputData(1, pose->GetOutput());
  ASSERT_TRUE(filter->PosePoints("", this->points));
  EXPECT_EQ(copy_of(this->points), this->by_update<vtkSkinningDeformation>(raised(0.75)));
}

TEST_F(PosePoints, NamesWhatIsWrongWithoutEventsAndStaysUsable)
{
  vtkNew<vtkSkinningDeformation> filter;
  this->connect(filter);
  vtkNew<test::Listener> listener;
  listener->listen(filter);
  const auto message = [&](const std::string& pose, vtkDoubleArray* array)
  {
    EXPECT_FALSE(filter->PosePoints(pose, array));
    EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    return filter->GetStatusMessage();
  };
  EXPECT_THAT(message(raised(1.0), nullptr), HasSubstr("needs an array"));
  EXPECT_THAT(message("{", this->points), HasSubstr("JSON"));
  EXPECT_THAT(message(R"({"handles": {"wing": {}}})", this->points), HasSubstr("wing"));
  EXPECT_THAT(message(R"({"frames": [{"handles": {}}]})", this->points), HasSubstr("one pose"));
  auto* rest = vtkDoubleArray::SafeDownCast(this->tets->GetPoints()->GetData());
  ASSERT_TRUE(rest);
  EXPECT_THAT(message("", rest), HasSubstr("mesh at rest"));
  EXPECT_TRUE(filter->PosePoints(raised(1.0), this->points));
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_TRUE(listener->errors.empty());
  EXPECT_TRUE(listener->warnings.empty());
}

TEST_F(PosePoints, CountsTheWarningsOfABind)
{
  vtkDataArray* weights = this->tets->GetPointData()->GetArray("Weights");
  weights->SetComponent(0, 0, weights->GetComponent(0, 0) + 0.5); // row 0 no longer sums to one
  vtkNew<vtkSkinningDeformation> filter;
  this->connect(filter);
  EXPECT_EQ(filter->GetNumberOfWarnings(), 0);
  ASSERT_TRUE(filter->PosePoints(raised(1.0), this->points));
  EXPECT_EQ(filter->GetNumberOfWarnings(), 1);
  ASSERT_TRUE(filter->PosePoints(raised(0.5), this->points));
  EXPECT_EQ(filter->GetNumberOfWarnings(), 0);
}

TEST_F(PosePoints, ReportsProgressAndCanBeCanceled)
{
  vtkNew<vtkFullARAP> filter;
  this->connect(filter);
  vtkNew<test::Listener> listener;
  listener->listen(filter);
  listener->on_progress = [](vtkAlgorithm* algorithm) { algorithm->SetAbortExecute(1); };
  EXPECT_FALSE(filter->PosePoints(raised(1.0), this->points));
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  EXPECT_FALSE(listener->phases.empty());
  listener->on_progress = nullptr;
  EXPECT_TRUE(filter->PosePoints(raised(1.0), this->points)); // a cancel affects only one call
}

TEST_F(PosePoints, SeesANewMesh)
{
  vtkNew<vtkSkinningDeformation> filter;
  this->connect(filter);
  ASSERT_TRUE(filter->PosePoints("", this->points));
  vtkNew<vtkPoints> moved;
  moved->SetDataTypeToDouble();
  moved->DeepCopy(this->tets->GetPoints());
  moved->SetPoint(0, -1.0, -1.0, -1.0);
  this->tets->SetPoints(moved);
  ASSERT_TRUE(filter->PosePoints("", this->points));
  EXPECT_EQ(filter->GetNumberOfBinds(), 2);
  EXPECT_EQ(copy_of(this->points).row(0), Vec3(-1.0, -1.0, -1.0).transpose());
}

TEST_F(PosePoints, AreNotOfferedByDynamics)
{
  vtkNew<vtkReducedDynamics> filter;
  this->connect(filter);
  EXPECT_FALSE(filter->PosePoints(raised(1.0), this->points));
  EXPECT_THAT(filter->GetStatusMessage(), HasSubstr("vtkReducedDynamics has no PosePoints()"));
}
