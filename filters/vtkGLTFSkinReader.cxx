// Connects the kernel of gltf/gltf_skin.h to VTK. The kernel reads the file; gltf_data.h converts
// its joints to handles.
#include "vtkGLTFSkinReader.h"

#include "base/execution.h"
#include "cached_file.h"
#include "file_kind.h"
#include "frame_times.h"
#include "gltf_data.h"
#include "pose/pose_file.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <numeric>

using namespace bindpose;

vtkStandardNewMacro(vtkGLTFSkinReader);

struct vtkGLTFSkinReader::Internals
{
  CachedFile<GltfData> file{ &read_gltf };
};

vtkGLTFSkinReader::vtkGLTFSkinReader() : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
}

vtkGLTFSkinReader::~vtkGLTFSkinReader()
{
  this->SetFileName(nullptr);
}

int vtkGLTFSkinReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

int vtkGLTFSkinReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  int frames = 0;
  // Ignore the status here; Execute() reports errors of the file.
  if (this->Frame < 0 && this->FileName &&
    check_extension(this->FileName, GetFileExtensions()).ok())
  {
    this->WithContext(
      [&](ExecutionContext& context)
      {
        const bool is_read = this->Internal->file.read(context, this->FileName).ok();
        frames = is_read ? static_cast<int>(this->Internal->file.data().poses.size()) : 0;
      });
  }
  for (int port = 0; port < 2; ++port)
  {
    set_frame_times(
      output->GetInformationObject(port), frames, this->Internal->file.data().frames_per_second);
  }
  return 1;
}

Status vtkGLTFSkinReader::Execute(
  ExecutionContext& context, vtkInformationVector**, vtkInformationVector* output)
{
  const Phase phase(context, "read");
  const std::string path = this->FileName ? this->FileName : "";
  this->NumberOfFrames = 0;
  this->FramesPerSecond = 0.0;
  this->PoseJSON.clear();
  Status status = check_extension(path, GetFileExtensions());
  if (status.ok())
  {
    status = this->Internal->file.read(context, path);
  }
  if (!status.ok())
  {
    return status;
  }
  const GltfData& data = this->Internal->file.data();
  const auto frames = static_cast<int>(data.poses.size());
  if (this->Frame < -1 || this->Frame >= frames)
  {
    return Status::invalid_input(path + ": frame " + std::to_string(this->Frame) +
      " does not exist; the file has " + std::to_string(frames) + " frames, counted from 0");
  }
  if (frames > 0)
  {
    const Status formatted =
      format_pose_file(data.poses, data.frames_per_second, data.handle_list, this->PoseJSON);
    status.warnings.insert(
      status.warnings.end(), formatted.warnings.begin(), formatted.warnings.end());
    if (!formatted.ok())
    {
      status.warnings.push_back(
        "the animation cannot be converted to a pose file: " + formatted.message);
    }
  }
  this->NumberOfFrames = frames;
  this->FramesPerSecond = frames > 0 ? data.frames_per_second : 0.0;
  auto* mesh = vtkPolyData::GetData(output, 0);
  auto* handles = vtkPolyData::GetData(output, 1);
  mesh->ShallowCopy(data.mesh);
  handles->ShallowCopy(data.handles);
  int frame = this->Frame;
  // If times are requested for both outputs, use the time of the handles (port 1), because the mesh
  // is the same at all times.
  for (int port = 0; port < 2; ++port)
  {
    double time = 0.0;
    if (requested_time(output->GetInformationObject(port), time))
    {
      frame = frame_at(time, frames, data.frames_per_second);
      vtkDataObject* result = port == 0 ? mesh : handles;
      result->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    }
  }
  if (frame >= 0)
  {
    std::vector<Index> cells(data.handle_list.size());
    std::iota(cells.begin(), cells.end(), Index(0));
    set_pose(handles, cells, data.poses[frame]);
  }
  std::vector<std::string> names;
  std::vector<std::string> kinds;
  for (const Handle& handle : data.handle_list)
  {
    names.push_back(handle.name);
    kinds.emplace_back(to_string(handle.kind));
  }
  if (!names.empty())
  {
    status.report.set("handles[].name", names);
    status.report.set("handles[].kind", kinds);
  }
  if (frames > 0)
  {
    status.report.set("frames_per_second", data.frames_per_second);
  }
  return status;
}

void vtkGLTFSkinReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Frame: " << this->Frame << "\n";
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
  os << indent << "PoseJSON: " << this->PoseJSON.size() << " bytes\n";
}
