// Connects the kernel of automatic/automatic_handles.h to VTK. This filter converts the surface to
// the kernel's types, and the resulting handles to cells.
#include "vtkAutomaticHandles.h"

#include "automatic/automatic_handles.h"
#include "base/execution.h"
#include "conversion.h"
#include "outer_surface.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkAutomaticHandles);

int vtkAutomaticHandles::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

int vtkAutomaticHandles::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

bindpose::Status vtkAutomaticHandles::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  bindpose::SurfaceInput surface;
  bindpose::Status status = bindpose::to_outer_surface(vtkDataSet::GetData(input[0]), surface);
  if (!status.ok())
  {
    return status;
  }
  bindpose::AutomaticHandlesOptions options;
  options.method = static_cast<bindpose::AutomaticMethod>(this->Method);
  options.skeleton.winding_threshold = this->WindingThreshold;
  options.skeleton.triangles = this->SkeletonTriangles;
  options.skeleton.time_limit = this->TimeLimit;
  options.skeleton.memory_limit = this->MemoryLimit;
  options.bones.tolerance = this->BoneTolerance;
  options.bones.longest_bone = this->LongestBone;
  options.bones.maximum_bones = this->MaximumBones;
  options.bones.prune = this->Prune;
  options.points.count = this->NumberOfPoints;
  options.points.distance = static_cast<bindpose::PointDistance>(this->Distance);
  options.points.inside = this->PlaceInside;
  options.points.winding_threshold = this->WindingThreshold;
  bindpose::Handles handles;
  status = bindpose::automatic_handles(
    context, surface.points.view(), surface.triangles.view(), options, handles);
  if (status.ok())
  {
    vtkDataObject::GetData(output)->ShallowCopy(bindpose::to_polydata(handles));
  }
  return status;
}

void vtkAutomaticHandles::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << to_string(static_cast<bindpose::AutomaticMethod>(this->Method))
     << "\n";
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
  os << indent << "Distance: " << to_string(static_cast<bindpose::PointDistance>(this->Distance))
     << "\n";
  os << indent << "PlaceInside: " << (this->PlaceInside ? "on" : "off") << "\n";
  os << indent << "MaximumBones: " << this->MaximumBones << "\n";
  os << indent << "BoneTolerance: " << this->BoneTolerance << "\n";
  os << indent << "LongestBone: " << this->LongestBone << "\n";
  os << indent << "Prune: " << this->Prune << "\n";
  os << indent << "SkeletonTriangles: " << this->SkeletonTriangles << "\n";
  os << indent << "WindingThreshold: " << this->WindingThreshold << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
}
