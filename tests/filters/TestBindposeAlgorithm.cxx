// The behavior that all filters inherit from vtkBindposeAlgorithm: report, failure, cancel,
// repeated execution.
#include "TestFilter.h"
#include "data_of.h"

#include "conversion.h"
#include "report_field_data.h"
#include "support/meshes.h"

#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <thread>

using namespace bindpose;
using bindpose::test::data_of;
using bindpose::test::Listener;
using bindpose::test::TestFilter;
using testing::HasSubstr;

namespace
{
Status fail(StatusCode code)
{
  return Status::failure(code, "the dog ate it");
}
} // namespace

TEST(BindposeAlgorithm, ReportsOnTheOutput)
{
  vtkNew<TestFilter> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->SetInputData(data_of(test::cube()));
  EXPECT_EQ(filter->GetReportJSON(), "{}");
  filter->Work = [](ExecutionContext& context, vtkPolyData*)
  {
    const Phase phase(context, "solve");
    Status status;
    status.report.set("iterations", 7);
    status.warnings.emplace_back("the input is old");
    return status;
  };
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(filter->GetStatusAsString(), "ok");
  EXPECT_EQ(filter->GetStatusMessage(), "");
  const Report& report = filter->GetReport();
  EXPECT_EQ(report.text("status"), "ok");
  EXPECT_EQ(report.number("iterations", 0), 7);
  EXPECT_GE(report.number("seconds.solve", -1), 0.0);
  EXPECT_GE(report.number("seconds.total", -1), report.number("seconds.solve", 0));
  EXPECT_GT(report.number("peak_memory_bytes", 0), 1e6);
  EXPECT_THAT(filter->GetReportJSON(), HasSubstr("\"iterations\""));
  EXPECT_THAT(filter->GetReportJSON(), HasSubstr("\"peak_memory_bytes\""));
  const Report in_data = read_report(filter->GetOutput());
  EXPECT_EQ(in_data.number("iterations", 0), 7);
  for (const auto& entry : in_data.entries())
  {
    EXPECT_FALSE(is_run_measurement(entry.first))
      << entry.first << ": equal results are equal files";
  }
  ASSERT_EQ(listener->warnings.size(), 1u);
  EXPECT_THAT(listener->warnings[0], HasSubstr("the input is old"));
  EXPECT_TRUE(listener->errors.empty());
  EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 12);

  std::ostringstream text;
  filter->Print(text);
  for (const char* word : { "NumberOfThreads: 0", "Status: ok", "StatusMessage:", "iterations" })
  {
    EXPECT_THAT(text.str(), HasSubstr(word));
  }
}

TEST(BindposeAlgorithm, ExecutesOnlyWhenSomethingChanged)
{
  vtkNew<TestFilter> filter;
  const auto input = data_of(test::cube());
  filter->SetInputData(input);
  filter->Update();
  filter->Update();
  EXPECT_EQ(filter->Executions, 1);
  filter->SetNumberOfThreads(1); // the number of threads does not change the result
  EXPECT_EQ(filter->GetNumberOfThreads(), 1);
  filter->Update();
  EXPECT_EQ(filter->Executions, 1);
  input->GetPoints()->Modified();
  filter->Update();
  EXPECT_EQ(filter->Executions, 2);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->Executions, 3);
}

TEST(BindposeAlgorithm, TheFirstOfSeveralPiecesIsTheWhole)
{
  vtkNew<vtkSphereSource> sphere; // this source can produce pieces
  sphere->Update();
  const vtkIdType cells = sphere->GetOutput()->GetNumberOfCells();
  vtkNew<TestFilter> first;
  vtkNew<TestFilter> second;
  first->SetInputConnection(sphere->GetOutputPort());
  second->SetInputConnection(first->GetOutputPort());
  second->UpdatePiece(1, 2, 1);
  EXPECT_EQ(second->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(first->Executions + second->Executions, 0) << "nothing to do";
  EXPECT_EQ(second->GetStatus(), vtkBindposeAlgorithm::OK);
  second->UpdatePiece(0, 2, 1);
  EXPECT_EQ(second->GetOutput()->GetNumberOfCells(), cells);
  EXPECT_EQ(first->Executions, 1);
  EXPECT_EQ(second->Executions, 1);
  second->UpdatePiece(1, 2, 1);
  EXPECT_EQ(second->GetOutput()->GetNumberOfCells(), 0);
  second->UpdatePiece(0, 1, 0);
  EXPECT_EQ(second->GetOutput()->GetNumberOfCells(), cells);
}

TEST(BindposeAlgorithm, NotConvergedIsAResult)
{
  vtkNew<TestFilter> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->SetInputData(data_of(test::cube()));
  filter->Work = [](ExecutionContext&, vtkPolyData*) { return fail(StatusCode::not_converged); };
  filter->Update();
  filter->Update();
  EXPECT_EQ(filter->Executions, 1);
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::NOT_CONVERGED);
  EXPECT_EQ(filter->GetStatusMessage(), "the dog ate it");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 12);
  EXPECT_TRUE(listener->errors.empty());
}

TEST(BindposeAlgorithm, FailureEmptiesOutputsAndPassesOn)
{
  vtkNew<TestFilter> first;
  vtkNew<TestFilter> second;
  vtkNew<Listener> listener;
  vtkNew<Listener> downstream;
  listener->listen(first);
  downstream->listen(second);
  first->SetInputData(data_of(test::cube()));
  second->SetInputConnection(first->GetOutputPort());
  second->Update();
  EXPECT_EQ(second->GetOutput()->GetNumberOfCells(), 12);

  for (const StatusCode code :
    { StatusCode::invalid_input, StatusCode::unavailable, StatusCode::internal_error })
  {
    listener->errors.clear();
    downstream->errors.clear();
    first->Executions = second->Executions = 0;
    first->Work = [code](ExecutionContext&, vtkPolyData*) { return fail(code); };
    first->Modified();
    second->Update();
    EXPECT_EQ(first->Executions, 1);
    EXPECT_EQ(second->Executions, 0) << "nothing to work on";
    EXPECT_EQ(first->GetStatus(), static_cast<int>(code));
    EXPECT_EQ(second->GetStatus(), static_cast<int>(code));
    EXPECT_EQ(second->GetStatusMessage(), "the dog ate it");
    for (vtkBindposeAlgorithm* filter : { first.Get(), second.Get() })
    {
      EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
      EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
      EXPECT_EQ(read_report(filter->GetOutput()).text("status"), to_string(code));
      EXPECT_EQ(read_report(filter->GetOutput()).text("message"), "the dog ate it");
      EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::UserError);
    }
    ASSERT_EQ(listener->errors.size(), 1u);
    EXPECT_THAT(listener->errors[0], HasSubstr("the dog ate it"));
    EXPECT_EQ(downstream->errors.size(), 1u);

    // Nothing has changed, but a filter that failed executes again.
    second->Update();
    EXPECT_EQ(first->Executions, 2);
  }
  // After a successful execution, the status, the error code and the report no longer show the
  // failure.
  first->Work = nullptr;
  second->Update();
  EXPECT_EQ(first->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(second->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(second->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(second->GetOutput()->GetNumberOfCells(), 12);
  EXPECT_EQ(read_report(second->GetOutput()).text("status"), "ok");
  first->Executions = second->Executions = 0;
  second->Update();
  EXPECT_EQ(first->Executions + second->Executions, 0);
}

TEST(BindposeAlgorithm, ExceptionsAreInternalErrors)
{
  vtkNew<TestFilter> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->SetInputData(data_of(test::cube()));
  filter->Work = [](ExecutionContext&, vtkPolyData*) -> Status
  { throw std::runtime_error("bad luck"); };
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::INTERNAL_ERROR);
  EXPECT_EQ(filter->GetStatusMessage(), "bad luck");
  filter->Work = [](ExecutionContext&, vtkPolyData*) -> Status { throw std::bad_alloc(); };
  filter->Update();
  EXPECT_EQ(filter->GetStatusMessage(), "out of memory");
  filter->Work = [](ExecutionContext&, vtkPolyData*) -> Status { throw 5; };
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::INTERNAL_ERROR);
  EXPECT_FALSE(filter->GetStatusMessage().empty());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(listener->errors.size(), 3u);
}

TEST(BindposeAlgorithm, ObserverCancelsAndTheNextUpdateExecutesAgain)
{
  vtkNew<TestFilter> first;
  vtkNew<TestFilter> second;
  vtkNew<Listener> listener;
  vtkNew<Listener> downstream;
  listener->listen(first);
  downstream->listen(second);
  first->SetInputData(data_of(test::cube()));
  second->SetInputConnection(first->GetOutputPort());
  first->Work = [](ExecutionContext& context, vtkPolyData*)
  {
    const Phase phase(context, "count");
    for (int i = 0; i < 500; ++i)
    {
      if (context.canceled())
      {
        return Status::canceled();
      }
      context.progress(i / 500.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return Status();
  };
  listener->on_progress = [&](vtkAlgorithm* algorithm)
  {
    if (algorithm->GetProgress() > 0.1)
    {
      algorithm->SetAbortExecute(1);
    }
  };
  second->Update();
  EXPECT_EQ(first->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  EXPECT_EQ(second->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  EXPECT_EQ(first->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(read_report(second->GetOutput()).text("status"), "canceled");
  EXPECT_TRUE(listener->errors.empty()) << "a wish is no error";
  EXPECT_TRUE(downstream->errors.empty());
  EXPECT_EQ(first->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_THAT(listener->phases, testing::Contains("count"));

  listener->on_progress = nullptr;
  second->Update();
  EXPECT_EQ(first->Executions, 2);
  EXPECT_EQ(first->GetStatus(), vtkBindposeAlgorithm::OK);
  EXPECT_EQ(second->GetOutput()->GetNumberOfCells(), 12);
  second->Update();
  EXPECT_EQ(first->Executions, 2);
}

TEST(BindposeAlgorithm, AnotherThreadCancelsInTime)
{
  vtkNew<TestFilter> filter;
  filter->SetInputData(data_of(test::cube()));
  std::atomic<bool> running{ false };
  filter->Work = [&](ExecutionContext& context, vtkPolyData*)
  {
    running = true;
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::seconds(20))
    {
      if (context.canceled())
      {
        return Status::canceled();
      }
    }
    return Status();
  };
  std::chrono::steady_clock::time_point cancel_time;
  std::thread canceler(
    [&]
    {
      while (!running)
      {
        std::this_thread::yield();
      }
      cancel_time = std::chrono::steady_clock::now();
      filter->SetAbortExecute(1);
    });
  filter->Update();
  const auto ended = std::chrono::steady_clock::now();
  canceler.join();
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  EXPECT_LT(std::chrono::duration<double>(ended - cancel_time).count(), 0.2);
}

TEST(BindposeAlgorithm, ReportsOfEarlierStagesAreReplaced)
{
  vtkNew<TestFilter> first;
  vtkNew<TestFilter> second;
  first->SetInputData(data_of(test::cube()));
  first->Work = [](ExecutionContext&, vtkPolyData*)
  {
    Status status;
    status.report.set("iterations", 7);
    return status;
  };
  second->SetInputConnection(first->GetOutputPort());
  second->Update();
  EXPECT_EQ(read_report(first->GetOutput()).number("iterations", -1), 7);
  EXPECT_EQ(read_report(second->GetOutput()).number("iterations", -1), -1)
    << "the key does not apply to the second";
}

TEST(BindposeAlgorithm, BlocksOfACompositeInput)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int b = 0; b < 3; ++b)
  {
    blocks->SetBlock(b, data_of(test::cube()));
  }
  vtkNew<TestFilter> filter;
  vtkNew<Listener> listener;
  listener->listen(filter);
  filter->SetInputDataObject(0, blocks);
  filter->Update();
  EXPECT_EQ(filter->Executions, 3);
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::OK);
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  ASSERT_EQ(output->GetNumberOfBlocks(), 3u);
  for (unsigned int b = 0; b < 3; ++b)
  {
    auto* block = vtkPolyData::SafeDownCast(output->GetBlock(b));
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(block->GetNumberOfCells(), 12);
    EXPECT_EQ(read_report(block).text("status"), "ok");
  }

  // The second block fails. Its output is empty and has a report, the other outputs are complete,
  // and the filter has failed.
  filter->Executions = 0;
  filter->Work = [&](ExecutionContext&, vtkPolyData*)
  { return filter->Executions == 2 ? fail(StatusCode::invalid_input) : Status(); };
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->Executions, 3);
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::UserError);
  EXPECT_EQ(listener->errors.size(), 1u);
  output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  for (unsigned int b = 0; b < 3; ++b)
  {
    auto* block = vtkPolyData::SafeDownCast(output->GetBlock(b));
    EXPECT_EQ(block->GetNumberOfCells(), b == 1 ? 0 : 12);
    EXPECT_EQ(read_report(block).text("status"), b == 1 ? "invalid_input" : "ok");
  }

  // The second block is canceled. The third is not started, and the next Update() executes all
  // blocks.
  filter->Executions = 0;
  filter->Work = [&](ExecutionContext& context, vtkPolyData*)
  {
    if (filter->Executions == 2)
    {
      filter->SetAbortExecute(1);
    }
    return context.canceled() ? Status::canceled() : Status();
  };
  filter->Update();
  EXPECT_EQ(filter->Executions, 2);
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::CANCELED);
  filter->Executions = 0;
  filter->Work = nullptr;
  filter->Update();
  EXPECT_EQ(filter->Executions, 3);
  EXPECT_EQ(filter->GetStatus(), vtkBindposeAlgorithm::OK);
}

TEST(BindposeAlgorithm, CanceledCompositesPassOn)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, data_of(test::cube()));
  blocks->SetBlock(1, data_of(test::cube()));
  vtkNew<TestFilter> first;
  vtkNew<TestFilter> second;
  vtkNew<Listener> listener;
  vtkNew<Listener> downstream;
  listener->listen(first);
  downstream->listen(second);
  first->SetInputDataObject(0, blocks);
  second->SetInputConnection(first->GetOutputPort());
  first->Work = [](ExecutionContext&, vtkPolyData*) { return fail(StatusCode::invalid_input); };
  second->Update();
  EXPECT_EQ(first->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  EXPECT_EQ(second->GetStatus(), vtkBindposeAlgorithm::INVALID_INPUT);
  EXPECT_EQ(second->Executions, 0);
  first->Work = nullptr;
  second->Update();
  EXPECT_EQ(second->Executions, 2);
  EXPECT_EQ(second->GetStatus(), vtkBindposeAlgorithm::OK);
}

TEST(BindposeAlgorithm, InputsThatAreMissingOrOfTheWrongKind)
{
  vtkNew<TestFilter> filter;
  vtkNew<Listener> listener;
  EXPECT_EQ(filter->GetInput(), nullptr);
  filter->SetInputData(data_of(test::cube()));
  EXPECT_EQ(filter->GetInput(), filter->GetInputDataObject(0, 0));
  filter->SetInputData(nullptr);
  EXPECT_EQ(filter->GetNumberOfInputConnections(0), 0);
  vtkObject::GlobalWarningDisplayOff(); // VTK's executive reports the missing input
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(filter->Executions, 0);
  filter->SetInputData(data_of(test::cube()));
  filter->Update();
  EXPECT_EQ(filter->Executions, 1);
}
