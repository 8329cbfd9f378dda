// Connects the kernel of gltf_edit/gltf_asset.h to VTK. asset_file.h reads the file; gltf_data.h
// converts joints to handles.
#include "vtkAssetReader.h"

#include "asset_file.h"
#include "base/execution.h"
#include "conversion.h"
#include "gltf_edit/gltf_asset.h"
#include "gltf_data.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

using namespace bindpose;

vtkStandardNewMacro(vtkAssetReader);

const char* vtkAssetReader::GetFileExtensions()
{
  return asset_extensions();
}

vtkAssetReader::vtkAssetReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
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
  GltfAsset asset;
  Status status = read_asset_file(context, path, asset);
  if (!status.ok())
  {
    return status;
  }
  status.report.set("counts.joints", asset.joints().size());
  if (!asset.joints().empty())
  {
    JointHandles joints;
    const Status usable = joints.make(asset.points(), asset.joints(), asset.largest_weights());
    if (!usable.ok())
    {
      return Status::invalid_input(path + ": " + usable.message);
    }
    vtkPolyData::GetData(output, 1)->ShallowCopy(joints.posed_handles());
  }
  vtkPolyData::GetData(output, 0)->ShallowCopy(
    to_polydata(PointsView(asset.points()), TrianglesView(asset.triangles())));
  return status;
}

void vtkAssetReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
