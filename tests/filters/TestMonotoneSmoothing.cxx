// vtkMonotoneSmoothing: smoothing of data on surfaces, polygons and tets with a list of extrema.
// The tests cover lists of extrema in point arrays, result arrays, the second output (the extrema
// of the result), errors, and cancel requests.
#include "TestFilter.h"

#include "vtkMonotoneSmoothing.h"

#include "conversion.h"
#include "report_field_data.h"
#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
/// Return data with waves and noise at the points of any mesh.
vtkSmartPointer<vtkDoubleArray> waves(vtkDataSet* mesh)
{
  test::Random random(4);
  auto data = vtkSmartPointer<vtkDoubleArray>::New();
  data->SetName("Height");
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v)
  {
    const double* p = mesh->GetPoint(v);
    data->InsertNextValue(
      std::sin(6.0 * p[0]) * std::cos(4.0 * p[1]) + p[2] + 0.4 * random.uniform());
  }
  return data;
}

class MonotoneSmoothing : public testing::Test
{
protected:
  MonotoneSmoothing()
  {
    const TriangleMesh grid = test::grid(16, 16);
    this->mesh = to_polydata(grid.points, grid.triangles);
    this->mesh->GetPointData()->SetScalars(waves(this->mesh));
    this->smoothing->SetInputData(this->mesh);
    this->listener->listen(this->smoothing);
  }

  void add_list(vtkIdType maximum, vtkIdType minimum, const char* name = "Extrema")
  {
    vtkNew<vtkIntArray> list;
    list->SetName(name);
    list->SetNumberOfTuples(this->mesh->GetNumberOfPoints());
    list->FillValue(0);
    list->SetValue(maximum, 1);
    list->SetValue(minimum, -1);
    this->mesh->GetPointData()->AddArray(list);
  }
  void expect_error(const std::string& words)
  {
    this->listener->errors.clear();
    this->smoothing->Update();
    EXPECT_EQ(this->smoothing->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
    EXPECT_THAT(this->smoothing->GetStatusMessage(), HasSubstr(words));
    EXPECT_EQ(this->listener->errors.size(), 1u);
    EXPECT_EQ(this->smoothing->GetOutput()->GetNumberOfPoints(), 0);
  }
  double certificate(const char* name)
  {
    return this->smoothing->GetOutput()->GetFieldData()->GetArray(name)->GetTuple1(0);
  }

  vtkSmartPointer<vtkPolyData> mesh;
  vtkNew<vtkMonotoneSmoothing> smoothing;
  vtkNew<Listener> listener;
};
} // namespace

TEST_F(MonotoneSmoothing, ActiveScalarsAreSmoothedAndExtremaTold)
{
  this->smoothing->SetPersistence(0.5);
  this->smoothing->Update();
  ASSERT_EQ(this->smoothing->GetStatus(), vtkBindposeAlgorithm::OK)
    << this->smoothing->GetStatusMessage();
  vtkDataSet* output = this->smoothing->GetOutput();
  ASSERT_TRUE(vtkPolyData::SafeDownCast(output));
  vtkPointData* points = output->GetPointData();
  EXPECT_STREQ(points->GetScalars()->GetName(), "Smoothed");
  EXPECT_EQ(points->GetArray("Height"), this->mesh->GetPointData()->GetArray("Height"));
  EXPECT_LE(this->certificate("SmoothedRelativeGap"), 1e-6);
  EXPECT_LE(this->certificate("SmoothedKKTResidual"), 1e-6);
  const Report report = read_report(output);
  EXPECT_EQ(report.text("extrema_from"), "persistence");
  EXPECT_EQ(report.number("interior_extrema", -1), 0);
  EXPECT_GT(report.number("counts.data_extrema", -1), 20);
  vtkDataSet* extrema = this->smoothing->GetOutput(1);
  const auto count =
    static_cast<vtkIdType>(report.number("counts.maxima", 0) + report.number("counts.minima", 0));
  ASSERT_EQ(extrema->GetNumberOfPoints(), count);
  ASSERT_EQ(extrema->GetNumberOfCells(), count);
  vtkPointData* arrays = extrema->GetPointData();
  for (vtkIdType e = 0; e < count; ++e)
  {
    const auto id = static_cast<vtkIdType>(arrays->GetArray("PointId")->GetTuple1(e));
    double at[3];
    double place[3];
    extrema->GetPoint(e, at);
    output->GetPoint(id, place);
    EXPECT_TRUE(std::equal(at, at + 3, place));
    EXPECT_EQ(arrays->GetArray("Value")->GetTuple1(e), points->GetArray("Smoothed")->GetTuple1(id));
    EXPECT_EQ(
      arrays->GetArray("DataValue")->GetTuple1(e), points->GetArray("Height")->GetTuple1(id));
    EXPECT_EQ(
      arrays->GetArray("Kind")->GetTuple1(e), points->GetArray("SmoothedExtrema")->GetTuple1(id));
    EXPECT_EQ(arrays->GetArray("Listed")->GetTuple1(e), 1);
    EXPECT_GT(arrays->GetArray("Persistence")->GetTuple1(e), 1e-3);
  }
  // If nothing has changed, the filter does not execute.
  const int starts = this->listener->starts;
  this->smoothing->Update();
  EXPECT_EQ(this->listener->starts, starts);
  std::ostringstream text;
  this->smoothing->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("DataWeight: 1e+06"));
}

TEST_F(MonotoneSmoothing, TakesTheListOfTheMeshAndItsOwn)
{
  this->add_list(200, 40); // the data is higher at the first of the two points
  this->smoothing->KeepValuesOn();
  this->smoothing->Update();
  ASSERT_EQ(this->smoothing->GetStatus(), vtkBindposeAlgorithm::OK)
    << this->smoothing->GetStatusMessage();
  vtkDataArray* smoothed = this->smoothing->GetOutput()->GetPointData()->GetArray("Smoothed");
  vtkDataArray* data = this->mesh->GetPointData()->GetArray("Height");
  EXPECT_EQ(this->smoothing->GetOutput(1)->GetNumberOfPoints(), 2);
  double range[2];
  smoothed->GetRange(range);
  EXPECT_EQ(range[0], data->GetTuple1(40));
  EXPECT_EQ(range[1], data->GetTuple1(200));
  EXPECT_EQ(read_report(this->smoothing->GetOutput()).text("extrema_from"), "list");
  // The output has an array with the list of extrema that the filter used. A second filter accepts
  // this array as input.
  vtkNew<vtkMonotoneSmoothing> again;
  again->SetInputConnection(this->smoothing->GetOutputPort());
  again->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Height");
  again->SetExtremaArrayName("SmoothedExtrema");
  again->SetResultArrayName("Again");
  again->KeepValuesOn();
  again->Update();
  ASSERT_EQ(again->GetStatus(), vtkBindposeAlgorithm::OK) << again->GetStatusMessage();
  vtkDataArray* repeated = again->GetOutput()->GetPointData()->GetArray("Again");
  for (vtkIdType v = 0; v < repeated->GetNumberOfTuples(); ++v)
  {
    ASSERT_EQ(repeated->GetTuple1(v), smoothed->GetTuple1(v));
  }
  // With an empty array name, the filter ignores the list of extrema in the mesh.
  this->smoothing->SetExtremaArrayName("");
  this->smoothing->KeepValuesOff();
  this->smoothing->SetNumberOfExtrema(3);
  this->smoothing->Update();
  EXPECT_EQ(read_report(this->smoothing->GetOutput()).text("extrema_from"), "count");
  EXPECT_EQ(this->smoothing->GetOutput(1)->GetNumberOfPoints(), 3);
}

TEST_F(MonotoneSmoothing, TakesTetsAndFloats)
{
  const TetMesh box = test::tet_box(6, 6, 6);
  const auto tets = to_unstructured_grid(box.points, box.tets);
  vtkNew<vtkFloatArray> floats;
  floats->SetName("Floats");
  const auto data = waves(tets);
  for (vtkIdType v = 0; v < data->GetNumberOfTuples(); ++v)
  {
    floats->InsertNextValue(static_cast<float>(data->GetValue(v)));
  }
  tets->GetPointData()->AddArray(floats);
  this->smoothing->SetInputData(tets);
  this->smoothing->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Floats");
  this->smoothing->SetOrder(3);
  this->smoothing->SetNumberOfExtrema(2);
  this->smoothing->Update();
  ASSERT_EQ(this->smoothing->GetStatus(), vtkBindposeAlgorithm::OK)
    << this->smoothing->GetStatusMessage();
  EXPECT_TRUE(vtkUnstructuredGrid::SafeDownCast(this->smoothing->GetOutput()));
  EXPECT_EQ(this->smoothing->GetOutput(1)->GetNumberOfPoints(), 2);
}

TEST_F(MonotoneSmoothing, RefusesWhatItCannotUseAndGoesOn)
{
  this->smoothing->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Depth");
  this->expect_error("'Depth'");
  EXPECT_THAT(this->smoothing->GetStatusMessage(), HasSubstr("Height"));
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("Depth");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(this->mesh->GetNumberOfPoints());
  vectors->FillValue(1.0);
  this->mesh->GetPointData()->AddArray(vectors);
  this->expect_error("3 components");
  this->mesh->GetPointData()->SetActiveScalars("");
  vtkNew<vtkMonotoneSmoothing> without;
  vtkNew<Listener> heard;
  heard->listen(without);
  without->SetInputData(this->mesh);
  without->Update();
  EXPECT_THAT(without->GetStatusMessage(), HasSubstr("no active point scalars"));
  this->smoothing->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Height");
  this->smoothing->SetExtremaArrayName("Nowhere");
  this->expect_error("'Nowhere'");
  vtkNew<vtkStringArray> words;
  words->SetName("Words");
  words->SetNumberOfValues(this->mesh->GetNumberOfPoints());
  this->mesh->GetPointData()->AddArray(words);
  this->smoothing->SetExtremaArrayName("Words");
  this->expect_error("must have one component");
  this->add_list(40, 200, "List");
  auto* list = vtkIntArray::SafeDownCast(this->mesh->GetPointData()->GetArray("List"));
  list->SetValue(200, 0);
  this->smoothing->SetExtremaArrayName("List");
  this->expect_error("no minimum");
  list->SetValue(40, 0);
  list->Modified();
  this->mesh->Modified();
  this->expect_error("empty");
  this->smoothing->SetExtremaArrayName("");
  this->smoothing->SetPersistence(2.0);
  this->expect_error("persistence");
  this->smoothing->SetPersistence(0.3);
  auto* data = vtkDoubleArray::SafeDownCast(this->mesh->GetPointData()->GetArray("Height"));
  const double kept = data->GetValue(7);
  data->SetValue(7, std::nan(""));
  data->Modified();
  this->mesh->Modified();
  this->expect_error("vertex 7");
  data->SetValue(7, kept);
  data->Modified();
  this->mesh->Modified();
  this->smoothing->Update();
  EXPECT_EQ(this->smoothing->GetStatus(), vtkBindposeAlgorithm::OK)
    << this->smoothing->GetStatusMessage();
}

TEST_F(MonotoneSmoothing, SaysWhatIsNotCertifiedAndStopsWhenAsked)
{
  this->smoothing->SetNumberOfExtrema(2);
  this->smoothing->SetMaximumIterations(2);
  this->smoothing->Update();
  EXPECT_EQ(this->smoothing->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED);
  EXPECT_EQ(this->smoothing->GetOutput()->GetNumberOfPoints(), 289);
  const TriangleMesh fine = test::grid(100, 100);
  const auto large = to_polydata(fine.points, fine.triangles);
  large->GetPointData()->SetScalars(waves(large));
  this->smoothing->SetInputData(large);
  this->smoothing->SetMaximumIterations(100);
  this->listener->on_progress = [](vtkAlgorithm* algorithm)
  {
    if (algorithm->GetProgress() > 0.15)
    {
      algorithm->SetAbortExecute(1);
    }
  };
  this->smoothing->Update();
  EXPECT_EQ(this->smoothing->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  EXPECT_EQ(this->smoothing->GetOutput()->GetNumberOfPoints(), 0);
}
