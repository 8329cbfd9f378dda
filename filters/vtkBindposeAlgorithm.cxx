// Connects the kernels to the pipeline. This class creates an execution context with the
// algorithm's progress and abort flag and calls Execute(). It then converts the returned status to
// a report, an error event and an error code.
//
// GetMTime is overridden because in VTK 9.1 a filter whose RequestData failed or was aborted counts
// as executed. Without the override the executive would reuse the filter's empty output in all
// later updates.
//
// Pieces: by default the executive requests from a filter's inputs the piece that is requested from
// its output. But a piece of a surface has no interior, and the weights of a piece of a mesh differ
// from those of the whole mesh. Therefore piece 0 of the output is computed from the whole input,
// and all other pieces are empty. For an empty piece, the same piece is requested upstream. That
// piece is also empty and costs nothing.
//
// A filter can have a piece port, i.e. an input port that GetPiecePort() returns. The filter
// requests the piece from this port and the whole input from all other ports. An algorithm that is
// upstream of both the piece port and another port executes only once, for the last of these
// requests. Which request is last depends on what is already up to date, and can differ between
// processes. If there is such an algorithm, piece 0 is therefore computed from the whole input, as
// in filters without a piece port. follows_pieces() detects such algorithms from the connections,
// which are the same on all processes. It identifies an output by its information object, which
// connected inputs share.
//
// Blocks: if the first input is a composite, the executive requests all passes once for the whole
// filter, and then, from REQUEST_DATA_OBJECT to REQUEST_DATA, once per block. In the latter passes
// the block replaces the composite. The pass REQUEST_DATA_NOT_GENERATED comes directly before the
// passes for the blocks and still sees the composite, so the blocks are counted in this pass.
#include "vtkBindposeAlgorithm.h"

#include "base/execution.h"
#include "base/status.h"
#include "cell_check.h"
#include "io/report_json.h"
#include "report_field_data.h"

#include "vtkCommand.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationStringVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVersionMacros.h"

#include <exception>
#include <new>
#include <set>
#include <vector>

namespace
{
using SDDP = vtkStreamingDemandDrivenPipeline;

/// Call work() and return its status. An exception becomes the status INTERNAL_ERROR.
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

/// Return the datasets of a composite, in the order in which the executive works on them.
std::vector<vtkDataObject*> blocks_of(vtkCompositeDataSet* composite)
{
  std::vector<vtkDataObject*> blocks;
  vtkSmartPointer<vtkCompositeDataIterator> block;
  block.TakeReference(composite->NewIterator());
  for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    blocks.push_back(block->GetCurrentDataObject());
  }
  return blocks;
}

/// The inputs of an execution. select_block() replaces a composite by one of its blocks: the block
/// with the same index as the current block of the first input.
class BlockInputs
{
public:
  BlockInputs(vtkInformationVector** input, int ports) : ports_(input, input + ports) {}

  bindpose::Status select_block(
    int port, int connection, vtkCompositeDataSet* composite, const bindpose::BlockNumber& current)
  {
    const std::vector<vtkDataObject*> blocks = blocks_of(composite);
    const bool pairs = current.composite && blocks.size() == current.count;
    if (!pairs && blocks.size() != 1)
    {
      const std::string count = std::to_string(blocks.size()) + " blocks";
      return bindpose::Status::invalid_input(port == 0
          ? "the input has " + count + "; expected a single dataset (merge or extract blocks)"
          : "input port " + std::to_string(port) + " has " + count + ", but input port 0 has " +
            (current.composite ? std::to_string(current.count) + " blocks" : "a single dataset") +
            "; expected as many blocks, or a single dataset");
    }
    this->replace(port, connection, blocks[pairs ? current.index : 0]);
    return {};
  }

  vtkInformationVector** get() { return this->ports_.data(); }

private:
  /// Replace the data object of a connection. The change is made in a copy of the information
  /// object, because the algorithm that produces the data object uses the original information
  /// object, too.
  void replace(int port, int connection, vtkDataObject* data)
  {
    auto copy = vtkSmartPointer<vtkInformationVector>::New();
    vtkInformationVector*& infos = this->ports_[static_cast<std::size_t>(port)];
    for (int i = 0; i < infos->GetNumberOfInformationObjects(); ++i)
    {
      copy->Append(infos->GetInformationObject(i));
    }
    auto info = vtkSmartPointer<vtkInformation>::New();
    info->Copy(infos->GetInformationObject(connection));
    info->Set(vtkDataObject::DATA_OBJECT(), data);
    copy->SetInformationObject(connection, info);
    this->copies_.push_back(copy);
    infos = copy;
  }

  std::vector<vtkInformationVector*> ports_;
  std::vector<vtkSmartPointer<vtkInformationVector>> copies_;
};

/// Call visit(info) for each connection to the input port `port` of `producer`.
template <typename Visit>
void for_inputs_of(vtkExecutive* producer, int port, const Visit& visit)
{
  vtkInformationVector* inputs = producer->GetInputInformation(port);
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    visit(inputs->GetInformationObject(i));
  }
}

/// Add the output that `connection` comes from, and all outputs upstream of it, to `outputs`.
void collect_upstream(vtkInformation* connection, std::set<vtkInformation*>& outputs)
{
  vtkExecutive* producer = vtkExecutive::PRODUCER()->GetExecutive(connection);
  if (!outputs.insert(connection).second)
  {
    return;
  }
  for (int port = 0; producer && port < producer->GetNumberOfInputPorts(); ++port)
  {
    for_inputs_of(producer, port, [&](vtkInformation* input) { collect_upstream(input, outputs); });
  }
}

/// Report whether a piece of `connection` is computed from a piece of one of the `outputs`.
bool follows_pieces(vtkInformation* connection, const std::set<vtkInformation*>& outputs)
{
  if (outputs.count(connection) > 0)
  {
    return true;
  }
  vtkExecutive* producer = vtkExecutive::PRODUCER()->GetExecutive(connection);
  auto* filter = vtkBindposeAlgorithm::SafeDownCast(producer ? producer->GetAlgorithm() : nullptr);
  // Assume that an algorithm outside of Bindpose processes its first input piece by piece.
  const int port = filter ? filter->GetPiecePort() : 0;
  if (!producer || port < 0 || port >= producer->GetNumberOfInputPorts())
  {
    return false;
  }
  bool follows = false;
  for_inputs_of(producer, port,
    [&](vtkInformation* input) { follows = follows || follows_pieces(input, outputs); });
  return follows;
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
    const int result = this->RequestData(input, output);
    if (++this->Block.index >= this->Block.count)
    {
      this->Block = {};
    }
    return result;
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    this->CountBlocks(input);
    return 1;
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
  vtkInformation* info = output->GetInformationObject(0);
  const int piece_port = this->WorksByPieces(input) ? this->GetPiecePort() : -1;
  if (piece_port < 0 && GetPiece(info) > 0)
  {
    return 1;
  }
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < input[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* connection = input[port]->GetInformationObject(i);
      if (port == piece_port)
      {
        connection->Set(SDDP::UPDATE_PIECE_NUMBER(), GetPiece(info));
        connection->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), GetNumberOfPieces(info));
        connection->Set(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      }
      else
      {
        RequestWholeInput(connection);
      }
    }
  }
  return 1;
}

void vtkBindposeAlgorithm::AcceptBlocks(vtkInformation* port)
{
  port->Append(INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
}

void vtkBindposeAlgorithm::RequestWholeInput(vtkInformation* input)
{
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
  return output && output->Has(SDDP::UPDATE_PIECE_NUMBER())
    ? output->Get(SDDP::UPDATE_PIECE_NUMBER())
    : 0;
}

int vtkBindposeAlgorithm::GetNumberOfPieces(vtkInformation* info)
{
  return info && info->Has(SDDP::UPDATE_NUMBER_OF_PIECES())
    ? info->Get(SDDP::UPDATE_NUMBER_OF_PIECES())
    : 1;
}

bool vtkBindposeAlgorithm::IsEmptyPiece(vtkInformationVector** input, vtkInformationVector* output)
{
  const int port = this->GetPiecePort();
  if (port < 0 || GetNumberOfPieces(output->GetInformationObject(0)) < 2)
  {
    return false;
  }
  vtkDataObject* data = vtkDataObject::GetData(input[port]->GetInformationObject(0));
  return !data ||
    (data->GetNumberOfElements(vtkDataObject::POINT) == 0 &&
      data->GetNumberOfElements(vtkDataObject::ROW) == 0);
}

/// Report whether the filter computes its output piece by piece. This requires an input port for
/// pieces (GetPiecePort()). An algorithm whose pieces reach this port must not also be upstream of
/// another input port.
bool vtkBindposeAlgorithm::WorksByPieces(vtkInformationVector** input)
{
  const int piece_port = this->GetPiecePort();
  if (piece_port < 0)
  {
    return false;
  }
  std::set<vtkInformation*> others;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; port != piece_port && i < input[port]->GetNumberOfInformationObjects(); ++i)
    {
      collect_upstream(input[port]->GetInformationObject(i), others);
    }
  }
  for (int i = 0; i < input[piece_port]->GetNumberOfInformationObjects(); ++i)
  {
    if (follows_pieces(input[piece_port]->GetInformationObject(i), others))
    {
      return false;
    }
  }
  return true;
}

/// Report whether a data object is a composite that Execute() processes block by block.
bool vtkBindposeAlgorithm::HasBlocks(int port, vtkDataObject* data)
{
  return vtkCompositeDataSet::SafeDownCast(data) && !this->TakesComposite(port);
}

/// Count the blocks for which the executive will call the filter. These are the blocks of the first
/// composite input whose port does not accept composites.
void vtkBindposeAlgorithm::CountBlocks(vtkInformationVector** input)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    auto* composite = vtkCompositeDataSet::SafeDownCast(
      vtkDataObject::GetData(input[port]->GetInformationObject(0)));
    vtkInformation* info = this->GetInputPortInformation(port);
    bool accepted = false;
    for (int i = 0; composite && i < info->Length(INPUT_REQUIRED_DATA_TYPE()); ++i)
    {
      accepted = accepted || composite->IsA(info->Get(INPUT_REQUIRED_DATA_TYPE(), i));
    }
    if (composite && !accepted)
    {
      const std::size_t count = blocks_of(composite).size();
      this->Block = {};
      if (count > 0)
      {
        this->Block = { 0, count, true };
      }
      else
      {
        *this->LastStatus = bindpose::Status();
        this->ExecuteAgain = false;
        this->SetErrorCode(vtkErrorCode::NoError);
      }
      return;
    }
  }
}

int vtkBindposeAlgorithm::RequestData(vtkInformationVector** input, vtkInformationVector* output)
{
  if (!this->MakesPieces() && GetPiece(output->GetInformationObject(0)) > 0 &&
    !this->WorksByPieces(input))
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
  const bool earlier_block_failed = this->Block.index > 0 && !this->LastStatus->usable();
  bindpose::Status status;
  if (earlier_block_failed && this->LastStatus->code == bindpose::StatusCode::canceled)
  {
    status = bindpose::Status::canceled();
  }
  BlockInputs inputs(input, this->GetNumberOfInputPorts());
  for (int port = 0; port < this->GetNumberOfInputPorts() && status.usable(); ++port)
  {
    for (int i = 0; i < input[port]->GetNumberOfInformationObjects() && status.usable(); ++i)
    {
      vtkDataObject* data = vtkDataObject::GetData(input[port]->GetInformationObject(i));
      if (this->HasBlocks(port, data))
      {
        status = inputs.select_block(port, i, vtkCompositeDataSet::SafeDownCast(data), this->Block);
        data = vtkDataObject::GetData(inputs.get()[port]->GetInformationObject(i));
      }
      if (status.usable() && this->EndsWithFailedInput())
      {
        status = bindpose::upstream_failure(data);
      }
      if (status.usable())
      {
        const bindpose::Status checked = bindpose::check_cells(data);
        status = checked.ok() ? status : checked;
      }
    }
  }
  if (status.usable())
  {
    status = status_of([&]() { return this->Execute(context, inputs.get(), output); });
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
  const bool repeated = earlier_block_failed && status.message == this->LastStatus->message;
  if (!earlier_block_failed)
  {
    *this->LastStatus = status;
    this->ExecuteAgain = !status.usable();
    this->SetErrorCode(
      status.usable() || canceled ? vtkErrorCode::NoError : vtkErrorCode::UserError);
  }
  if (!status.usable() && !canceled && !repeated)
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
  this->WithContext(
    [&](bindpose::ExecutionContext& context)
    {
      *this->LastStatus = status_of([&]() { return work(context); });
      bindpose::add_outcome(*this->LastStatus);
      this->LastStatus->report.merge(context.seconds());
    });
  return this->LastStatus->usable();
}

void vtkBindposeAlgorithm::WithContext(
  const std::function<void(bindpose::ExecutionContext& context)>& work)
{
  this->SetAbortExecute(0); // the executive also clears the abort flag before an execution
  bindpose::ExecutionContext context([this](double fraction, const std::string& phase)
    { this->ReportProgress(fraction, phase); },
    [this]() { return this->GetAbortExecute() != 0; });
  context.set_threads(this->NumberOfThreads);
  work(context);
}

void vtkBindposeAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "Status: " << this->GetStatusAsString() << "\n";
  os << indent << "StatusMessage: " << this->LastStatus->message << "\n";
  os << indent << "Report: " << this->GetReportJSON() << "\n";
}
