// Connects the kernels to the pipeline. This class creates an execution context with the
// algorithm's progress and abort flag and calls Execute(). It then converts the returned status to
// a report, an error event and an error code.
//
// GetMTime is overridden because in VTK 9.1 a filter whose RequestData failed or was aborted counts
// as executed. Without the override the executive would reuse its empty output in all later
// updates.
//
// Pieces: by default the executive requests from a filter's inputs the piece that is requested from
// its output. But a piece of a surface has no interior, and the weights of a piece of a mesh differ
// from those of the whole mesh. Therefore piece 0 of the output is computed from the whole input,
// and all other pieces are empty. For an empty piece, the same piece is requested upstream, which
// is also empty and costs nothing.
#include "vtkBindposeAlgorithm.h"

#include "base/execution.h"
#include "base/status.h"
#include "io/report_json.h"
#include "report_field_data.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVersionMacros.h"

#include <exception>
#include <new>

namespace
{
/// Return the status of some work. An exception becomes INTERNAL_ERROR.
template <typename Work>
bindpose::Status status_of(const Work& work)
{
  const auto failure = [](const char* message)
  { return bindpose::Status::failure(bindpose::StatusCode::internal_error, message); };
  try
  {
    return work();
  }
  catch (const std::bad_alloc&)
  {
    return failure("out of memory");
  }
  catch (const std::exception& error)
  {
    return failure(error.what());
  }
  catch (...)
  {
    return failure("caught an exception of unknown type");
  }
}
} // namespace

vtkBindposeAlgorithm::vtkBindposeAlgorithm() : LastStatus(new bindpose::Status)
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

vtkBindposeAlgorithm::~vtkBindposeAlgorithm() = default;

int vtkBindposeAlgorithm::GetStatus()
{
  return static_cast<int>(this->LastStatus->code);
}

std::string vtkBindposeAlgorithm::GetStatusAsString()
{
  return bindpose::to_string(this->LastStatus->code);
}

std::string vtkBindposeAlgorithm::GetStatusMessage()
{
  return this->LastStatus->message;
}

int vtkBindposeAlgorithm::GetNumberOfWarnings()
{
  return static_cast<int>(this->LastStatus->warnings.size());
}

std::string vtkBindposeAlgorithm::GetReportJSON()
{
  return bindpose::to_json(this->LastStatus->report);
}

const bindpose::Report& vtkBindposeAlgorithm::GetReport()
{
  return this->LastStatus->report;
}

std::string vtkBindposeAlgorithm::GetReportJSONOf(vtkDataObject* data)
{
  return bindpose::to_json(bindpose::read_report(data));
}

vtkDataObject* vtkBindposeAlgorithm::GetInput(int port)
{
  return this->GetNumberOfInputConnections(port) > 0 ? this->GetInputDataObject(port, 0) : nullptr;
}

vtkDataSet* vtkBindposeAlgorithm::GetOutput(int port)
{
  return vtkDataSet::SafeDownCast(this->GetOutputDataObject(port));
}

vtkMTimeType vtkBindposeAlgorithm::GetMTime()
{
  if (!this->ExecuteAgain)
  {
    return this->Superclass::GetMTime();
  }
  this->RetryTime.Modified();
  return this->RetryTime.GetMTime();
}

vtkTypeBool vtkBindposeAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->RequestData(input, output);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, input, output);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    return this->RequestInformation(request, input, output);
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    return this->RequestUpdateExtent(request, input, output);
  }
  return this->Superclass::ProcessRequest(request, input, output);
}

int vtkBindposeAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

int vtkBindposeAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  return 1;
}

int vtkBindposeAlgorithm::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  if (GetPiece(output->GetInformationObject(0)) > 0)
  {
    return 1;
  }
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < input[port]->GetNumberOfInformationObjects(); ++i)
    {
      RequestWholeInput(input[port]->GetInformationObject(i));
    }
  }
  return 1;
}

void vtkBindposeAlgorithm::RequestWholeInput(vtkInformation* input)
{
  using SDDP = vtkStreamingDemandDrivenPipeline;
  input->Set(SDDP::UPDATE_PIECE_NUMBER(), 0);
  input->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (input->Has(SDDP::WHOLE_EXTENT()))
  {
    input->Set(SDDP::UPDATE_EXTENT(), input->Get(SDDP::WHOLE_EXTENT()), 6);
  }
}

int vtkBindposeAlgorithm::GetPiece(vtkInformation* output)
{
  using SDDP = vtkStreamingDemandDrivenPipeline;
  return output && output->Has(SDDP::UPDATE_PIECE_NUMBER())
    ? output->Get(SDDP::UPDATE_PIECE_NUMBER())
    : 0;
}

int vtkBindposeAlgorithm::RequestData(vtkInformationVector** input, vtkInformationVector* output)
{
  if (!this->MakesPieces() && GetPiece(output->GetInformationObject(0)) > 0)
  {
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      if (vtkDataObject* data = vtkDataObject::GetData(output->GetInformationObject(port)))
      {
        data->Initialize();
      }
    }
    *this->LastStatus = bindpose::Status();
    this->ExecuteAgain = false;
    this->SetErrorCode(vtkErrorCode::NoError);
    return 1;
  }
  bindpose::ExecutionContext context([this](double fraction, const std::string& phase)
    { this->ReportProgress(fraction, phase); },
    [this]() { return this->GetAbortExecute() != 0; });
  context.set_threads(this->NumberOfThreads);

  // With a composite input the executive calls this function once per block. The first failure is
  // the status of all blocks, and a cancel stops all of them.
  const bool later_block = this->GetProgressShift() > 0.0;
  const bool earlier_block_failed = later_block && !this->LastStatus->usable();
  bindpose::Status status;
  if (earlier_block_failed && this->LastStatus->code == bindpose::StatusCode::canceled)
  {
    status = bindpose::Status::canceled();
  }
  for (int port = 0; port < this->GetNumberOfInputPorts() && status.usable(); ++port)
  {
    for (int i = 0; i < input[port]->GetNumberOfInformationObjects() && status.usable(); ++i)
    {
      status =
        bindpose::upstream_failure(vtkDataObject::GetData(input[port]->GetInformationObject(i)));
    }
  }
  if (status.usable())
  {
    status = status_of([&]() { return this->Execute(context, input, output); });
  }

  bindpose::complete_report(context, status);
  const bool canceled = status.code == bindpose::StatusCode::canceled;
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* data = vtkDataObject::GetData(output->GetInformationObject(port));
    if (!data)
    {
      continue;
    }
    if (!status.usable())
    {
      data->Initialize();
    }
    bindpose::attach_report(data, status.report);
  }
  if (!earlier_block_failed)
  {
    *this->LastStatus = status;
    this->ExecuteAgain = !status.usable();
    this->SetErrorCode(
      status.usable() || canceled ? vtkErrorCode::NoError : vtkErrorCode::UserError);
  }
  if (!status.usable() && !canceled)
  {
    vtkErrorMacro(<< status.message);
  }
  for (const std::string& warning : status.warnings)
  {
    vtkWarningMacro(<< warning);
  }
  return 1;
}

void vtkBindposeAlgorithm::ReportProgress(double fraction, const std::string& phase)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0)
  this->CheckAbort();
#endif
  this->SetProgressText(phase.c_str());
  this->UpdateProgress(fraction);
}

bool vtkBindposeAlgorithm::ExecuteDirectly(
  const std::function<bindpose::Status(bindpose::ExecutionContext& context)>& work)
{
  this->SetAbortExecute(0); // as the executive does before an execution
  bindpose::ExecutionContext context([this](double fraction, const std::string& phase)
    { this->ReportProgress(fraction, phase); },
    [this]() { return this->GetAbortExecute() != 0; });
  context.set_threads(this->NumberOfThreads);
  *this->LastStatus = status_of([&]() { return work(context); });
  bindpose::add_outcome(*this->LastStatus);
  this->LastStatus->report.merge(context.seconds());
  return this->LastStatus->usable();
}

void vtkBindposeAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "Status: " << this->GetStatusAsString() << "\n";
  os << indent << "StatusMessage: " << this->LastStatus->message << "\n";
  os << indent << "Report: " << this->GetReportJSON() << "\n";
}
