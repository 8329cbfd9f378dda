// The file name extension determines the writer. Each writer writes to the temporary file of an
// AtomicFile, which is renamed on success.
#include "vtkMeshFileWriter.h"

#include "base/execution.h"
#include "conversion.h"
#include "file_kind.h"
#include "io/atomic_file.h"
#include "io/dmat.h"
#include "io/medit.h"
#include "io/obj.h"
#include "io/off.h"
#include "io/ply.h"
#include "io/stl.h"
#include "xml_names.h"

#include "vtkAbstractArray.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkGenericDataObjectWriter.h"
#include "vtkImageData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

vtkStandardNewMacro(vtkMeshFileWriter);

namespace
{
using bindpose::Status;

template <typename Writer>
void choose_encoding(Writer* writer)
{
  if constexpr (std::is_base_of_v<vtkXMLWriter, Writer>)
  {
    // Raw appended data is used because base64 is a third larger. LZ4 compresses as fast as a disk
    // writes.
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToLZ4();
  }
  else
  {
    writer->SetFileTypeToBinary();
  }
}

template <typename Writer>
Status write_by_vtk(vtkDataSet* data, const std::string& path)
{
  vtkSmartPointer<vtkDataSet> written = data;
  if constexpr (std::is_base_of_v<vtkXMLWriter, Writer>)
  {
    Status status = bindpose::escape_names(data, written);
    if (!status.ok())
    {
      return status;
    }
  }
  vtkNew<Writer> writer;
  choose_encoding(writer.Get());
  // The status contains the error; the observer keeps VTK from printing it.
  vtkNew<vtkCallbackCommand> silent;
  writer->AddObserver(vtkCommand::ErrorEvent, silent);
  writer->SetInputDataObject(written);
  writer->SetFileName(path.c_str());
  if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    return Status::invalid_input(vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  }
  return {};
}

/// Keep polygons; convert other 2D cells (strips, cells of an unstructured grid) to triangles.
Status to_polygons(vtkDataSet* data, bindpose::PolygonMesh& mesh)
{
  auto* surface = vtkPolyData::SafeDownCast(data);
  if (surface && surface->GetNumberOfPolys() > 0 && surface->GetNumberOfStrips() == 0)
  {
    mesh.points = bindpose::to_points(data).view();
    auto iterator = vtk::TakeSmartPointer(surface->GetPolys()->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      iterator->GetCurrentCell(size, ids);
      mesh.corners.insert(mesh.corners.end(), ids, ids + size);
      mesh.end_polygon();
    }
    return {};
  }
  bindpose::SurfaceInput input;
  Status status = bindpose::to_surface(data, input);
  if (status.ok())
  {
    mesh = bindpose::to_polygons(input.points.view(), input.triangles.view());
  }
  return status;
}

Status write_medit(vtkDataSet* data, const std::string& path)
{
  bindpose::TetInput tets;
  if (bindpose::to_tets(data, tets).ok())
  {
    return bindpose::write_medit(
      path, tets.points.view(), bindpose::Triangles(0, 3), tets.tets.view());
  }
  bindpose::SurfaceInput input;
  Status status = bindpose::to_surface(data, input);
  return status.ok()
    ? bindpose::write_medit(path, input.points.view(), input.triangles.view(), bindpose::Tets(0, 4))
    : status;
}

Status write_dmat(vtkDataSet* data, const std::string& array_name, const std::string& path)
{
  vtkDataArray* array = data->GetPointData()->GetArray(array_name.c_str());
  if (!array)
  {
    return Status::invalid_input("the data has no point array '" + array_name + "'");
  }
  return bindpose::write_dmat(path, bindpose::to_matrix(array).view());
}

/// Return the number of bytes of a name in a legacy file, where other bytes than visible ASCII
/// characters are written as %XX.
std::size_t legacy_length(const char* name)
{
  std::size_t length = 0;
  for (const char* c = name; c && *c; ++c)
  {
    const bool is_kept = *c >= '!' && *c <= '~' && *c != '%' && *c != '"';
    length += is_kept ? 1 : 3;
  }
  return length;
}

/// VTK's reader of legacy files reads at most 255 bytes of a name.
Status check_legacy_names(vtkDataSet* data)
{
  constexpr std::size_t maximum_length = 255;
  for (vtkFieldData* fields : std::initializer_list<vtkFieldData*>{
         data->GetPointData(), data->GetCellData(), data->GetFieldData() })
  {
    for (int k = 0; k < fields->GetNumberOfArrays(); ++k)
    {
      vtkAbstractArray* array = fields->GetAbstractArray(k);
      std::size_t longest = legacy_length(array->GetName());
      for (int c = 0; array->HasAComponentName() && c < array->GetNumberOfComponents(); ++c)
      {
        longest = std::max(longest, legacy_length(array->GetComponentName(c)));
      }
      if (longest > maximum_length)
      {
        return Status::invalid_input("a name in array " + std::to_string(k) + " takes " +
          std::to_string(longest) + " bytes; a .vtk file can store names of at most 255 bytes");
      }
    }
  }
  return {};
}

Status require_class(
  vtkDataSet* data, const char* class_name, const std::string& format, const char* content_name)
{
  return data->IsA(class_name) ? Status()
                               : Status::invalid_input("a ." + format + " file can only store " +
                                   content_name + ", but the data is a " + data->GetClassName());
}

Status write(vtkDataSet* data, const std::string& format, const std::string& array_name,
  const std::string& path)
{
  Status status;
  if (format == "vtp")
  {
    status = require_class(data, "vtkPolyData", format, "surfaces and handles (vtkPolyData)");
    return status.ok() ? write_by_vtk<vtkXMLPolyDataWriter>(data, path) : status;
  }
  if (format == "vtu")
  {
    status = require_class(data, "vtkUnstructuredGrid", format, "tets (vtkUnstructuredGrid)");
    return status.ok() ? write_by_vtk<vtkXMLUnstructuredGridWriter>(data, path) : status;
  }
  if (format == "vti")
  {
    status = require_class(data, "vtkImageData", format, "volumes (vtkImageData)");
    return status.ok() ? write_by_vtk<vtkXMLImageDataWriter>(data, path) : status;
  }
  if (format == "vtk")
  {
    status = check_legacy_names(data);
    return status.ok() ? write_by_vtk<vtkGenericDataObjectWriter>(data, path) : status;
  }
  if (format == "mesh")
  {
    return write_medit(data, path);
  }
  if (format == "dmat")
  {
    return write_dmat(data, array_name, path);
  }
  bindpose::PolygonMesh mesh;
  status = to_polygons(data, mesh);
  if (!status.ok())
  {
    return status;
  }
  return format == "off" ? bindpose::write_off(path, mesh)
    : format == "obj"    ? bindpose::write_obj(path, mesh)
    : format == "stl"    ? bindpose::write_stl(path, mesh)
                         : bindpose::write_ply(path, mesh);
}
} // namespace

namespace
{
template <typename Number>
bool all_finite(const Number* coordinates, vtkIdType count)
{
  return std::all_of(
    coordinates, coordinates + count, [](Number coordinate) { return std::isfinite(coordinate); });
}

bool all_finite(vtkPoints* points)
{
  if (auto* doubles = vtkDoubleArray::SafeDownCast(points->GetData()))
  {
    return all_finite(doubles->GetPointer(0), doubles->GetNumberOfValues());
  }
  auto* floats = vtkFloatArray::SafeDownCast(points->GetData());
  return !floats || all_finite(floats->GetPointer(0), floats->GetNumberOfValues());
}

/// Check that the points of all cells are finite, so that no result with NaN or infinity replaces a
/// good file. Points that no cell uses are not checked, because the input may contain unused points
/// that are not finite.
Status check_points(vtkDataSet* data)
{
  auto* point_set = vtkPointSet::SafeDownCast(data);
  if (!point_set || all_finite(point_set->GetPoints()))
  {
    return {};
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, ids);
    for (const vtkIdType id : *ids)
    {
      double point[3];
      data->GetPoint(id, point);
      for (int axis = 0; axis < 3; ++axis)
      {
        if (!std::isfinite(point[axis]))
        {
          return Status::invalid_input(std::string("coordinate ") + "xyz"[axis] + " of point " +
            std::to_string(id) + " is not finite");
        }
      }
    }
  }
  return {};
}
} // namespace

vtkMeshFileWriter::vtkMeshFileWriter()
{
  this->SetNumberOfOutputPorts(0);
  this->SetArrayName("Weights");
}

vtkMeshFileWriter::~vtkMeshFileWriter()
{
  this->SetFileName(nullptr);
  this->SetArrayName(nullptr);
}

int vtkMeshFileWriter::Write()
{
  this->Modified();
  this->UpdateWholeExtent();
  return this->GetStatus() <= NOT_CONVERGED ? 1 : 0;
}

int vtkMeshFileWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  // If composites were not accepted, the executive would call this writer once per block, each time
  // with the same file name.
  AcceptBlocks(info);
  return 1;
}

bindpose::Status vtkMeshFileWriter::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector** input, vtkInformationVector*)
{
  bindpose::Phase phase(context, "write");
  const std::string path = this->FileName ? this->FileName : "";
  Status status = bindpose::check_extension(path, GetFileExtensions());
  vtkDataSet* data = vtkDataSet::GetData(input[0]);
  if (!status.ok())
  {
    return status;
  }
  if (!data || data->GetNumberOfPoints() == 0)
  {
    return Status::invalid_input("the input is empty: nothing to write to " + path);
  }
  status = check_points(data);
  if (!status.ok())
  {
    status.message = "cannot write " + path + ": " + status.message;
    return status;
  }
  bindpose::AtomicFile file;
  status = file.open(path, this->Overwrite);
  if (!status.ok())
  {
    return status;
  }
  status = write(
    data, bindpose::file_extension(path), this->ArrayName ? this->ArrayName : "", file.temporary());
  if (!status.ok())
  {
    // If the message contains the temporary file name, replace it, because users do not know it.
    const std::size_t at = status.message.find(file.temporary());
    status.message = at == std::string::npos
      ? "cannot write " + path + ": " + status.message
      : status.message.replace(at, file.temporary().size(), path);
    return status;
  }
  return context.canceled() ? Status::canceled() : file.commit();
}

void vtkMeshFileWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Overwrite: " << (this->Overwrite ? "on" : "off") << "\n";
  os << indent << "ArrayName: " << (this->ArrayName ? this->ArrayName : "(none)") << "\n";
}
