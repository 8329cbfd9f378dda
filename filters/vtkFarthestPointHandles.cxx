// Connects weights/farthest_points.h to VTK: chosen vertices become point handles p1, p2, …
#include "vtkFarthestPointHandles.h"

#include "base/execution.h"
#include "conversion.h"
#include "handles/farthest_points.h"
#include "outer_surface.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkFarthestPointHandles);

int vtkFarthestPointHandles::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

int vtkFarthestPointHandles::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

bindpose::Status vtkFarthestPointHandles::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  bindpose::Phase phase(context, "choose");
  bindpose::SurfaceInput surface;
  bindpose::Status status = bindpose::to_outer_surface(vtkDataSet::GetData(input[0]), surface);
  std::vector<bindpose::Index> chosen;
  if (status.ok())
  {
    status = bindpose::farthest_points(
      context, surface.points.view(), surface.triangles.view(), this->NumberOfHandles, chosen);
  }
  if (!status.ok())
  {
    return status;
  }
  bindpose::Handles handles(chosen.size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < chosen.size(); ++i)
  {
    handles[i].head = handles[i].tail = surface.points.view().row(chosen[i]).transpose();
    handles[i].name = "p" + std::to_string(i + 1);
    names.push_back(handles[i].name);
  }
  status = check_handles(handles);
  if (!status.ok())
  {
    return status;
  }
  vtkDataObject::GetData(output)->ShallowCopy(bindpose::to_polydata(handles));
  status.report.set("counts.vertices", surface.points.view().rows());
  status.report.set("counts.handles", static_cast<int>(handles.size()));
  status.report.set("handles[].name", names);
  status.report.set("handles[].kind", std::vector<std::string>(handles.size(), "point"));
  status.report.set("handles[].vertex", chosen);
  return status;
}

void vtkFarthestPointHandles::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfHandles: " << this->NumberOfHandles << "\n";
}
