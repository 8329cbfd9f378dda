// The text is parsed against the handles' names, one frame of it becomes a pose on top of the one
// that the input carries, and the pose's arrays take the place of the input's.
#include "vtkPoseHandles.h"

#include "base/execution.h"
#include "conversion.h"
#include "pose/pose_file.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

using namespace bindpose;

vtkStandardNewMacro(vtkPoseHandles);

vtkPoseHandles::vtkPoseHandles() = default;

vtkPoseHandles::~vtkPoseHandles()
{
  this->SetFileName(nullptr);
}

void vtkPoseHandles::SetPoseJSON(const std::string& text)
{
  if (this->PoseJSON != text)
  {
    this->PoseJSON = text;
    this->Modified();
  }
}

int vtkPoseHandles::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkPoseHandles::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

Status vtkPoseHandles::Execute(
  vtkInformationVector** input, vtkInformationVector* output, ExecutionContext&)
{
  auto* data = vtkPolyData::GetData(input[0], 0);
  auto* result = vtkPolyData::GetData(output, 0);
  Handles handles;
  std::vector<Index> cells;
  Status status = to_handles(data, handles, &cells);
  if (!status.ok())
  {
    return status;
  }
  Pose pose;
  status = to_pose(data, handles, cells, pose);
  if (!status.ok())
  {
    return status;
  }

  std::string text = this->PoseJSON;
  std::string source;
  const bool from_file = this->FileName && *this->FileName;
  if (from_file)
  {
    source = std::string(this->FileName) + ": ";
    std::ifstream file(this->FileName);
    std::ostringstream content;
    content << file.rdbuf();
    if (!file.is_open() || file.bad())
    {
      return Status::invalid_input(source + "cannot be read (" + std::strerror(errno) + ")");
    }
    text = content.str();
  }
  this->NumberOfFrames = 1;
  this->FramesPerSecond = PoseSequence().frames_per_second;
  if (from_file || !text.empty())
  {
    PoseSequence sequence;
    status = parse_pose_file(text, handles, sequence);
    if (!status.ok())
    {
      status.message = source + status.message;
      return status;
    }
    this->NumberOfFrames = static_cast<int>(sequence.frames.size());
    this->FramesPerSecond = sequence.frames_per_second;
    if (this->Frame < 0 || this->Frame >= this->NumberOfFrames)
    {
      return Status::invalid_input(source + "there is no frame " + std::to_string(this->Frame) +
        ", only " + std::to_string(this->NumberOfFrames) + " (counted from 0)");
    }
    pose = apply_edits(sequence.frames[this->Frame], handles, pose);
  }
  result->ShallowCopy(data);
  set_pose(result, cells, pose);
  status.report.set("counts.handles", static_cast<int>(handles.size()));
  status.report.set("counts.frames", this->NumberOfFrames);
  return status;
}

void vtkPoseHandles::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PoseJSON: " << this->PoseJSON << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Frame: " << this->Frame << "\n";
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
}
