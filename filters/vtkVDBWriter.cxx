// Connects the kernel bindpose::write_vdb() to VTK. The kernel writes the file. This filter
// converts the image to a grid of samples and the array to floats or doubles.
#include "vtkVDBWriter.h"

#include "base/execution.h"
#include "file_kind.h"
#include "io/vdb.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

vtkStandardNewMacro(vtkVDBWriter);

namespace
{
using bindpose::Status;

/// Return the array to write. Return null, with the reason in the status, if no array is suitable.
vtkDataArray* find_array(vtkImageData* image, const char* name, Status& status)
{
  vtkPointData* arrays = image->GetPointData();
  const bool has_name = name && name[0];
  vtkDataArray* array = has_name ? arrays->GetArray(name) : arrays->GetScalars();
  if (!array)
  {
    status = Status::invalid_input(has_name
        ? "the volume has no point array '" + std::string(name) + "' of numeric type"
        : "the volume has no active scalars; select a point array");
    return nullptr;
  }
  if (array->GetNumberOfComponents() != 1)
  {
    status = Status::invalid_input("the array '" +
      std::string(array->GetName() ? array->GetName() : "") + "' has " +
      std::to_string(array->GetNumberOfComponents()) + " components; a float grid needs 1");
    return nullptr;
  }
  return array;
}

std::string name_of_grid(const char* requested_name, vtkDataArray* array)
{
  if (requested_name && requested_name[0])
  {
    return requested_name;
  }
  const std::string name = array->GetName() ? array->GetName() : "";
  // Return the default name of the grid; OpenVDB names are in lower case: "density",
  // "winding_number".
  return name.empty() || name == "WindingNumber" ? bindpose::VdbOptions().grid_name : name;
}

bindpose::SampleGrid grid_of(vtkImageData* image)
{
  bindpose::SampleGrid grid;
  grid.origin = bindpose::Vec3(image->GetOrigin());
  grid.spacing = bindpose::Vec3(image->GetSpacing());
  std::copy_n(image->GetExtent(), 6, grid.extent.begin());
  return grid;
}
} // namespace

vtkVDBWriter::vtkVDBWriter()
{
  this->SetNumberOfOutputPorts(0);
}

vtkVDBWriter::~vtkVDBWriter()
{
  this->SetFileName(nullptr);
  this->SetArrayName(nullptr);
  this->SetGridName(nullptr);
}

int vtkVDBWriter::Write()
{
  this->Modified();
  this->UpdateWholeExtent();
  return this->GetStatus() <= NOT_CONVERGED ? 1 : 0;
}

int vtkVDBWriter::FillInputPortInformation(int, vtkInformation* info)
{
  // Accept any dataset, so that Execute(), not the executive, rejects an input that is not an
  // image.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  AcceptBlocks(info);
  return 1;
}

bindpose::Status vtkVDBWriter::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector** input, vtkInformationVector*)
{
  const std::string path = this->FileName ? this->FileName : "";
  Status status = bindpose::check_extension(path, GetFileExtensions());
  vtkDataSet* data = vtkDataSet::GetData(input[0]);
  auto* image = vtkImageData::SafeDownCast(data);
  if (status.ok() && (!data || data->GetNumberOfPoints() == 0))
  {
    status = Status::invalid_input("the input is empty: nothing to write to " + path);
  }
  if (status.ok() && !image)
  {
    status = Status::invalid_input(
      "a .vdb file can only store volumes (vtkImageData), but the data is a " +
      std::string(data->GetClassName()));
  }
  vtkDataArray* array = status.ok() ? find_array(image, this->ArrayName, status) : nullptr;
  if (!array)
  {
    return status;
  }

  bindpose::VdbOptions options;
  options.grid_name = name_of_grid(this->GridName, array);
  vtkMatrix3x3* direction = image->GetDirectionMatrix();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      options.direction(row, column) = direction->GetElement(row, column);
    }
  }
  options.background = this->Background;
  options.band = this->Band == NARROW ? bindpose::VdbBand::narrow : bindpose::VdbBand::full;
  options.band_width = this->BandWidth;
  options.threshold = this->Threshold;
  options.overwrite = this->Overwrite;

  if (auto* floats = vtkFloatArray::SafeDownCast(array))
  {
    return bindpose::write_vdb(context, path, grid_of(image), floats->GetPointer(0), options);
  }
  vtkNew<vtkDoubleArray> copy;
  auto* doubles = vtkDoubleArray::SafeDownCast(array);
  if (!doubles)
  {
    copy->DeepCopy(array);
    doubles = copy;
  }
  return bindpose::write_vdb(context, path, grid_of(image), doubles->GetPointer(0), options);
}

void vtkVDBWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Overwrite: " << (this->Overwrite ? "on" : "off") << "\n";
  os << indent << "ArrayName: " << (this->ArrayName ? this->ArrayName : "(none)") << "\n";
  os << indent << "GridName: " << (this->GridName ? this->GridName : "(none)") << "\n";
  os << indent << "Background: " << this->Background << "\n";
  os << indent << "Band: " << (this->Band == NARROW ? "NARROW" : "FULL") << "\n";
  os << indent << "BandWidth: " << this->BandWidth << "\n";
  os << indent << "Threshold: " << this->Threshold << "\n";
}
