// The kernel reads the file; gltf_data makes handles of its joints.
#include "vtkGLTFSkinReader.h"

#include "base/execution.h"
#include "file_kind.h"
#include "gltf_data.h"
#include "pose/pose_file.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

using namespace bindpose;

vtkStandardNewMacro(vtkGLTFSkinReader);

vtkGLTFSkinReader::vtkGLTFSkinReader()
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

Status vtkGLTFSkinReader::Execute(
  vtkInformationVector**, vtkInformationVector* output, ExecutionContext& context)
{
  const Phase phase(context, "read");
  const std::string path = this->FileName ? this->FileName : "";
  this->NumberOfFrames = 0;
  this->FramesPerSecond = 0.0;
  this->PoseJSON.clear();
  GltfData data;
  Status status = check_extension(path, GetFileExtensions());
  if (status.ok())
  {
    status = read_gltf(path, data);
  }
  if (!status.ok())
  {
    return status;
  }
  const auto frames = static_cast<int>(data.poses.size());
  if (this->Frame < -1 || this->Frame >= frames)
  {
    return Status::invalid_input(path + ": there is no frame " + std::to_string(this->Frame) +
      ", only " + std::to_string(frames) + " (counted from 0)");
  }
  if (frames > 0)
  {
    const Status formatted =
      format_pose_file(data.poses, data.frames_per_second, data.handle_list, this->PoseJSON);
    status.warnings.insert(
      status.warnings.end(), formatted.warnings.begin(), formatted.warnings.end());
    if (!formatted.ok())
    {
      status.warnings.push_back("its animation is no pose file: " + formatted.message);
    }
  }
  if (this->Frame >= 0)
  {
    std::vector<Index> cells(data.handle_list.size());
    for (std::size_t h = 0; h < cells.size(); ++h)
    {
      cells[h] = static_cast<Index>(h);
    }
    set_pose(data.handles, cells, data.poses[this->Frame]);
  }
  this->NumberOfFrames = frames;
  this->FramesPerSecond = frames > 0 ? data.frames_per_second : 0.0;
  vtkPolyData::GetData(output, 0)->ShallowCopy(data.mesh);
  vtkPolyData::GetData(output, 1)->ShallowCopy(data.handles);
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
