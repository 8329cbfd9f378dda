// The base class edits a handle dataset in place. This class creates the dataset from the input and
// the text of the pose. It writes the text again when the modification time of the dataset has
// changed.
#include "vtkPVHandleSetRepresentation.h"

#include "conversion.h"
#include "pose/pose_file.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <vector>

using bindpose::Handles;
using bindpose::Index;
using bindpose::Pose;
using bindpose::Status;

namespace
{
/// Handles of a dataset with their cells and pose.
struct PosedHandles
{
  Handles handles;
  std::vector<Index> cells;
  Pose pose;
};

Status read_posed_handles(vtkPolyData* data, PosedHandles& posed)
{
  const Status status = bindpose::to_handles(data, posed.handles, &posed.cells);
  return status.ok() ? bindpose::to_pose(data, posed.handles, posed.cells, posed.pose) : status;
}

/// Apply the text of a pose to a dataset in place.
Status apply_pose_text(const std::string& text, vtkPolyData* data)
{
  PosedHandles posed;
  Status status = read_posed_handles(data, posed);
  if (!status.ok())
  {
    return status;
  }
  if (!text.empty())
  {
    bindpose::PoseSequence sequence;
    status = bindpose::parse_pose_file(text, posed.handles, sequence);
    if (!status.ok())
    {
      return status;
    }
    posed.pose = bindpose::apply_edits(sequence.frames.front(), posed.handles, posed.pose);
  }
  bindpose::set_pose(data, posed.cells, posed.pose);
  return status;
}

/// Make a copy that shares all arrays with the original.
vtkSmartPointer<vtkPolyData> shallow_copy(vtkPolyData* data)
{
  if (!data)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkPolyData> copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(data);
  return copy;
}

/// Report whether a text is a sequence or has expressions.
bool is_animated(const std::string& text)
{
  bindpose::PoseTimes times;
  return bindpose::read_pose_times(text, times) && (times.frames > 1 || times.has_expressions);
}
} // namespace

vtkStandardNewMacro(vtkPVHandleSetRepresentation);

vtkPVHandleSetRepresentation::vtkPVHandleSetRepresentation() = default;
vtkPVHandleSetRepresentation::~vtkPVHandleSetRepresentation() = default;

// ---- The text and the dataset ------------------------------------------------------------------

void vtkPVHandleSetRepresentation::SetInputHandles(vtkPolyData* handles)
{
  // ParaView also reports updates that did not execute the algorithm. Ignore them, because posing
  // the handles again would end a drag.
  const vtkMTimeType time = handles ? handles->GetMTime() : 0;
  if (handles && handles == this->InputObject && time == this->InputTime)
  {
    return;
  }
  this->InputObject = handles;
  this->InputTime = time;
  // Update PoseJSON from the drawn handles before they are replaced.
  this->GetPoseJSON();
  // Keep a copy, because the next update of the algorithm changes its output.
  this->InputHandles = shallow_copy(handles);
  this->DrawPose();
}

void vtkPVHandleSetRepresentation::SetOutputHandles(vtkPolyData* handles)
{
  this->OutputHandles = shallow_copy(handles);
  if (this->IsPoseFixed())
  {
    this->DrawPose();
  }
}

void vtkPVHandleSetRepresentation::SetPoseFromFile(bool fromFile)
{
  if (this->PoseFromFile != fromFile)
  {
    this->GetPoseJSON();
    this->PoseFromFile = fromFile;
    this->DrawPose();
  }
}

bool vtkPVHandleSetRepresentation::IsPoseFixed()
{
  return this->PoseFromFile || is_animated(this->PoseJSON);
}

void vtkPVHandleSetRepresentation::SetPoseJSON(const char* text)
{
  const std::string value = text ? text : "";
  // ParaView sends back the text of every drag. Ignore this text, because posing the handles again
  // would end the drag.
  if (value != this->GetPoseJSON())
  {
    this->PoseJSON = value;
    this->DrawPose();
  }
}

const char* vtkPVHandleSetRepresentation::GetPoseJSON()
{
  if (this->GetHandles() && !this->IsPoseFixed() &&
    this->DrawnHandles->GetMTime() != this->FormattedTime)
  {
    std::string text;
    if (this->FormatPose(text))
    {
      this->PoseJSON = text;
    }
    this->FormattedTime = this->DrawnHandles->GetMTime();
  }
  return this->PoseJSON.c_str();
}

std::string vtkPVHandleSetRepresentation::GetDrawnPoseJSON()
{
  std::string text;
  return this->GetHandles() && this->FormatPose(text) ? text : std::string();
}

/// Write the pose of the drawn handles as text. Set PoseMessage. Return false if there is no text.
bool vtkPVHandleSetRepresentation::FormatPose(std::string& text)
{
  PosedHandles before;
  PosedHandles after;
  Status status = read_posed_handles(this->InputHandles, before);
  if (status.ok())
  {
    status = read_posed_handles(this->DrawnHandles, after);
  }
  if (status.ok())
  {
    status = bindpose::format_pose_changes(before.pose, after.pose, before.handles, text);
  }
  this->PoseMessage = status.message;
  for (const std::string& warning : status.warnings)
  {
    this->PoseMessage += (this->PoseMessage.empty() ? "" : "; ") + warning;
  }
  return status.ok();
}

void vtkPVHandleSetRepresentation::DrawPose()
{
  this->PoseMessage.clear();
  if (!this->InputHandles || this->InputHandles->GetNumberOfCells() == 0)
  {
    this->DrawHandles(nullptr);
    return;
  }
  const bool fixed = this->IsPoseFixed();
  vtkSmartPointer<vtkPolyData> posed =
    shallow_copy(fixed && this->OutputHandles ? this->OutputHandles : this->InputHandles);
  // OutputHandles are already in the fixed pose, so no text is applied to them.
  const Status status = apply_pose_text(fixed ? std::string() : this->PoseJSON, posed);
  if (!status.ok())
  {
    this->PoseMessage = status.message;
    if (this->DrawnHandles->GetNumberOfCells() != this->InputHandles->GetNumberOfCells())
    {
      this->DrawHandles(nullptr);
    }
    return;
  }
  if (fixed)
  {
    vtkNew<vtkIntArray> locked;
    locked->SetName("Locked");
    locked->SetNumberOfTuples(posed->GetNumberOfCells());
    locked->FillValue(1);
    posed->GetCellData()->AddArray(locked);
  }
  this->DrawHandles(posed);
}

/// Replace the drawn handles. The dataset stays the same object, because another dataset would
/// clear the selection.
void vtkPVHandleSetRepresentation::DrawHandles(vtkPolyData* handles)
{
  this->CancelWidgetInteraction();
  const vtkIdType count = handles ? handles->GetNumberOfCells() : 0;
  if (count != this->DrawnHandles->GetNumberOfCells())
  {
    this->ClearSelection();
    this->SetHoveredHandle(-1);
  }
  if (handles)
  {
    this->DrawnHandles->ShallowCopy(handles);
  }
  else
  {
    this->DrawnHandles->Initialize();
  }
  this->DrawnHandles->Modified();
  this->SetHandles(handles ? this->DrawnHandles.Get() : nullptr);
  this->FormattedTime = this->DrawnHandles->GetMTime();
  this->Modified();
}

std::string vtkPVHandleSetRepresentation::GetPoseMessage()
{
  this->GetPoseJSON();
  return this->PoseMessage;
}

// ---- Changes of the selected handles -----------------------------------------------------------

bool vtkPVHandleSetRepresentation::SetSelectedModes(int mode)
{
  vtkDataArray* modes =
    this->GetHandles() ? this->DrawnHandles->GetCellData()->GetArray("Mode") : nullptr;
  if (!modes || this->IsPoseFixed() || mode < 0 ||
    mode > static_cast<int>(bindpose::HandleMode::automatic))
  {
    return false;
  }
  const bool for_bones = bindpose::constrains_tail(static_cast<bindpose::HandleMode>(mode));
  bool changed = false;
  for (int number = 0; number < this->GetNumberOfSelectedHandles(); ++number)
  {
    const vtkIdType handle = this->GetSelectedHandle(number);
    if (this->GetHandleMode(handle) != mode && (!for_bones || this->IsBone(handle)))
    {
      modes->SetComponent(handle, 0, mode);
      changed = true;
    }
  }
  if (changed)
  {
    modes->Modified();
    this->DrawnHandles->Modified();
    this->Modified();
  }
  return changed;
}

bool vtkPVHandleSetRepresentation::ResetSelectedHandles()
{
  const std::string before = this->GetPoseJSON();
  if (!this->IsPoseFixed())
  {
    for (int number = 0; number < this->GetNumberOfSelectedHandles(); ++number)
    {
      this->ResetHandle(this->GetSelectedHandle(number));
    }
  }
  return this->GetPoseJSON() != before;
}

void vtkPVHandleSetRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "InputHandles: " << this->InputHandles.Get() << "\n";
  os << indent << "OutputHandles: " << this->OutputHandles.Get() << "\n";
  os << indent << "PoseJSON: " << this->GetPoseJSON() << "\n";
  os << indent << "PoseFromFile: " << this->PoseFromFile << "\n";
  os << indent << "PoseMessage: " << this->PoseMessage << "\n";
}
