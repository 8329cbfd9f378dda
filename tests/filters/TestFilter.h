#ifndef TestFilter_h
#define TestFilter_h

// TestFilter runs a function that the test provides, and counts its executions. Listener records
// the events of a filter.

#include "vtkBindposeAlgorithm.h"

#include "base/execution.h"
#include "base/status.h"

#include "vtkCommand.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"

#include <functional>
#include <string>
#include <vector>

namespace bindpose::test
{

/// A filter from vtkDataSet to vtkPolyData. The filter makes a shallow copy of the input if the
/// input is a vtkPolyData. It then calls the function that the test provides.
class TestFilter : public vtkBindposeAlgorithm
{
public:
  static TestFilter* New()
  {
    auto* filter = new TestFilter;
    filter->InitializeObjectBase();
    return filter;
  }
  vtkTypeMacro(TestFilter, vtkBindposeAlgorithm);

  std::function<Status(ExecutionContext& context, vtkPolyData* output)> Work;
  int Executions = 0;

protected:
  int FillInputPortInformation(int, vtkInformation* info) override
  {
    info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
    return 1;
  }
  int FillOutputPortInformation(int, vtkInformation* info) override
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
    return 1;
  }
  Status Execute(
    ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output) override
  {
    this->Executions += 1;
    vtkPolyData* out = vtkPolyData::GetData(output);
    out->Initialize();
    if (vtkPolyData* in = vtkPolyData::GetData(input[0]))
    {
      out->ShallowCopy(in);
    }
    return this->Work ? this->Work(context, out) : Status();
  }
};

/// Counts the events of an algorithm and stores the texts of its errors and warnings. VTK's output
/// window then does not show these texts.
class Listener : public vtkCommand
{
public:
  static Listener* New() { return new Listener; }
  void listen(vtkAlgorithm* algorithm)
  {
    for (const unsigned long event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent,
           vtkCommand::StartEvent, vtkCommand::ProgressEvent })
    {
      algorithm->AddObserver(event, this);
    }
  }
  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    switch (event)
    {
      case vtkCommand::ErrorEvent:
        this->errors.emplace_back(static_cast<const char*>(data));
        break;
      case vtkCommand::WarningEvent:
        this->warnings.emplace_back(static_cast<const char*>(data));
        break;
      case vtkCommand::StartEvent:
        this->starts += 1;
        break;
      default:
        auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
        this->progress.push_back(algorithm->GetProgress());
        this->phases.emplace_back(algorithm->GetProgressText() ? algorithm->GetProgressText() : "");
        if (this->on_progress)
        {
          this->on_progress(algorithm);
        }
    }
  }

  std::vector<std::string> errors;
  std::vector<std::string> warnings;
  std::vector<double> progress;
  std::vector<std::string> phases;
  int starts = 0;
  std::function<void(vtkAlgorithm*)> on_progress;
};

} // namespace bindpose::test

#endif
