// vtkShareDataset: threads act as the processes. Every process gets the whole dataset. No process
// waits forever, whatever fails on another process.
#include "filters/TestFilter.h"
#include "filters/data_of.h"
#include "filters/pipeline/same_data.h"
#include "filters/pipeline/thread_processes.h"

#include "report_field_data.h"
#include "support/bars.h"
#include "support/meshes.h"
#include "vtkPoseHandles.h"
#include "vtkShareDataset.h"
#include "vtkSkinningDeformation.h"
#include "weights_arrays.h"

#include "vtkCellData.h"
#include "vtkCompositeDataPipeline.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

using namespace bindpose;
using bindpose::test::difference;
using bindpose::test::Listener;
using bindpose::test::run_processes;
using bindpose::test::TestFilter;
using testing::HasSubstr;

namespace
{
/// A filter that copies its input, or fails in one of the passes of the pipeline.
class FailingCopy : public vtkPolyDataAlgorithm
{
public:
  enum Pass
  {
    nowhere,
    information,
    data
  };
  static FailingCopy* New()
  {
    auto* filter = new FailingCopy;
    filter->InitializeObjectBase();
    return filter;
  }
  vtkTypeMacro(FailingCopy, vtkPolyDataAlgorithm);

  Pass FailsIn = nowhere;

protected:
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override
  {
    return this->FailsIn == information ? 0 : 1;
  }
  int RequestData(
    vtkInformation*, vtkInformationVector** input, vtkInformationVector* output) override
  {
    vtkPolyData::GetData(output)->ShallowCopy(vtkPolyData::GetData(input[0]));
    return this->FailsIn == data ? 0 : 1;
  }
};

/// Return tets with arrays of all kinds: doubles with named components, ids, texts and field data.
vtkSmartPointer<vtkUnstructuredGrid> rich_tets()
{
  const test::Rig rig = test::bar(4);
  auto data = to_unstructured_grid(rig.mesh.points, rig.mesh.tets);
  data->GetPointData()->AddArray(to_weights_array("Weights", rig.weights, rig.handles));
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("Ids");
  vtkNew<vtkStringArray> names;
  names->SetName("Names");
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    ids->InsertNextValue(cell % 3 - 1);
    names->InsertNextValue(cell % 2 ? "left hand" : "");
  }
  data->GetCellData()->AddArray(ids);
  data->GetCellData()->AddArray(names);
  vtkNew<vtkDoubleArray> certificate;
  certificate->SetName("WeightsRelativeGap");
  certificate->InsertNextValue(1.0 / 3.0);
  data->GetFieldData()->AddArray(certificate);
  return data;
}

vtkSmartPointer<vtkDataObject> copy_of_output(vtkAlgorithm* algorithm)
{
  vtkDataObject* data = algorithm->GetOutputDataObject(0);
  vtkSmartPointer<vtkDataObject> copy;
  copy.TakeReference(data->NewInstance());
  copy->DeepCopy(data);
  return copy;
}

/// Switches VTK's messages off during the lifetime of the object. Otherwise, executives would print
/// the failures that the tests cause on purpose.
class Silence
{
public:
  Silence() { vtkObject::GlobalWarningDisplayOff(); }
  ~Silence() { vtkObject::GlobalWarningDisplayOn(); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
};
} // namespace

TEST(ShareDataset, OneProcessGetsItsOwnData)
{
  const auto tets = rich_tets();
  vtkNew<vtkShareDataset> share;
  EXPECT_EQ(share->GetController(), nullptr);
  share->SetInputData(tets);
  share->Update();
  ASSERT_EQ(share->GetStatus(), vtkBindposeAlgorithm::OK) << share->GetStatusMessage();
  auto* output = vtkUnstructuredGrid::SafeDownCast(share->GetOutput());
  ASSERT_NE(output, nullptr);
  EXPECT_EQ(output->GetPointData()->GetArray(0), tets->GetPointData()->GetArray(0));
  EXPECT_EQ(output->GetCells(), tets->GetCells());
  const Report report = read_report(output);
  EXPECT_EQ(report.number("counts.points", 0), tets->GetNumberOfPoints());
  EXPECT_EQ(report.number("counts.processes", 0), 1);
  EXPECT_EQ(report.number("counts.parts", 0), 1);
  EXPECT_EQ(report.number("bytes_sent", -1), 0);
  share->UpdatePiece(1, 2, 0);
  EXPECT_EQ(share->GetOutput()->GetNumberOfPoints(), 0);
  share->UpdatePiece(0, 2, 0);
  EXPECT_EQ(share->GetOutput()->GetNumberOfPoints(), tets->GetNumberOfPoints());
  EXPECT_EQ(share->GetNumberOfExchanges(), 1);
  // ParaView tries to replace the executive of the filter. The filter keeps its own executive,
  // because only this executive always takes part when the processes exchange data.
  vtkExecutive* own = share->GetExecutive();
  vtkNew<vtkCompositeDataPipeline> other;
  share->SetExecutive(other);
  EXPECT_EQ(share->GetExecutive(), own);

  vtkNew<Listener> listener;
  listener->listen(share);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 2);
  share->SetInputData(image);
  share->Update();
  EXPECT_EQ(share->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  EXPECT_THAT(share->GetStatusMessage(), HasSubstr("the input is a vtkImageData"));
  share->SetInputData(nullptr);
  share->Update();
  EXPECT_THAT(share->GetStatusMessage(), HasSubstr("the input is missing"));
}

TEST(ShareDataset, EveryProcessGetsTheWhole)
{
  constexpr int processes = 3;
  const auto tets = rich_tets();
  for (int owner = 0; owner < 2; ++owner)
  {
    std::vector<vtkSmartPointer<vtkDataObject>> wholes(processes), pieces(processes);
    std::vector<Report> reports(processes);
    std::vector<int> exchanges(processes, 0);
    run_processes(processes,
      [&](int process, vtkMultiProcessController* controller)
      {
        vtkNew<vtkUnstructuredGrid> part;
        if (process == owner)
        {
          part->DeepCopy(tets);
        }
        vtkNew<vtkShareDataset> share;
        share->SetController(controller);
        share->SetInputData(part);
        share->Update();
        wholes[process] = copy_of_output(share);
        reports[process] = share->GetReport();
        share->UpdatePiece(process, processes, 0);
        pieces[process] = copy_of_output(share);
        share->UpdatePiece(0, 1, 0);
        exchanges[process] = share->GetNumberOfExchanges();
      });
    for (int process = 0; process < processes; ++process)
    {
      ASSERT_NE(wholes[process], nullptr);
      EXPECT_EQ(difference(wholes[process], tets), "") << process;
      EXPECT_EQ(pieces[process]->GetNumberOfElements(vtkDataObject::POINT),
        process == 0 ? tets->GetNumberOfPoints() : 0);
      EXPECT_EQ(exchanges[process], 1) << "a piece needs no exchange";
      EXPECT_EQ(reports[process].text("status"), "ok");
      EXPECT_EQ(reports[process].number("counts.points", 0), tets->GetNumberOfPoints());
      EXPECT_EQ(reports[process].number("counts.parts", 0), 1);
      EXPECT_EQ(reports[process].number("counts.processes", 0), processes);
      // If process 1 owns the part, it sends the part to process 0. Process 0 then sends the whole
      // dataset to all other processes.
      const double bytes = reports[process].number("bytes_sent", 0);
      EXPECT_EQ(bytes, reports[0].number("bytes_sent", 1));
      EXPECT_GT(
        bytes, (processes - 1 + owner) * 24.0 * static_cast<double>(tets->GetNumberOfPoints()));
    }
  }
}

TEST(ShareDataset, PartsAreAppendedInOrder)
{
  constexpr int processes = 3;
  std::vector<vtkSmartPointer<vtkDataObject>> wholes(processes);
  run_processes(processes,
    [&](int process, vtkMultiProcessController* controller)
    {
      // Process 1 has no part.
      const auto part = process == 1
        ? vtkSmartPointer<vtkPolyData>::New()
        : test::data_of(test::translated(test::grid(2, 1 + process), Vec3(process, 0, 0)));
      vtkNew<vtkShareDataset> share;
      share->SetController(controller);
      share->SetInputData(part);
      share->Update();
      wholes[process] = copy_of_output(share);
    });
  const auto expected =
    test::data_of(test::join(test::grid(2, 1), test::translated(test::grid(2, 3), Vec3(2, 0, 0))));
  for (int process = 0; process < processes; ++process)
  {
    EXPECT_EQ(difference(wholes[process], expected), "") << process;
  }
  EXPECT_EQ(read_report(wholes[1]).number("counts.parts", 0), 2);
}

TEST(ShareDataset, FailuresAreThoseOfAllProcesses)
{
  const Silence silence;
  constexpr int processes = 3;
  // In the first two cases, a VTK filter fails on process 1, in RequestData or RequestInformation.
  // In the third case, a Bindpose filter fails. It fails only on process 0, because the other
  // processes request pieces that are empty and need no work.
  for (const auto& [pass, sentence] : { std::pair(FailingCopy::data, "process 1: an algorithm"),
         std::pair(FailingCopy::information, "process 1: an algorithm"),
         std::pair(FailingCopy::nowhere, "process 0: the dog ate it") })
  {
    std::vector<int> failed(processes, -1), repaired(processes, -1);
    std::vector<std::string> messages(processes);
    std::vector<vtkIdType> points(processes, -1);
    run_processes(processes,
      [&, pass = pass](int process, vtkMultiProcessController* controller)
      {
        vtkNew<TestFilter> first;
        first->SetNumberOfThreads(1);
        first->SetInputData(test::data_of(test::cube()));
        if (pass == FailingCopy::nowhere)
        {
          first->Work = [](ExecutionContext&, vtkPolyData*)
          { return Status::failure(StatusCode::unavailable, "the dog ate it"); };
        }
        vtkNew<FailingCopy> second;
        second->SetInputConnection(first->GetOutputPort());
        second->FailsIn = process == 1 ? pass : FailingCopy::nowhere;
        vtkNew<vtkShareDataset> share;
        share->SetController(controller);
        share->SetInputConnection(second->GetOutputPort());
        share->Update();
        failed[process] = share->GetStatus();
        messages[process] = share->GetStatusMessage();
        points[process] = share->GetOutput()->GetNumberOfPoints();
        first->Work = nullptr;
        first->Modified();
        second->FailsIn = FailingCopy::nowhere;
        second->Modified();
        share->Update();
        repaired[process] = share->GetStatus();
      });
    for (int process = 0; process < processes; ++process)
    {
      EXPECT_EQ(failed[process],
        pass == FailingCopy::nowhere ? vtkBindposeAlgorithm::UNAVAILABLE
                                     : vtkBindposeAlgorithm::INVALID_INPUT);
      EXPECT_THAT(messages[process], HasSubstr(sentence)) << process;
      EXPECT_EQ(points[process], 0);
      EXPECT_EQ(repaired[process], vtkBindposeAlgorithm::OK) << process;
    }
  }
}

TEST(ShareDataset, InputsThatCannotBeSharedAreRefusedOnAllProcesses)
{
  const Silence silence;
  constexpr int processes = 2;
  const auto large_ids = test::data_of(test::cube());
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("GlobalIds");
  ids->SetNumberOfTuples(large_ids->GetNumberOfPoints());
  ids->FillValue(vtkIdType(1) << 40);
  large_ids->GetPointData()->AddArray(ids);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, test::data_of(test::cube()));
  blocks->SetBlock(1, test::data_of(test::cube()));
  const auto tets = rich_tets();
  const std::pair<vtkDataObject*, const char*> cases[] = {
    { blocks.Get(), "process 1: the input has blocks" },
    { nullptr, "process 1: the input is missing" },
    { tets.Get(), "process 0 has a vtkPolyData, but process 1 has a vtkUnstructuredGrid" },
    { large_ids.Get(), "process 1: the array 'GlobalIds' has ids that need more than 32 bits" },
  };
  for (const auto& [part, sentence] : cases)
  {
    std::vector<std::string> messages(processes);
    run_processes(processes,
      [&, part = part](int process, vtkMultiProcessController* controller)
      {
        vtkNew<vtkShareDataset> share;
        share->SetController(controller);
        if (process == 0)
        {
          share->SetInputData(test::data_of(test::cube()));
        }
        else if (part)
        {
          vtkSmartPointer<vtkDataObject> own;
          own.TakeReference(part->NewInstance());
          own->DeepCopy(part);
          share->SetInputData(own);
        }
        share->Update();
        messages[process] = share->GetStatusMessage();
      });
    for (const std::string& message : messages)
    {
      EXPECT_THAT(message, HasSubstr(sentence));
    }
  }
}

TEST(ShareDataset, AnExchangeDependsOnDataAndNotOnRequests)
{
  constexpr int processes = 2;
  const auto tets = rich_tets();
  std::vector<std::vector<int>> exchanges(processes);
  std::vector<std::vector<vtkIdType>> points(processes);
  run_processes(processes,
    [&](int process, vtkMultiProcessController* controller)
    {
      vtkNew<vtkUnstructuredGrid> part;
      if (process == 0)
      {
        part->DeepCopy(tets);
      }
      vtkNew<vtkShareDataset> share;
      share->SetController(controller);
      share->SetInputData(part);
      const auto note = [&]()
      {
        exchanges[process].push_back(share->GetNumberOfExchanges());
        points[process].push_back(share->GetOutput()->GetNumberOfPoints());
      };
      // Request the dataset for a filter that works on process 0 only, then for a filter that works
      // on all processes. On process 0 both requests are the same.
      share->UpdatePiece(process, process + 1, 0);
      note();
      share->UpdatePiece(0, 1, 0);
      note();
      // The dataset is marked as modified, but its arrays are not.
      part->Modified();
      share->Update();
      note();
      if (process == 0)
      {
        part->GetPointData()->GetArray("Weights")->SetComponent(0, 0, 0.25);
        part->GetPointData()->GetArray("Weights")->Modified();
      }
      part->Modified();
      share->Update();
      note();
      EXPECT_EQ(share->GetOutput()->GetPointData()->GetArray("Weights")->GetComponent(0, 0), 0.25);
    });
  const vtkIdType count = tets->GetNumberOfPoints();
  for (int process = 0; process < processes; ++process)
  {
    EXPECT_THAT(exchanges[process], testing::ElementsAre(1, 1, 1, 2));
    EXPECT_THAT(
      points[process], testing::ElementsAre(process == 0 ? count : 0, count, count, count));
  }
}

TEST(ShareDataset, HandlesOfOneProcessPosePiecesOnAll)
{
  constexpr int processes = 2;
  const test::Rig rig = test::bar(4);
  const Index rows = rig.mesh.points.rows(), middle = 13;
  const auto mesh_of = [&](Index begin, Index end)
  {
    const auto data =
      to_polydata(Points(rig.mesh.points.middleRows(begin, end - begin)), Triangles(0, 3));
    data->GetPointData()->AddArray(to_weights_array(
      "Weights", Weights(rig.weights.middleRows(begin, end - begin)), rig.handles));
    return data;
  };
  const char* const bent =
    R"({"handles": {"right": {"rotate": {"axis": [0, 0, 1], "degrees": 50}}}})";
  vtkNew<vtkPoseHandles> pose;
  pose->SetInputData(to_polydata(rig.handles));
  pose->SetPoseJSON(bent);
  vtkNew<vtkSkinningDeformation> skinning;
  skinning->SetInputData(0, mesh_of(0, rows));
  skinning->SetInputConnection(1, pose->GetOutputPort());
  skinning->Update();
  const Points expected = to_points(skinning->GetOutput()).view();

  std::vector<Points> posed(processes);
  std::vector<int> binds(processes, 0), exchanges(processes, 0);
  run_processes(processes,
    [&](int process, vtkMultiProcessController* controller)
    {
      vtkNew<vtkPolyData> handles;
      if (process == 0)
      {
        handles->DeepCopy(to_polydata(rig.handles));
      }
      vtkNew<vtkShareDataset> share;
      share->SetController(controller);
      share->SetInputData(handles);
      vtkNew<vtkPoseHandles> own_pose;
      own_pose->SetInputConnection(share->GetOutputPort());
      vtkNew<vtkSkinningDeformation> piece;
      piece->SetNumberOfThreads(1);
      piece->SetInputData(0, process == 0 ? mesh_of(0, middle) : mesh_of(middle, rows));
      piece->SetInputConnection(1, own_pose->GetOutputPort());
      piece->UpdatePiece(process, processes, 0);
      own_pose->SetPoseJSON(bent);
      piece->UpdatePiece(process, processes, 0);
      posed[process] = to_points(piece->GetOutput()).view();
      binds[process] = piece->GetNumberOfBinds();
      exchanges[process] = share->GetNumberOfExchanges();
    });
  ASSERT_EQ(posed[0].rows(), middle);
  ASSERT_EQ(posed[1].rows(), rows - middle);
  EXPECT_EQ(posed[0], expected.topRows(middle));
  EXPECT_EQ(posed[1], expected.bottomRows(rows - middle));
  EXPECT_THAT(binds, testing::Each(1));
  EXPECT_THAT(exchanges, testing::Each(1));
}

TEST(ShareDataset, PrintsItself)
{
  vtkNew<vtkShareDataset> share;
  std::ostringstream text;
  share->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("NumberOfProcesses: 1"));
  EXPECT_THAT(text.str(), HasSubstr("NumberOfExchanges: 0"));
}
