// The text is parsed against the handles' names, one frame of it becomes a pose on top of the one
// that the input carries, and the pose's arrays take the place of the input's.
#include "vtkPoseHandles.h"

#include "base/execution.h"
#include "conversion.h"
#include "expression_parser.h"
#include "file_kind.h"
#include "gltf_data.h"
#include "io/dmat.h"
#include "pose/pose_file.h"
#include "pose/pose_matrix.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

using namespace bindpose;
using SDDP = vtkStreamingDemandDrivenPipeline;

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

bool vtkPoseHandles::IsFrom(const char* endings) const
{
  return this->FileName && is_listed(file_extension(this->FileName), endings);
}

/// The pose and where it is from, as the beginning of a sentence; empty: not from a file.
Status vtkPoseHandles::ReadText(std::string& text, std::string& source)
{
  text = this->PoseJSON;
  source.clear();
  if (this->FileName && *this->FileName)
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
  return {};
}

int vtkPoseHandles::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* info = output->GetInformationObject(0);
  info->Remove(SDDP::TIME_STEPS());
  info->Remove(SDDP::TIME_RANGE());
  std::string text, source;
  PoseTimes times;
  // What is wrong with the text, Execute() says.
  if (this->IsFrom("glb gltf dmat") || !this->ReadText(text, source).ok() ||
    !read_pose_times(text, times) || (times.frames < 2 && !times.has_expressions))
  {
    return 1;
  }
  double range[2] = { 0.0, this->EndTime };
  if (times.frames > 1)
  {
    std::vector<double> steps;
    for (Index frame = 0; frame < times.frames; ++frame)
    {
      steps.push_back(static_cast<double>(frame) / times.frames_per_second);
    }
    range[1] = steps.back();
    info->Set(SDDP::TIME_STEPS(), steps.data(), static_cast<int>(steps.size()));
  }
  info->Set(SDDP::TIME_RANGE(), range, 2);
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

  vtkInformation* info = output->GetInformationObject(0);
  const bool timed = info->Has(SDDP::UPDATE_TIME_STEP()) && info->Has(SDDP::TIME_RANGE());
  const double time = timed ? info->Get(SDDP::UPDATE_TIME_STEP()) : this->Time;
  this->NumberOfFrames = 1;
  this->Sequence = false;
  this->FramesPerSecond = PoseSequence().frames_per_second;
  this->HasExpressions = false;
  const bool from_text = !this->IsFrom("glb gltf dmat");
  std::string text, source;
  status = from_text       ? this->ReadText(text, source)
    : this->IsFrom("dmat") ? this->TakeDMAT(handles, pose)
                           : this->TakeGLTF(handles, pose);
  if (!status.ok())
  {
    return status;
  }
  if (from_text && (!source.empty() || !text.empty()))
  {
    PoseSequence sequence;
    ExpressionParser parser;
    status = parse_pose_file(
      text, handles, sequence,
      [&parser](const std::string& expression, double t, double& value)
      { return parser.evaluate(expression, t, value); },
      time);
    if (!status.ok())
    {
      status.message = source + status.message;
      return status;
    }
    this->NumberOfFrames = static_cast<int>(sequence.frames.size());
    this->FramesPerSecond = sequence.frames_per_second;
    this->Sequence = sequence.sequence;
    this->HasExpressions = sequence.has_expressions;
    int frame = this->Frame;
    if (timed)
    {
      // The frame that is on; times of frames may be off by round-off.
      frame = static_cast<int>(std::floor(std::clamp(
        time * this->FramesPerSecond + 1e-6, 0.0, static_cast<double>(this->NumberOfFrames - 1))));
    }
    if (frame < 0 || frame >= this->NumberOfFrames)
    {
      return Status::invalid_input(source + "there is no frame " + std::to_string(frame) +
        ", only " + std::to_string(this->NumberOfFrames) + " (counted from 0)");
    }
    pose = apply_edits(sequence.frames[frame], handles, pose);
  }
  result->ShallowCopy(data);
  set_pose(result, cells, pose);
  if (timed)
  {
    result->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
  status.report.set("counts.handles", static_cast<int>(handles.size()));
  status.report.set("counts.frames", this->NumberOfFrames);
  return status;
}

/// One pose of all handles.
Status vtkPoseHandles::TakeDMAT(const Handles& handles, Pose& pose)
{
  Weights matrix;
  Status status = read_dmat(this->FileName, matrix);
  if (!status.ok())
  {
    return status;
  }
  status = pose_of_matrix(matrix, handles, pose);
  if (!status.ok())
  {
    status.message = std::string(this->FileName) + ": " + status.message;
    return status;
  }
  return this->Frame == 0
    ? status
    : Status::invalid_input(std::string(this->FileName) + ": there is no frame " +
        std::to_string(this->Frame) + ", only 1 (counted from 0)");
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
  os << indent << "Time: " << this->Time << "\n";
  os << indent << "EndTime: " << this->EndTime << "\n";
  os << indent << "HasExpressions: " << this->HasExpressions << "\n";
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "Sequence: " << (this->Sequence ? "yes" : "no") << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
}
