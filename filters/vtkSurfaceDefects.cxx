// Connects two kernels to VTK: surface/surface_repair.h finds the defects of a surface, and
// surface/surface_defects.h lists them.
#include "vtkSurfaceDefects.h"

#include "base/execution.h"
#include "conversion.h"
#include "surface_defects_data.h"

#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkSurfaceDefects);

int vtkSurfaceDefects::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

int vtkSurfaceDefects::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

bindpose::Status vtkSurfaceDefects::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  bindpose::SurfaceInput surface;
  bindpose::Status status = bindpose::to_surface(vtkDataSet::GetData(input[0]), surface);
  if (!status.ok())
  {
    return status;
  }
  const bindpose::Phase phase(context, "diagnose");
  const bindpose::PointsView points = surface.points.view();
  const bindpose::TrianglesView triangles = surface.triangles.view();
  bindpose::RepairOptions options;
  options.orient = false;
  bindpose::RepairedSurface repaired;
  status = bindpose::repair_surface(context, points, triangles, options, repaired);
  if (!status.ok())
  {
    return status;
  }
  vtkDataObject::GetData(output)->ShallowCopy(bindpose::to_polydata(
    bindpose::list_defects(points, triangles, repaired), points, surface.cell_of_triangle));
  bindpose::add_to_report(repaired.found, status.report);
  status.report.set("closed", repaired.found.closed ? "yes" : "no");
  if (surface.triangulated_cells > 0)
  {
    status.report.set("counts.triangulated_cells", surface.triangulated_cells);
  }
  if (surface.ignored_cells > 0)
  {
    status.report.set("counts.ignored_cells", surface.ignored_cells);
  }
  return status;
}

void vtkSurfaceDefects::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
