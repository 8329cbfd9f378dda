// vtkCrowdDeformation: each instance of a crowd equals the result of vtkReducedARAP for its pose.
#include "vtkCrowdDeformation.h"

#include "TestFilter.h"
#include "conversion.h"
#include "pose/pose_file.h"
#include "report_field_data.h"
#include "vtkPoseHandles.h"
#include "vtkReducedARAP.h"
#include "weights_arrays.h"

#include "support/bars.h"
#include "support/meshes.h"

#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
constexpr int count = 4;

class CrowdDeformationFilter : public testing::Test
{
protected:
  CrowdDeformationFilter()
  {
    this->rig = test::bar();
    this->tets = to_unstructured_grid(this->rig.mesh.points, this->rig.mesh.tets);
    this->tets->GetPointData()->AddArray(
      to_weights_array("Weights", this->rig.weights, this->rig.handles));
    this->handles = to_polydata(this->rig.handles);
    this->filter->SetInputData(0, this->tets);
    this->filter->SetInputData(1, this->handles);
    // vtkCrowdDeformation and vtkReducedARAP start from different rotations and converge along
    // different paths. A small tolerance makes their results comparable.
    this->filter->SetTolerance(1e-12);
    this->filter->SetMaximumIterations(1000);
    this->listener->listen(this->filter);
  }

  /// Return a pose in which the right end is lifted by i tenths and the middle has mode free.
  Pose pose(int i) const
  {
    Pose result(3);
    result[0].mode = HandleMode::full;
    result[1].mode = HandleMode::free;
    result[2].mode = HandleMode::position;
    result[2].transform.col(3) << 0.0, 0.1 * i, 0.05 * i;
    return result;
  }
  vtkSmartPointer<vtkPolyData> posed_handles(int i) const
  {
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->ShallowCopy(this->handles);
    Handles list;
    std::vector<Index> cells;
    EXPECT_TRUE(to_handles(this->handles, list, &cells).ok());
    set_pose(result, cells, this->pose(i));
    return result;
  }
  /// Add arrays with one row per instance, which describe the poses that pose() returns: the
  /// translations of the right handle, and the modes of all handles.
  template <typename Attributes>
  void add_rows(Attributes* arrays, int rows) const
  {
    vtkNew<vtkDoubleArray> right;
    right->SetName(this->rig.handles[2].name.c_str());
    right->SetNumberOfComponents(3);
    vtkNew<vtkIntArray> modes;
    modes->SetName("Mode");
    modes->SetNumberOfComponents(3);
    for (int i = 0; i < rows; ++i)
    {
      right->InsertNextTuple3(0.0, 0.1 * i, 0.05 * i);
      modes->InsertNextTuple3(0, 2, 1);
    }
    arrays->AddArray(right);
    arrays->AddArray(modes);
  }
  Points alone(int i) const
  {
    vtkNew<vtkReducedARAP> arap;
    arap->SetInputData(0, this->tets);
    arap->SetInputData(1, this->posed_handles(i));
    arap->SetTolerance(1e-12);
    arap->SetMaximumIterations(1000);
    arap->Update();
    return to_points(arap->vtkBindposeAlgorithm::GetOutput()).view();
  }
  Points instance(int i)
  {
    auto* all = vtkPartitionedDataSetCollection::SafeDownCast(this->filter->GetOutput());
    auto* data = all ? vtkPointSet::SafeDownCast(all->GetPartition(i, 0)) : nullptr;
    return data ? Points(to_points(data).view()) : Points();
  }
  double report(const char* key) { return this->filter->GetReport().number(key, -1.0); }

  test::Rig rig;
  vtkSmartPointer<vtkUnstructuredGrid> tets;
  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkCrowdDeformation> filter;
  vtkNew<test::Listener> listener;
};
} // namespace

TEST_F(CrowdDeformationFilter, PosesInstancesAsReducedARAPWouldWhateverTheyAreToldBy)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetNumberOfPartitionedDataSets(count);
  for (int i = 0; i < count; ++i)
  {
    blocks->SetBlock(i, this->posed_handles(i));
    collection->SetPartition(i, 0, this->posed_handles(i));
  }
  vtkNew<vtkTable> table;
  this->add_rows(table->GetRowData(), count);
  for (vtkDataObject* instances :
    std::initializer_list<vtkDataObject*>{ blocks, collection, table })
  {
    this->filter->SetInstancesData(instances);
    this->filter->Update();
    ASSERT_EQ(this->filter->GetStatus(), vtkCrowdDeformation::OK)
      << this->filter->GetStatusMessage();
    EXPECT_EQ(this->report("counts.instances"), count);
    for (int i = 0; i < count; ++i)
    {
      ASSERT_EQ(this->instance(i).rows(), this->rig.mesh.points.rows());
      EXPECT_LT((this->instance(i) - this->alone(i)).cwiseAbs().maxCoeff(), 1e-5)
        << instances->GetClassName() << " " << i;
    }
    // All instances share the array objects of the weights and the cells.
    auto* all = vtkPartitionedDataSetCollection::SafeDownCast(this->filter->GetOutput());
    auto* last = vtkUnstructuredGrid::SafeDownCast(all->GetPartition(count - 1, 0));
    EXPECT_EQ(last->GetCells(), this->tets->GetCells());
    EXPECT_EQ(last->GetPointData()->GetArray("Weights"), this->tets->GetPointData()->GetArray(0));
    EXPECT_EQ(last->GetFieldData()->GetArray("HandleTransforms")->GetNumberOfTuples(), 3);
    EXPECT_STREQ(all->GetMetaData(count - 1)->Get(vtkCompositeDataSet::NAME()), "instance 3");
  }
  EXPECT_GT(this->report("seconds.solve"), 0.0);
  // A solve in double precision gives the same result.
  EXPECT_GT(this->report("single_precision_iterations"), 0.0);
  this->filter->MixedPrecisionOff();
  this->filter->WarmStartOff();
  this->filter->Update();
  EXPECT_EQ(this->report("single_precision_iterations"), 0.0);
  for (int i = 0; i < count; ++i)
  {
    EXPECT_LT((this->instance(i) - this->alone(i)).cwiseAbs().maxCoeff(), 1e-5) << i;
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
}

TEST_F(CrowdDeformationFilter, PlacesInstances)
{
  vtkNew<vtkPolyData> points;
  vtkNew<vtkPoints> at;
  for (int i = 0; i < count; ++i)
  {
    at->InsertNextPoint(5.0 * i, 1.0, -i);
  }
  points->SetPoints(at);
  this->add_rows(points->GetPointData(), count);
  this->filter->SetInstancesData(points);
  this->filter->Update();
  for (int i = 0; i < count; ++i)
  {
    const Points expected = this->alone(i).rowwise() + Eigen::RowVector3d(5.0 * i, 1.0, -i);
    EXPECT_LT((this->instance(i) - expected).cwiseAbs().maxCoeff(), 1e-5) << i;
  }
  // The array Placement takes precedence over the points. Each placement rotates by 90 degrees and
  // doubles the size.
  vtkNew<vtkDoubleArray> places;
  places->SetName("Placement");
  places->SetNumberOfComponents(12);
  Affine place;
  place << 0, -2, 0, 1, 2, 0, 0, 2, 0, 0, 2, 3;
  for (int i = 0; i < count; ++i)
  {
    places->InsertNextTuple(place.data());
  }
  points->GetPointData()->AddArray(places);
  this->filter->Update();
  for (int i = 0; i < count; ++i)
  {
    const Points expected =
      (this->alone(i) * place.leftCols<3>().transpose()).rowwise() + place.col(3).transpose();
    EXPECT_LT((this->instance(i) - expected).cwiseAbs().maxCoeff(), 1e-5) << i;
  }
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
}

TEST_F(CrowdDeformationFilter, AppendsThemInOne)
{
  vtkNew<vtkTable> table;
  this->add_rows(table->GetRowData(), count);
  this->filter->SetInstancesData(table);
  this->filter->SetOutputType(vtkCrowdDeformation::APPENDED);
  this->filter->Update();
  auto* all = vtkUnstructuredGrid::SafeDownCast(this->filter->GetOutput());
  ASSERT_TRUE(all);
  const vtkIdType points = this->tets->GetNumberOfPoints();
  ASSERT_EQ(all->GetNumberOfPoints(), count * points);
  EXPECT_EQ(all->GetNumberOfCells(), count * this->tets->GetNumberOfCells());
  EXPECT_EQ(read_report(all).number("counts.instances", -1.0), count);
  vtkDataArray* numbers = all->GetPointData()->GetArray("Instance");
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers->GetComponent(2 * points - 1, 0), 1);
  EXPECT_EQ(numbers->GetComponent(2 * points, 0), 2);
  const Points together = to_points(all).view();
  EXPECT_LT((together.middleRows(3 * points, points) - this->alone(3)).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_EQ(this->tets->GetPointData()->GetArray("Instance"), nullptr);
}

TEST_F(CrowdDeformationFilter, NormalsOfSurfacesFollow)
{
  vtkSmartPointer<vtkPolyData> surface;
  {
    const TriangleMesh sphere = test::sphere(2);
    surface = to_polydata(sphere.points, sphere.triangles);
  }
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SplittingOff();
  normals->Update();
  surface = normals->GetOutput();
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Weights");
  weights->SetNumberOfComponents(3);
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v)
  {
    weights->InsertNextTuple3(1, 0, 0);
  }
  surface->GetPointData()->AddArray(weights);
  this->filter->SetInputData(0, surface);
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> turn;
  turn->SetName(this->rig.handles[0].name.c_str());
  turn->SetNumberOfComponents(12);
  const double quarter[12] = { 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0 };
  turn->InsertNextTuple(quarter);
  table->GetRowData()->AddArray(turn);
  this->filter->SetInstancesData(table);
  this->filter->Update();
  auto* all = vtkPartitionedDataSetCollection::SafeDownCast(this->filter->GetOutput());
  auto* posed = vtkPolyData::SafeDownCast(all->GetPartition(0, 0));
  ASSERT_TRUE(posed && posed->GetPointData()->GetNormals());
  vtkDataArray* rest = surface->GetPointData()->GetNormals();
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v)
  {
    const double* n = posed->GetPointData()->GetNormals()->GetTuple3(v);
    EXPECT_NEAR(n[0], -rest->GetComponent(v, 1), 1e-5);
    EXPECT_NEAR(n[1], rest->GetComponent(v, 0), 1e-5);
  }
}

TEST_F(CrowdDeformationFilter, SaysWhatIsWrong)
{
  const auto message = [&](vtkDataObject* instances)
  {
    this->filter->SetInstancesData(instances);
    this->filter->Update();
    EXPECT_EQ(this->filter->GetStatus(), vtkCrowdDeformation::INVALID_INPUT);
    auto* all = vtkPartitionedDataSetCollection::SafeDownCast(this->filter->GetOutput());
    EXPECT_EQ(all->GetNumberOfPartitionedDataSets(), 0u);
    return this->filter->GetStatusMessage();
  };
  vtkNew<vtkTable> table;
  EXPECT_THAT(message(table), HasSubstr("has no instances"));
  vtkNew<vtkMultiBlockDataSet> blocks;
  EXPECT_THAT(message(blocks), HasSubstr("has no instances"));

  const std::string name = this->rig.handles[2].name;
  vtkNew<vtkDoubleArray> right;
  right->SetName(name.c_str());
  right->SetNumberOfComponents(4);
  right->InsertNextTuple4(0, 0, 0, 0);
  table->GetRowData()->AddArray(right);
  EXPECT_THAT(message(table), HasSubstr("'" + name + "' of the instances has 4 components"));
  right->SetNumberOfComponents(3);
  right->SetNumberOfTuples(2);
  right->SetTuple3(0, 0, 0, 0);
  right->SetTuple3(1, 0, std::nan(""), 0);
  right->Modified();
  EXPECT_THAT(
    message(table), HasSubstr("instance 1: the transform, stretch or twist of handle '" + name));
  right->SetTuple3(1, 0, 0, 0);
  vtkNew<vtkIntArray> modes;
  modes->SetName("Mode");
  modes->SetNumberOfComponents(2);
  modes->SetNumberOfTuples(2);
  table->GetRowData()->AddArray(modes);
  EXPECT_THAT(message(table), HasSubstr("Mode of the instances has 2 components"));
  modes->SetNumberOfComponents(3);
  modes->SetNumberOfTuples(2);
  modes->Fill(0);
  modes->SetComponent(1, 2, 7);
  modes->Modified();
  EXPECT_THAT(message(table), HasSubstr("instance 1: handle '" + name + "' has an unknown Mode"));
  modes->Fill(0);
  vtkNew<vtkDoubleArray> places;
  places->SetName("Placement");
  places->SetNumberOfComponents(3);
  places->InsertNextTuple3(0, 0, 0);
  places->InsertNextTuple3(0, 0, std::nan(""));
  table->GetRowData()->AddArray(places);
  EXPECT_THAT(message(table), HasSubstr("instance 1: its placement"));

  // The handles of instance 1 differ from those of the mesh.
  blocks->SetBlock(0, this->posed_handles(0));
  Handles others = this->rig.handles;
  others[1].name = "another";
  blocks->SetBlock(1, to_polydata(others));
  EXPECT_THAT(
    message(blocks), HasSubstr("instance 1: its handles differ from the handles of the mesh"));
  blocks->SetBlock(1, this->tets);
  EXPECT_THAT(message(blocks),
    HasSubstr("instance 1: expected a vtkPolyData with handles, got a vtkUnstructuredGrid"));
  EXPECT_FALSE(this->listener->errors.empty());

  // The filter works again after the failure. It warns if no array has the name of a handle.
  vtkNew<vtkTable> strange;
  vtkNew<vtkDoubleArray> other;
  other->SetName("no handle");
  other->InsertNextValue(0.0);
  strange->GetRowData()->AddArray(other);
  this->listener->warnings.clear();
  this->filter->SetInstancesData(strange);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkCrowdDeformation::OK);
  ASSERT_FALSE(this->listener->warnings.empty());
  EXPECT_THAT(this->listener->warnings.back(), HasSubstr("has the name of a handle"));
}

TEST_F(CrowdDeformationFilter, EndsWhenAskedTo)
{
  vtkNew<vtkTable> table;
  this->add_rows(table->GetRowData(), count);
  this->filter->SetInstancesData(table);
  this->listener->on_progress = [](vtkAlgorithm* algorithm) { algorithm->SetAbortExecute(1); };
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkCrowdDeformation::CANCELED);
  this->listener->on_progress = {};
  this->filter->SetAbortExecute(0);
  this->filter->Update();
  EXPECT_EQ(this->filter->GetStatus(), vtkCrowdDeformation::OK);
}

TEST_F(CrowdDeformationFilter, FollowsTheTimeOfItsPoses)
{
  vtkNew<vtkPoseHandles> moving;
  moving->SetInputData(this->handles);
  moving->SetPoseJSON(R"({"fps": 1, "frames": [{"handles": {}},
    {"handles": {"right": {"translate": [0, 1, 0]}}}]})");
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> places;
  places->SetName("Placement");
  places->SetNumberOfComponents(3);
  places->InsertNextTuple3(0, 0, 0);
  table->GetRowData()->AddArray(places);
  this->filter->SetInputConnection(1, moving->GetOutputPort());
  this->filter->SetInstancesData(table);
  this->filter->UpdateTimeStep(0.0);
  const Points rest = this->instance(0);
  this->filter->UpdateTimeStep(1.0);
  EXPECT_GT((this->instance(0) - rest).cwiseAbs().maxCoeff(), 0.5);
  EXPECT_EQ(this->filter->GetNumberOfBinds(), 1);
}
