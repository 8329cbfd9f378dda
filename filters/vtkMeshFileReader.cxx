// The file name extension determines the reader. Bindpose's kernels read the formats that VTK does
// not support or reads with a loss (coordinates as floats, vertices duplicated where normals
// differ). VTK's readers read all other formats, in a separate process.
#include "vtkMeshFileReader.h"

#include "base/execution.h"
#include "conversion.h"
#include "file_kind.h"
#include "gltf_data.h"
#include "guarded_read.h"
#include "io/medit.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "io/text_scanner.h"
#include "output_type.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkMeshFileReader);

namespace
{
using bindpose::Index;
using bindpose::Status;

vtkSmartPointer<vtkPolyData> polygons_to_polydata(const bindpose::PolygonMesh& mesh)
{
  vtkNew<vtkCellArray> polygons;
  polygons->AllocateExact(mesh.polygon_count(), static_cast<vtkIdType>(mesh.corners.size()));
  for (Index f = 0; f < mesh.polygon_count(); ++f)
  {
    polygons->InsertNextCell(mesh.offsets[f + 1] - mesh.offsets[f],
      reinterpret_cast<const vtkIdType*>(mesh.corners.data() + mesh.offsets[f]));
  }
  vtkNew<vtkCellArray> lines;
  for (Index l = 0; l < mesh.line_count(); ++l)
  {
    lines->InsertNextCell(mesh.line_offsets[l + 1] - mesh.line_offsets[l],
      reinterpret_cast<const vtkIdType*>(mesh.line_corners.data() + mesh.line_offsets[l]));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(bindpose::to_vtk_points(mesh.points));
  data->SetPolys(polygons);
  if (mesh.line_count() > 0)
  {
    data->SetLines(lines);
  }
  return data;
}

using ReadPolygons = Status (*)(const std::string&, bindpose::PolygonMesh&);

Status read_polygons(const std::string& path, ReadPolygons read, vtkDataObject* output)
{
  bindpose::PolygonMesh mesh;
  Status status = read(path, mesh);
  if (!status.ok())
  {
    return status;
  }
  output->ShallowCopy(polygons_to_polydata(mesh));
  if (mesh.skipped > 0)
  {
    status.report.set("counts.skipped_cells", mesh.skipped);
  }
  return status;
}

Status read_medit(const std::string& path, vtkDataObject* output)
{
  bindpose::MeditMesh mesh;
  Status status = bindpose::read_medit(path, mesh);
  if (!status.ok())
  {
    return status;
  }
  if (vtkUnstructuredGrid::SafeDownCast(output))
  {
    output->ShallowCopy(bindpose::to_unstructured_grid(mesh.points, mesh.tets));
  }
  else
  {
    output->ShallowCopy(bindpose::to_polydata(mesh.points, mesh.triangles));
  }
  return status;
}

Status read_gltf_mesh(
  bindpose::ExecutionContext& context, const std::string& path, vtkDataObject* output)
{
  bindpose::GltfData gltf;
  Status status = bindpose::read_gltf(context, path, gltf);
  if (status.ok())
  {
    output->ShallowCopy(gltf.mesh);
  }
  return status;
}

Status read_by_vtk(
  bindpose::ExecutionContext& context, const std::string& path, vtkDataObject* output)
{
  vtkSmartPointer<vtkDataSet> data;
  Status status = bindpose::read_guarded(context, path, data);
  if (status.ok() && !output->IsA(data->GetClassName()))
  {
    status = Status::invalid_input(
      path + " contains a " + data->GetClassName() + ", which is not supported");
  }
  if (status.ok())
  {
    output->ShallowCopy(data);
  }
  return status;
}

Status check_ids(const std::string& path, vtkCellArray* cells, vtkIdType points)
{
  if (!cells)
  {
    return {};
  }
  auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    iterator->GetCurrentCell(size, ids);
    for (vtkIdType k = 0; k < size; ++k)
    {
      if (ids[k] < 0 || ids[k] >= points)
      {
        return Status::invalid_input(path + ": a cell references point " + std::to_string(ids[k]) +
          ", but there are " + std::to_string(points) + " points");
      }
    }
  }
  return {};
}

Status check_output(const std::string& path, vtkDataObject* output)
{
  auto* data = vtkDataSet::SafeDownCast(output);
  if (!data || data->GetNumberOfPoints() == 0)
  {
    return Status::invalid_input(path + " contains no points");
  }
  Status status;
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    for (vtkCellArray* cells :
      { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
    {
      status = status.ok() ? check_ids(path, cells, data->GetNumberOfPoints()) : status;
    }
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    status = check_ids(path, grid->GetCells(), data->GetNumberOfPoints());
  }
  status.report.set("counts.vertices", data->GetNumberOfPoints());
  status.report.set("counts.cells", data->GetNumberOfCells());
  return status;
}

/// Report whether a MEDIT file has tets. If so, the output is a grid, otherwise a polydata. MEDIT
/// keywords are on separate lines, so a text search is sufficient.
bool has_tets(const std::string& path)
{
  std::string text;
  return bindpose::read_file(path, text).ok() && text.find("Tetrahedra") != std::string::npos;
}

/// Return an empty output of the file's type. An invalid file gives a polydata with the error in
/// its report.
vtkSmartPointer<vtkDataObject> make_output(const std::string& path)
{
  const std::string extension = bindpose::file_extension(path);
  if (extension == "vtu" || (extension == "mesh" && has_tets(path)))
  {
    return vtkSmartPointer<vtkUnstructuredGrid>::New();
  }
  if (extension == "vti")
  {
    return vtkSmartPointer<vtkImageData>::New();
  }
  if (extension == "vtk")
  {
    const std::string name = bindpose::legacy_class(path);
    if (name == "vtkUnstructuredGrid")
    {
      return vtkSmartPointer<vtkUnstructuredGrid>::New();
    }
    if (name == "vtkImageData")
    {
      return vtkSmartPointer<vtkImageData>::New();
    }
    if (name == "vtkRectilinearGrid")
    {
      return vtkSmartPointer<vtkRectilinearGrid>::New();
    }
    if (name == "vtkStructuredGrid")
    {
      return vtkSmartPointer<vtkStructuredGrid>::New();
    }
  }
  return vtkSmartPointer<vtkPolyData>::New();
}
} // namespace

vtkMeshFileReader::vtkMeshFileReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkMeshFileReader::~vtkMeshFileReader()
{
  this->SetFileName(nullptr);
}

int vtkMeshFileReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataSet");
  return 1;
}

int vtkMeshFileReader::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  bindpose::match_output_type(make_output(this->FileName ? this->FileName : ""), output);
  return 1;
}

int vtkMeshFileReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* output)
{
  // Downstream filters request an image by extents, so they need the whole extent before the data.
  const std::string path = this->FileName ? this->FileName : "";
  bindpose::ImageHeader header;
  if (bindpose::file_extension(path) == "vti" && bindpose::read_image_header(path, header))
  {
    vtkInformation* to = output->GetInformationObject(0);
    to->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), header.extent.data(), 6);
    to->Set(vtkDataObject::ORIGIN(), header.origin.data(), 3);
    to->Set(vtkDataObject::SPACING(), header.spacing.data(), 3);
  }
  return 1;
}

bindpose::Status vtkMeshFileReader::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector**, vtkInformationVector* output)
{
  const std::string path = this->FileName ? this->FileName : "";
  vtkDataObject* data = vtkDataObject::GetData(output);
  bindpose::Phase phase(context, "read");
  Status status = bindpose::check_extension(path, GetFileExtensions());
  const std::string format = bindpose::file_extension(path);
  std::string text;
  if (status.ok())
  {
    // Read the file here, so that the error for a missing or unreadable file, a directory or an
    // empty file is the same for all formats.
    status = bindpose::read_file(path, text);
    text.clear();
  }
  if (!status.ok())
  {
    return status;
  }
  if (format == "off")
  {
    status = read_polygons(path, bindpose::read_off, data);
  }
  else if (format == "obj")
  {
    status = read_polygons(path, bindpose::read_obj, data);
  }
  else if (format == "ply")
  {
    status = read_polygons(path, bindpose::read_ply, data);
  }
  else if (format == "mesh")
  {
    status = read_medit(path, data);
  }
  else if (format == "stl")
  {
    status = read_polygons(path, bindpose::read_stl, data);
  }
  else if (format == "glb" || format == "gltf")
  {
    status = read_gltf_mesh(context, path, data);
  }
  else
  {
    status = read_by_vtk(context, path, data);
  }
  if (status.ok())
  {
    const Status read = status;
    status = check_output(path, data);
    status.warnings = read.warnings;
    status.report.merge(read.report);
    status.report.set("format", format);
  }
  return status;
}

void vtkMeshFileReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
