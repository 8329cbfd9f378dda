// Connects the kernel of gltf/gltf_asset.h to VTK.
#include "vtkAssetReader.h"

#include "base/execution.h"
#include "conversion.h"
#include "file_kind.h"
#include "gltf/gltf_asset.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

using namespace bindpose;

vtkStandardNewMacro(vtkAssetReader);

vtkAssetReader::vtkAssetReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkAssetReader::~vtkAssetReader()
{
  this->SetFileName(nullptr);
}

int vtkAssetReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

Status vtkAssetReader::Execute(
  ExecutionContext& context, vtkInformationVector**, vtkInformationVector* output)
{
  const Phase phase(context, "read");
  const std::string path = this->FileName ? this->FileName : "";
  Status status = check_extension(path, GetFileExtensions());
  GltfAsset asset;
  if (status.ok())
  {
    status = asset.read(path);
  }
  if (status.ok())
  {
    vtkPolyData::GetData(output)->ShallowCopy(
      to_polydata(PointsView(asset.points()), TrianglesView(asset.triangles())));
  }
  return status;
}

void vtkAssetReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
