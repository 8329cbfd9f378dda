// Exchanges the parts of a dataset between processes. Every process must send and receive the same
// messages in the same order; otherwise the processes would wait for each other forever. Therefore
//
// - all processes make the same decision whether to exchange data. It depends on a change upstream,
//   the requested time and the result of the last exchange, which are the same on all processes. It
//   does not depend on the requested piece;
// - the executive calls the filter even if an algorithm upstream has failed on this process. The
//   process then sends the failure instead of its part;
// - processes agree on the outcome after every step that can fail on one of them.
#include "vtkShareDataset.h"

#include "base/execution.h"
#include "bind_key.h"
#include "output_type.h"
#include "report_field_data.h"

#include "vtkAbstractArray.h"
#include "vtkAppendFilter.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataPipeline.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <vector>

using namespace bindpose;

vtkStandardNewMacro(vtkShareDataset);
vtkCxxSetObjectMacro(vtkShareDataset, Controller, vtkMultiProcessController);

namespace
{
constexpr int part_tag = 57301;
/// Largest message, in bytes. Some implementations of MPI count bytes with 32 bits.
constexpr vtkIdType largest_message = vtkIdType(1) << 30;
/// Largest dataset, in KiB: 4 GiB minus 64 MiB. VTK counts the bytes of a message with 32 bits; 64
/// MiB are reserved for the names in the message.
constexpr unsigned long largest_dataset = (4ul << 20) - (64ul << 10);

/// The executive of the filter. It calls the filter even if an algorithm upstream has failed.
class SharePipeline : public vtkCompositeDataPipeline
{
public:
  static SharePipeline* New();
  vtkTypeMacro(SharePipeline, vtkCompositeDataPipeline);

  /// Report whether anything upstream, or the filter itself, has changed since the filter was
  /// executed.
  bool has_changed() const { return this->HasChanged; }
  /// Report whether an algorithm upstream has failed.
  bool upstream_failed() const { return this->InformationFailed || this->DataFailed; }

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override
  {
    if (request->Has(REQUEST_DATA()))
    {
      this->HasChanged = this->PipelineMTime > this->DataTime.GetMTime();
    }
    return this->Superclass::ProcessRequest(request, input, output);
  }

protected:
  SharePipeline() = default;
  ~SharePipeline() override = default;

  using vtkCompositeDataPipeline::ForwardUpstream;
  int ForwardUpstream(vtkInformation* request) override
  {
    const bool failed = this->Superclass::ForwardUpstream(request) == 0;
    if (request->Has(REQUEST_DATA_OBJECT()))
    {
      this->InformationFailed = failed;
    }
    else if (request->Has(REQUEST_INFORMATION()))
    {
      this->InformationFailed = this->InformationFailed || failed;
    }
    else if (request->Has(REQUEST_UPDATE_EXTENT()))
    {
      this->DataFailed = failed;
    }
    else if (request->Has(REQUEST_DATA()))
    {
      this->DataFailed = this->DataFailed || failed;
    }
    return 1;
  }

private:
  SharePipeline(const SharePipeline&) = delete;
  void operator=(const SharePipeline&) = delete;

  bool HasChanged = true;
  bool InformationFailed = false;
  bool DataFailed = false;
};
vtkStandardNewMacro(SharePipeline);

/// Describes one process's part of the dataset. Each process sends its description to process 0.
struct Part
{
  Status status;
  std::string class_name;
  std::int64_t points = 0;
  std::int64_t bytes = 0; ///< size of the converted part; 0 on process 0, which sends no part
};

vtkMultiProcessStream& operator<<(vtkMultiProcessStream& stream, const Part& part)
{
  return stream << static_cast<int>(part.status.code) << part.status.message << part.class_name
                << static_cast<vtkTypeInt64>(part.points) << static_cast<vtkTypeInt64>(part.bytes);
}

vtkMultiProcessStream& operator>>(vtkMultiProcessStream& stream, Part& part)
{
  int code = 0;
  vtkTypeInt64 points = 0, bytes = 0;
  stream >> code >> part.status.message >> part.class_name >> points >> bytes;
  part.status.code = static_cast<StatusCode>(code);
  part.points = points;
  part.bytes = bytes;
  return stream;
}

Status no_connection()
{
  return Status::failure(
    StatusCode::internal_error, "the processes could not exchange their messages");
}

/// Call work() and return its status. An exception becomes the status internal_error, because it
/// would interrupt the exchange.
template <typename Work>
Status status_of_process(const Work& work)
{
  try
  {
    return work();
  }
  catch (const std::bad_alloc&)
  {
    return Status::failure(StatusCode::internal_error, "out of memory");
  }
  catch (const std::exception& error)
  {
    return Status::failure(StatusCode::internal_error, error.what());
  }
}

/// Return the modification times of all arrays of a dataset, except those of its report.
BindKey key_of_part(vtkDataObject* data)
{
  BindKey key;
  if (auto* set = vtkPointSet::SafeDownCast(data))
  {
    key.add(set->GetPoints() ? set->GetPoints()->GetData() : nullptr);
    for (vtkFieldData* arrays : { static_cast<vtkFieldData*>(set->GetPointData()),
           static_cast<vtkFieldData*>(set->GetCellData()), set->GetFieldData() })
    {
      for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
      {
        vtkAbstractArray* array = arrays->GetAbstractArray(i);
        const std::string name = array->GetName() ? array->GetName() : "";
        if (name.compare(0, 7, "Report.") != 0)
        {
          key.add(array);
        }
      }
    }
  }
  if (auto* polydata = vtkPolyData::SafeDownCast(data))
  {
    for (vtkCellArray* cells :
      { polydata->GetVerts(), polydata->GetLines(), polydata->GetPolys(), polydata->GetStrips() })
    {
      key.add(cells);
    }
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    key.add(grid->GetCells());
    key.add(grid->GetCellTypesArray());
  }
  return key;
}

/// Return invalid_input if VTK cannot convert the dataset to a message without loss.
Status check_sendable(vtkDataSet* data)
{
  if (data->GetActualMemorySize() > largest_dataset)
  {
    return Status::invalid_input("the dataset needs " +
      std::to_string(data->GetActualMemorySize() >> 10) + " MiB; at most " +
      std::to_string(largest_dataset >> 10) + " MiB can be sent");
  }
  for (vtkFieldData* arrays : { static_cast<vtkFieldData*>(data->GetPointData()),
         static_cast<vtkFieldData*>(data->GetCellData()), data->GetFieldData() })
  {
    for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = arrays->GetArray(i);
      for (int c = 0; array && array->GetDataType() == VTK_ID_TYPE &&
           array->GetNumberOfTuples() > 0 && c < array->GetNumberOfComponents();
           ++c)
      {
        // VTK converts ids to integers of 32 bits.
        double range[2];
        array->GetRange(range, c);
        if (range[0] < std::numeric_limits<int>::min() ||
          range[1] > std::numeric_limits<int>::max())
        {
          return Status::invalid_input("the array '" +
            std::string(array->GetName() ? array->GetName() : "") +
            "' has ids that need more than 32 bits and cannot be sent");
        }
      }
    }
  }
  return {};
}

/// Convert a dataset to a message.
Status to_message(vtkDataSet* data, vtkCharArray* message)
{
  return status_of_process(
    [&]() -> Status
    {
      const Status status = check_sendable(data);
      if (!status.ok())
      {
        return status;
      }
      return vtkCommunicator::MarshalDataObject(data, message)
        ? Status()
        : Status::failure(
            StatusCode::internal_error, "the dataset could not be converted to a message");
    });
}

/// Convert a message to a dataset, which must have the given number of points.
Status from_message(
  vtkCharArray* message, std::int64_t points, vtkSmartPointer<vtkDataObject>& data)
{
  return status_of_process(
    [&]() -> Status
    {
      data = vtkCommunicator::UnMarshalDataObject(message);
      auto* set = vtkPointSet::SafeDownCast(data);
      return set && set->GetNumberOfPoints() == points
        ? Status()
        : Status::failure(StatusCode::internal_error, "a message with a dataset could not be read");
    });
}

template <typename Append>
vtkSmartPointer<vtkDataObject> append_parts(
  const std::vector<vtkSmartPointer<vtkDataObject>>& parts)
{
  vtkNew<Append> append;
  for (const auto& part : parts)
  {
    append->AddInputDataObject(part);
  }
  append->Update();
  return append->GetOutput();
}

/// Return the failure of the first process that has failed, or invalid_input if the parts are of
/// different classes.
Status check_parts(const std::vector<Part>& parts)
{
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (!parts[i].status.ok())
    {
      return Status::failure(
        parts[i].status.code, "process " + std::to_string(i) + ": " + parts[i].status.message);
    }
  }
  for (std::size_t i = 1; i < parts.size(); ++i)
  {
    if (parts[i].class_name != parts[0].class_name)
    {
      return Status::invalid_input("process 0 has a " + parts[0].class_name + ", but process " +
        std::to_string(i) + " has a " + parts[i].class_name +
        "; all processes must have parts of the same class");
    }
  }
  return {};
}

/// Status and sizes after process 0 has checked or combined the parts. Process 0 sends them to the
/// other processes.
struct Outcome
{
  Status status;
  std::int64_t points = 0, cells = 0, parts = 0;
  std::int64_t bytes = 0; ///< size of the converted dataset
  std::int64_t bytes_sent = 0; ///< total size of all sent parts and datasets
};

/// Send an outcome from process 0 to all processes.
bool broadcast(vtkMultiProcessController* controller, Outcome& outcome)
{
  vtkMultiProcessStream stream;
  stream << static_cast<int>(outcome.status.code) << outcome.status.message;
  for (const std::int64_t value :
    { outcome.points, outcome.cells, outcome.parts, outcome.bytes, outcome.bytes_sent })
  {
    stream << static_cast<vtkTypeInt64>(value);
  }
  if (!controller->Broadcast(stream, 0))
  {
    return false;
  }
  if (controller->GetLocalProcessId() > 0)
  {
    int code = 0;
    stream >> code >> outcome.status.message;
    outcome.status.code = static_cast<StatusCode>(code);
    for (std::int64_t* value :
      { &outcome.points, &outcome.cells, &outcome.parts, &outcome.bytes, &outcome.bytes_sent })
    {
      vtkTypeInt64 number = 0;
      stream >> number;
      *value = number;
    }
  }
  return true;
}

using Messages = std::vector<vtkSmartPointer<vtkCharArray>>;

/// Allocate the memory for the parts that process 0 receives from other processes.
Status allocate_messages(const std::vector<Part>& parts, Messages& messages)
{
  return status_of_process(
    [&]() -> Status
    {
      for (const Part& part : parts)
      {
        messages.push_back(vtkSmartPointer<vtkCharArray>::New());
        messages.back()->SetNumberOfTuples(part.bytes);
      }
      return {};
    });
}

/// Receive the parts of all other processes on process 0 and append them. All parts are received,
/// even after a failure, because the other processes wait until their parts are received.
Outcome receive_parts(vtkMultiProcessController* controller, const std::vector<Part>& parts,
  Messages& messages, vtkDataObject* own, vtkSmartPointer<vtkDataObject>& whole,
  vtkCharArray* message)
{
  Outcome outcome;
  std::vector<vtkSmartPointer<vtkDataObject>> received;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (parts[i].points == 0)
    {
      continue;
    }
    vtkSmartPointer<vtkDataObject> data = own;
    Status status;
    if (i > 0)
    {
      char* const memory = messages[i]->GetPointer(0);
      status = controller->Receive(memory, parts[i].bytes, static_cast<int>(i), part_tag)
        ? from_message(messages[i], parts[i].points, data)
        : no_connection();
      messages[i] = nullptr;
    }
    received.push_back(data);
    outcome.parts += 1;
    outcome.bytes_sent += parts[i].bytes;
    outcome.status = outcome.status.ok() ? status : outcome.status;
  }
  if (outcome.status.ok())
  {
    outcome.status = status_of_process(
      [&]() -> Status
      {
        whole.TakeReference(own->NewInstance());
        if (received.size() > 1)
        {
          whole->ShallowCopy(vtkPolyData::SafeDownCast(own)
              ? append_parts<vtkAppendPolyData>(received)
              : append_parts<vtkAppendFilter>(received));
        }
        else
        {
          whole->ShallowCopy(received.empty() ? own : received[0].Get());
        }
        auto* set = vtkPointSet::SafeDownCast(whole);
        outcome.points = set->GetNumberOfPoints();
        outcome.cells = set->GetNumberOfCells();
        return parts.size() > 1 ? to_message(set, message) : Status();
      });
  }
  if (outcome.status.ok())
  {
    outcome.bytes = message->GetNumberOfTuples();
    outcome.bytes_sent += outcome.bytes * (static_cast<std::int64_t>(parts.size()) - 1);
  }
  return outcome;
}

/// Send a message of the given size from process 0 to all processes.
bool broadcast(vtkMultiProcessController* controller, vtkCharArray* message, std::int64_t bytes)
{
  for (vtkIdType begin = 0; begin < bytes; begin += largest_message)
  {
    const vtkIdType count = std::min<vtkIdType>(largest_message, bytes - begin);
    if (!controller->Broadcast(message->GetPointer(begin), count, 0))
    {
      return false;
    }
  }
  return true;
}
} // namespace

struct vtkShareDataset::Internals
{
  bool valid = false; ///< whether the last exchange succeeded; the same on all processes
  bool timed = false; ///< whether a time was requested in the last exchange
  double time = 0.0;
  BindKey key; ///< arrays of the part in the last exchange
  vtkSmartPointer<vtkDataObject> whole;
  Report report;
};

vtkShareDataset::vtkShareDataset() : Internal(new Internals)
{
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkShareDataset::~vtkShareDataset()
{
  this->SetController(nullptr);
}

vtkExecutive* vtkShareDataset::CreateDefaultExecutive()
{
  return SharePipeline::New();
}

void vtkShareDataset::SetExecutive(vtkExecutive* executive)
{
  // Accept only executives of the class SharePipeline, because ParaView tries to replace the
  // executives of all algorithms.
  if (!executive || dynamic_cast<SharePipeline*>(executive))
  {
    this->Superclass::SetExecutive(executive);
  }
}

int vtkShareDataset::GetProcess()
{
  return this->Controller ? this->Controller->GetLocalProcessId() : 0;
}

int vtkShareDataset::GetNumberOfProcesses()
{
  return this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
}

int vtkShareDataset::FillInputPortInformation(int, vtkInformation* info)
{
  // Execute() reports a missing input and an input of another class on all processes. If the
  // executive reported them on one process, the other processes would wait.
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  info->Set(INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkShareDataset::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

int vtkShareDataset::RequestDataObject(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkDataObject* grid = vtkUnstructuredGrid::GetData(input[0]);
  match_output_type(grid ? grid : vtkNew<vtkPolyData>().Get(), output);
  return 1;
}

int vtkShareDataset::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector*)
{
  using SDDP = vtkStreamingDemandDrivenPipeline;
  if (vtkInformation* info = input[0]->GetInformationObject(0))
  {
    RequestWholeInput(info);
    info->Set(SDDP::UPDATE_PIECE_NUMBER(), this->GetProcess());
    info->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), this->GetNumberOfProcesses());
  }
  return 1;
}

Status vtkShareDataset::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  using SDDP = vtkStreamingDemandDrivenPipeline;
  const Phase phase(context, "share");
  Internals& shared = *this->Internal;
  vtkInformation* info = output->GetInformationObject(0);
  auto* pipeline = static_cast<SharePipeline*>(this->GetExecutive());
  const bool timed = info->Has(SDDP::TIME_RANGE()) && info->Has(SDDP::UPDATE_TIME_STEP());
  const double time = timed ? info->Get(SDDP::UPDATE_TIME_STEP()) : 0.0;
  if (!shared.valid || pipeline->has_changed() || shared.timed != timed || shared.time != time)
  {
    vtkDataObject* part = vtkDataObject::GetData(input[0]);
    Status status = upstream_failure(part);
    if (status.ok() && pipeline->upstream_failed())
    {
      status = Status::invalid_input("an algorithm before vtkShareDataset has failed");
    }
    else if (status.ok() && !part)
    {
      status = Status::invalid_input("the input is missing");
    }
    else if (status.ok() && vtkCompositeDataSet::SafeDownCast(part))
    {
      status = Status::invalid_input("the input has blocks; merge them into one dataset first");
    }
    else if (status.ok() && !vtkPolyData::SafeDownCast(part) &&
      !vtkUnstructuredGrid::SafeDownCast(part))
    {
      status = Status::invalid_input(std::string("the input is a ") + part->GetClassName() +
        "; expected a vtkPolyData or vtkUnstructuredGrid");
    }
    if (context.canceled())
    {
      status = Status::canceled();
    }
    status = this->Exchange(part, status);
    shared.valid = status.ok();
    if (!status.ok())
    {
      return status;
    }
    shared.timed = timed;
    shared.time = time;
  }
  vtkDataObject* result = vtkDataObject::GetData(info);
  if (GetPiece(info) == 0)
  {
    result->ShallowCopy(shared.whole);
  }
  else
  {
    result->Initialize();
  }
  Status status;
  status.report = shared.report;
  return status;
}

/// Exchange the parts of all processes.
/// @param part_status  whether the part of this process can be used
/// @return the same code and message on all processes
Status vtkShareDataset::Exchange(vtkDataObject* part, const Status& part_status)
{
  Internals& shared = *this->Internal;
  vtkMultiProcessController* controller = this->Controller;
  const int process = this->GetProcess();
  const int processes = this->GetNumberOfProcesses();
  const BindKey key = key_of_part(part);
  if (processes > 1)
  {
    const int needed = !shared.valid || !part_status.ok() || shared.key != key ? 1 : 0;
    int any_needed = 1;
    if (!controller->AllReduce(&needed, &any_needed, 1, vtkCommunicator::MAX_OP))
    {
      return no_connection();
    }
    if (!any_needed)
    {
      return {};
    }
  }

  Part mine;
  mine.status = part_status;
  mine.class_name = vtkUnstructuredGrid::SafeDownCast(part) ? "vtkUnstructuredGrid" : "vtkPolyData";
  auto message = vtkSmartPointer<vtkCharArray>::New();
  auto* set = vtkPointSet::SafeDownCast(part);
  if (mine.status.ok())
  {
    mine.points = set->GetNumberOfPoints();
  }
  if (process > 0 && mine.points > 0)
  {
    mine.status = to_message(set, message);
    mine.bytes = message->GetNumberOfTuples();
  }
  if (processes == 1 && !mine.status.ok())
  {
    return mine.status;
  }

  Outcome outcome;
  Messages messages;
  std::vector<Part> parts(static_cast<std::size_t>(processes));
  parts[0] = mine;
  if (processes > 1)
  {
    vtkMultiProcessStream stream;
    stream << mine;
    std::vector<vtkMultiProcessStream> streams;
    const bool gathered = controller->Gather(stream, streams, 0) != 0 &&
      (process > 0 || streams.size() == parts.size());
    if (!gathered && process > 0)
    {
      return no_connection();
    }
    for (std::size_t i = 1; process == 0 && gathered && i < parts.size(); ++i)
    {
      streams[i] >> parts[i];
    }
    outcome.status = gathered ? Status() : no_connection();
    if (process == 0 && gathered)
    {
      outcome.status = check_parts(parts);
    }
    if (process == 0 && outcome.status.ok())
    {
      outcome.status = allocate_messages(parts, messages);
    }
    if (!broadcast(controller, outcome))
    {
      return no_connection();
    }
    if (!outcome.status.ok())
    {
      return outcome.status;
    }
  }

  vtkSmartPointer<vtkDataObject> whole;
  if (process == 0)
  {
    outcome = receive_parts(controller, parts, messages, part, whole, message);
  }
  else if (mine.points > 0 && !controller->Send(message->GetPointer(0), mine.bytes, 0, part_tag))
  {
    return no_connection();
  }
  if (processes > 1 && !broadcast(controller, outcome))
  {
    return no_connection();
  }
  if (!outcome.status.ok())
  {
    return outcome.status;
  }
  if (processes > 1)
  {
    Status status;
    if (process > 0)
    {
      status = status_of_process(
        [&]() -> Status
        {
          // Create a new array instead of resizing the array from to_message(). That array frees
          // all memory with delete[], even memory that the resizing gets from malloc().
          message = vtkSmartPointer<vtkCharArray>::New();
          message->SetNumberOfTuples(outcome.bytes);
          return {};
        });
    }
    // Send the dataset only if every process has allocated memory for it.
    int ready = status.ok() ? 1 : 0, all_ready = 0;
    if (!controller->AllReduce(&ready, &all_ready, 1, vtkCommunicator::MIN_OP))
    {
      return no_connection();
    }
    if (all_ready && !broadcast(controller, message, outcome.bytes))
    {
      return no_connection();
    }
    if (all_ready && process > 0)
    {
      status = from_message(message, outcome.points, whole);
    }
    ready = all_ready && status.ok() ? 1 : 0;
    if (!controller->AllReduce(&ready, &all_ready, 1, vtkCommunicator::MIN_OP))
    {
      return no_connection();
    }
    if (!all_ready)
    {
      return Status::failure(
        StatusCode::internal_error, "a process could not store the shared dataset");
    }
  }
  shared.key = key;
  shared.whole = whole;
  shared.report = Report();
  shared.report.set("counts.points", outcome.points);
  shared.report.set("counts.cells", outcome.cells);
  shared.report.set("counts.parts", outcome.parts);
  shared.report.set("counts.processes", processes);
  shared.report.set("bytes_sent", outcome.bytes_sent);
  this->NumberOfExchanges += 1;
  return {};
}

void vtkShareDataset::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfProcesses: " << this->GetNumberOfProcesses() << "\n";
  os << indent << "NumberOfExchanges: " << this->NumberOfExchanges << "\n";
}
