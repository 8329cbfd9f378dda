// Applies a pose file to handles. The text is parsed with the names of the handles. One frame is
// combined with the pose of the input, and the resulting arrays replace the pose arrays of the
// input.
#include "vtkPoseHandles.h"

#include "base/execution.h"
#include "conversion.h"
#include "io/expression.h"
#include "file_kind.h"
#include "file_stamp.h"
#include "frame_times.h"
#include "io/dmat.h"
#include "motion_data.h"
#include "pose/pose_file.h"
#include "pose/pose_matrix.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

using namespace bindpose;
using SDDP = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkPoseHandles);

/// Caches for updates frame by frame. Without them, a sequence of n frames would be read and parsed
/// n times.
struct vtkPoseHandles::Internals
{
  MotionFile motion;
  /// Source of the last warnings: the pose file, or an empty string for PoseJSON. It is stored so
  /// that the warnings of a source are issued only once.
  std::optional<std::string> warned_source;

  FileStamp stamp; ///< stamp of the file from which `text` was read
  std::string text; ///< content of the pose file, or PoseJSON
  std::string source; ///< start of messages about the text: "pose.json: ", or empty for PoseJSON
  int text_version = 0; ///< increases when `text` changes

  int timed_version = -1; ///< version of the text from which `times` was read
  std::optional<PoseTimes> times; ///< empty if the text is not a pose file

  int parsed_version = -1; ///< version of the text from which `sequence` was parsed; -1: none
  vtkPolyData* parsed_input = nullptr; ///< the handles of `sequence`; compared, never dereferenced
  vtkMTimeType parsed_input_time = 0;
  PoseSequence sequence;
  Status parse_status;
};

vtkPoseHandles::vtkPoseHandles() : Internal(std::make_unique<Internals>()) {}

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

bool vtkPoseHandles::HasExtension(const char* extensions) const
{
  return this->FileName && is_listed(file_extension(this->FileName), extensions);
}

/// Update the cache if the pose file or PoseJSON has changed: the text, the version of the text,
/// and the source with which messages about the text begin ("FILE: ", or "" for PoseJSON).
Status vtkPoseHandles::ReadText()
{
  Internals& cache = *this->Internal;
  const auto use = [&cache](std::string text)
  {
    cache.text_version += text != cache.text ? 1 : 0;
    cache.text = std::move(text);
  };
  if (!this->FileName || !*this->FileName)
  {
    cache.source.clear();
    cache.stamp = FileStamp();
    use(this->PoseJSON);
    return {};
  }
  cache.source = std::string(this->FileName) + ": ";
  const FileStamp stamp(this->FileName);
  if (stamp.has_content_of(cache.stamp))
  {
    return {};
  }
  cache.stamp = FileStamp();
  std::ifstream file(this->FileName);
  std::ostringstream content;
  content << file.rdbuf();
  if (!file.is_open() || file.bad())
  {
    return Status::invalid_input(cache.source + "cannot be read (" + std::strerror(errno) + ")");
  }
  use(content.str());
  cache.stamp = stamp;
  return {};
}

/// Parse the cached text unless it and the handles are unchanged. A single pose with expressions
/// depends on the time and is parsed every time.
Status vtkPoseHandles::ParseText(vtkPolyData* input, const Handles& handles, double time)
{
  Internals& cache = *this->Internal;
  if (cache.parsed_version == cache.text_version && cache.parsed_input == input &&
    cache.parsed_input_time == input->GetMTime())
  {
    return cache.parse_status;
  }
  cache.parsed_version = -1;
  ExpressionParser parser;
  cache.parse_status = parse_pose_file(
    cache.text, handles, cache.sequence,
    [&parser](const std::string& expression, double t, double& value)
    { return parser.evaluate(expression, t, value); },
    time);
  if (cache.parse_status.ok() && (cache.sequence.sequence || !cache.sequence.has_expressions))
  {
    cache.parsed_version = cache.text_version;
    cache.parsed_input = input;
    cache.parsed_input_time = input->GetMTime();
  }
  return cache.parse_status;
}

int vtkPoseHandles::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  vtkInformation* info = output->GetInformationObject(0);
  set_time_steps(info, {});
  // Ignore errors of the file or the text here; Execute() reports them.
  if (this->HasExtension(motion_extensions()))
  {
    this->WithContext(
      [&](ExecutionContext& context)
      {
        HandleMotion motion;
        if (this->Internal->motion.read(context, this->FileName, motion).ok())
        {
          set_frame_times(info, motion.frames, motion.frames_per_second);
        }
      });
    return 1;
  }
  Internals& cache = *this->Internal;
  if (this->HasExtension("dmat") || !this->ReadText().ok())
  {
    return 1;
  }
  if (cache.timed_version != cache.text_version)
  {
    PoseTimes read_times;
    const bool is_pose_file = read_pose_times(cache.text, read_times);
    cache.times = is_pose_file ? std::optional<PoseTimes>(read_times) : std::nullopt;
    cache.timed_version = cache.text_version;
  }
  if (!cache.times)
  {
    return 1;
  }
  const PoseTimes& times = *cache.times;
  set_frame_times(info, static_cast<int>(times.frames), times.frames_per_second);
  if (times.frames < 2 && times.has_expressions)
  {
    const double range[2] = { 0.0, this->EndTime };
    info->Set(SDDP::TIME_RANGE(), range, 2);
  }
  return 1;
}

Status vtkPoseHandles::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
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
  double time = this->Time;
  const bool timed = requested_time(info, time);
  this->NumberOfFrames = 1;
  this->Sequence = false;
  this->FramesPerSecond = PoseSequence().frames_per_second;
  this->HasExpressions = false;
  const bool from_text = !this->HasExtension("dmat") && !this->HasExtension(motion_extensions());
  status = from_text ? this->ReadText()
    : this->HasExtension("dmat")
    ? this->ReadDMAT(handles, pose)
    : this->ReadMotion(context, handles, timed ? &time : nullptr, pose);
  if (!status.ok())
  {
    return status;
  }
  const std::string& source = this->Internal->source;
  if (from_text && (!source.empty() || !this->Internal->text.empty()))
  {
    status = this->ParseText(data, handles, time);
    if (!status.ok())
    {
      status.message = source + status.message;
      return status;
    }
    const PoseSequence& sequence = this->Internal->sequence;
    if (this->Internal->warned_source == source)
    {
      status.warnings.clear();
    }
    if (!status.warnings.empty())
    {
      this->Internal->warned_source = source;
    }
    for (std::string& warning : status.warnings)
    {
      warning = source + warning;
    }
    this->NumberOfFrames = static_cast<int>(sequence.frames.size());
    this->FramesPerSecond = sequence.frames_per_second;
    this->Sequence = sequence.sequence;
    this->HasExpressions = sequence.has_expressions;
    const int frame =
      timed ? frame_at(time, this->NumberOfFrames, this->FramesPerSecond) : this->Frame;
    if (frame < 0 || frame >= this->NumberOfFrames)
    {
      return Status::invalid_input(source + "frame " + std::to_string(frame) +
        " does not exist; there are " + std::to_string(this->NumberOfFrames) +
        " frames, counted from 0");
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

/// Set the pose of all handles from the matrix of a .dmat file.
Status vtkPoseHandles::ReadDMAT(const Handles& handles, Pose& pose)
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
    : Status::invalid_input(std::string(this->FileName) + ": frame " + std::to_string(this->Frame) +
        " does not exist; the file has 1 frame, frame 0");
}

/// Apply one frame of the motion in a file to the handles (see MotionFile): the frame at `time`, or
/// frame number Frame if `time` is null.
Status vtkPoseHandles::ReadMotion(
  ExecutionContext& context, const Handles& handles, const double* time, Pose& pose)
{
  const std::string path = this->FileName;
  HandleMotion motion;
  Status status = this->Internal->motion.fit(context, path, handles, motion);
  if (!status.ok())
  {
    return status;
  }
  if (this->Internal->warned_source == path)
  {
    status.warnings.clear();
  }
  else if (!status.warnings.empty())
  {
    this->Internal->warned_source = path;
  }
  this->NumberOfFrames = motion.frames;
  this->Sequence = motion.sequence;
  this->FramesPerSecond = motion.frames_per_second;
  const int frame =
    time ? frame_at(*time, this->NumberOfFrames, this->FramesPerSecond) : this->Frame;
  if (frame < 0 || frame >= this->NumberOfFrames)
  {
    return Status::invalid_input(path + ": frame " + std::to_string(frame) +
      " does not exist; the file has " + std::to_string(this->NumberOfFrames) +
      " frames, counted from 0");
  }
  const Pose base = pose;
  const Status posed = motion.pose(base, frame, pose);
  return posed.ok() ? status : posed;
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
