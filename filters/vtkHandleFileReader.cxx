// Reads handles from files. handle_tgf.h converts .tgf graphs. vtkMeshFileReader reads .vtp files;
// this file adds their missing arrays. gltf_data.h converts the joints of a glTF file.
#include "vtkHandleFileReader.h"

#include "base/execution.h"
#include "conversion.h"
#include "file_kind.h"
#include "gltf_data.h"
#include "handle_tgf.h"
#include "io/tgf.h"
#include "report_field_data.h"
#include "vtkMeshFileReader.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkHandleFileReader);

namespace
{
using bindpose::Handle;
using bindpose::Handles;
using bindpose::Index;
using bindpose::Status;

/// Insert the path at the beginning of the message and of the warnings.
Status with_path(const std::string& path, Status status)
{
  if (!status.ok())
  {
    status.message = path + ": " + status.message;
  }
  for (std::string& warning : status.warnings)
  {
    warning = path + ": " + warning;
  }
  return status;
}

Status read_tgf(const std::string& path, vtkPolyData* output)
{
  bindpose::Tgf graph;
  const Status status = bindpose::read_tgf(path, graph);
  return status.ok() ? with_path(path, bindpose::from_tgf(graph, output)) : status;
}

Status read_vtp(const std::string& path, vtkPolyData* output)
{
  vtkNew<vtkMeshFileReader> reader;
  // Do not print the reader's errors, because this filter's status contains the error message.
  vtkNew<vtkCallbackCommand> silent;
  reader->AddObserver(vtkCommand::ErrorEvent, silent);
  reader->SetFileName(path.c_str());
  reader->Update();
  Status status = bindpose::upstream_failure(reader->GetOutput());
  if (!status.ok())
  {
    return status;
  }
  auto* data = vtkPolyData::SafeDownCast(reader->GetOutput());
  Handles handles;
  std::vector<Index> cells;
  bindpose::Pose pose;
  status = bindpose::to_handles(data, handles, &cells);
  if (status.ok())
  {
    status = bindpose::to_pose(data, handles, cells, pose);
  }
  if (!status.ok())
  {
    return with_path(path, status);
  }
  output->ShallowCopy(data);
  if (static_cast<Index>(handles.size()) == data->GetNumberOfCells())
  {
    // Every cell is a handle, so cell i is the same handle in the complete dataset and in the file.
    auto complete = bindpose::to_polydata(handles);
    for (int i = 0; i < complete->GetCellData()->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = complete->GetCellData()->GetAbstractArray(i);
      if (!output->GetCellData()->GetAbstractArray(array->GetName()))
      {
        output->GetCellData()->AddArray(array);
      }
    }
  }
  bindpose::set_pose(output, cells, pose);
  return status;
}

Status read_gltf_handles(
  bindpose::ExecutionContext& context, const std::string& path, vtkPolyData* output)
{
  bindpose::GltfData gltf;
  Status status = bindpose::read_gltf(context, path, gltf);
  status.warnings.clear(); // omit these warnings, because they are about the mesh
  status.report = {};
  if (status.ok() && gltf.handle_list.empty())
  {
    return Status::invalid_input(path + " has no skin and therefore no handles");
  }
  if (status.ok())
  {
    output->ShallowCopy(gltf.handles);
  }
  return status;
}
} // namespace

vtkHandleFileReader::vtkHandleFileReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkHandleFileReader::~vtkHandleFileReader()
{
  this->SetFileName(nullptr);
}

int vtkHandleFileReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

bindpose::Status vtkHandleFileReader::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector**, vtkInformationVector* output)
{
  bindpose::Phase phase(context, "read");
  const std::string path = this->FileName ? this->FileName : "";
  auto* data = vtkPolyData::GetData(output);
  Status status = bindpose::check_extension(path, GetFileExtensions());
  if (status.ok())
  {
    const std::string format = bindpose::file_extension(path);
    status = format == "tgf" ? read_tgf(path, data)
      : format == "vtp"      ? read_vtp(path, data)
                             : read_gltf_handles(context, path, data);
  }
  if (!status.ok())
  {
    return status;
  }
  Handles handles;
  bindpose::to_handles(data, handles);
  std::vector<std::string> names;
  std::vector<std::string> kinds;
  for (const Handle& handle : handles)
  {
    names.push_back(handle.name);
    kinds.emplace_back(to_string(handle.kind));
  }
  status.report.set("counts.handles", static_cast<int>(handles.size()));
  status.report.set("handles[].name", names);
  status.report.set("handles[].kind", kinds);
  return status;
}

void vtkHandleFileReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
