// The text is parsed against the handles' names, one frame of it becomes a pose on top of the one
// that the input carries, and the pose's arrays take the place of the input's.
#include "vtkPoseHandles.h"

#include "base/execution.h"
#include "conversion.h"
#include "file_kind.h"
#include "gltf_data.h"
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
  const bool from_gltf = from_file && is_listed(file_extension(this->FileName), "glb gltf");
  if (from_gltf)
  {
    status = this->TakeGLTF(handles, pose);
    if (!status.ok())
    {
      return status;
    }
  }
  else if (from_file)
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
  if (!from_gltf)
  {
    this->NumberOfFrames = 1;
    this->Sequence = false;
    this->FramesPerSecond = PoseSequence().frames_per_second;
  }
  if (!from_gltf && (from_file || !text.empty()))
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
    this->Sequence = sequence.sequence;
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

/// The frame's transforms, by name; handles that are no joints keep their pose.
Status vtkPoseHandles::TakeGLTF(const Handles& handles, Pose& pose)
{
  const std::string path = this->FileName;
  GltfData data;
  Status status = read_gltf(path, data);
  if (!status.ok())
  {
    return status;
  }
  std::vector<Pose> frames = data.poses;
  if (frames.empty())
  {
    std::vector<Index> cells;
    Handles joints;
    frames.resize(1);
    status = to_handles(data.handles, joints, &cells);
    if (status.ok())
    {
      status = to_pose(data.handles, joints, cells, frames[0]);
    }
    if (!status.ok())
    {
      return Status::invalid_input(path + " has no skin, so there is no pose");
    }
  }
  this->NumberOfFrames = static_cast<int>(frames.size());
  this->Sequence = !data.poses.empty();
  this->FramesPerSecond = data.frames_per_second;
  if (this->Frame < 0 || this->Frame >= this->NumberOfFrames)
  {
    return Status::invalid_input(path + ": there is no frame " + std::to_string(this->Frame) +
      ", only " + std::to_string(this->NumberOfFrames) + " (counted from 0)");
  }
  std::size_t known = 0;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    for (std::size_t j = 0; j < data.handle_list.size(); ++j)
    {
      if (data.handle_list[j].name == handles[h].name)
      {
        pose[h].mode = HandleMode::full;
        pose[h].transform = frames[this->Frame][j].transform;
        known += 1;
      }
    }
  }
  return known > 0 ? Status()
                   : Status::invalid_input(path + ": none of its joints has the name of a handle");
}

void vtkPoseHandles::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PoseJSON: " << this->PoseJSON << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Frame: " << this->Frame << "\n";
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "Sequence: " << (this->Sequence ? "yes" : "no") << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
}
