// Connects the kernel bindpose::tetrahedralize to VTK: see inside/tetrahedralize.h.
#include "vtkTetrahedralizeSurface.h"

#include "conversion.h"
#include "handle_geometry.h"
#include "inside/tetrahedralize.h"
#include "surface_defects_data.h"
#include "tets_data.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

vtkStandardNewMacro(vtkTetrahedralizeSurface);

vtkTetrahedralizeSurface::vtkTetrahedralizeSurface()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

vtkTetrahedralizeSurface::~vtkTetrahedralizeSurface() = default;

int vtkTetrahedralizeSurface::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPointSet" : "vtkPolyData");
  if (port == 1)
  {
    info->Set(INPUT_IS_OPTIONAL(), 1);
    AcceptBlocks(info);
  }
  return 1;
}

int vtkTetrahedralizeSurface::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

namespace
{
/// Return the surface with two point arrays: the tet that contains each point, and the barycentric
/// coordinates of the point in this tet.
vtkSmartPointer<vtkPolyData> to_bound_surface(
  const bindpose::SurfaceInput& surface, const bindpose::PointBinding& binding)
{
  auto result = bindpose::to_polydata(surface.points.view(), surface.triangles.view());
  vtkNew<vtkIdTypeArray> tets;
  tets->SetName("TetIds");
  tets->SetNumberOfValues(static_cast<vtkIdType>(binding.tets.size()));
  std::copy(binding.tets.begin(), binding.tets.end(), tets->GetPointer(0));
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetName("BarycentricCoordinates");
  coordinates->SetNumberOfComponents(4);
  coordinates->SetNumberOfTuples(binding.coordinates.rows());
  for (bindpose::Index v = 0; v < binding.coordinates.rows(); ++v)
  {
    for (int k = 0; k < 4; ++k)
    {
      coordinates->SetValue(4 * v + k, binding.coordinates(v, k));
    }
  }
  result->GetPointData()->AddArray(tets);
  result->GetPointData()->AddArray(coordinates);
  return result;
}
} // namespace

bindpose::Status vtkTetrahedralizeSurface::Execute(
  bindpose::ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkUnstructuredGrid* out = vtkUnstructuredGrid::GetData(output);
  vtkPolyData* defects = vtkPolyData::GetData(output, 1);
  out->Initialize();
  vtkPolyData* bound = vtkPolyData::GetData(output, 2);
  defects->Initialize();
  bound->Initialize();
  bindpose::SurfaceInput surface;
  bindpose::Status status = bindpose::to_surface(vtkDataSet::GetData(input[0]), surface);
  if (!status.ok())
  {
    return status;
  }

  bindpose::HandleGeometry handles;
  if (vtkPolyData* handle_data = vtkPolyData::GetData(input[1]))
  {
    status = bindpose::to_handle_geometry(handle_data, handles);
    if (!status.ok())
    {
      return status;
    }
  }

  bindpose::TetrahedralizeOptions options;
  options.method = static_cast<bindpose::TetMethod>(this->Method);
  options.winding_threshold = this->WindingThreshold;
  options.segmentation = static_cast<bindpose::SegmentationMethod>(this->Segmentation);
  options.cut_smoothness = this->CutSmoothness;
  options.cut_sigma = this->CutSigma;
  options.resolution = this->Resolution;
  options.time_limit = this->TimeLimit;
  options.memory_limit = this->MemoryLimit;
  options.quality = this->Quality;
  options.bare = this->Bare;
  options.interior_edge = this->InteriorEdge;
  options.keep_outside = this->KeepOutside;
  options.wrap_alpha = this->WrapAlpha;
  options.wrap_offset = this->WrapOffset;
  options.ftetwild_epsilon = this->FtetwildEpsilon;
  options.handles = bindpose::to_handle_elements(handles);
  bindpose::TetrahedralizeResult result;
  status = bindpose::tetrahedralize(
    context, surface.points.view(), surface.triangles.view(), options, result);
  if (surface.triangulated_cells > 0)
  {
    status.report.set("counts.triangulated_cells", surface.triangulated_cells);
  }
  if (surface.ignored_cells > 0)
  {
    status.report.set("counts.ignored_cells", surface.ignored_cells);
  }
  if (!status.usable())
  {
    return status;
  }
  if (!result.handle_vertices.empty())
  {
    bindpose::report_handles(handles, result.handle_vertices, status.report);
  }

  out->ShallowCopy(bindpose::to_unstructured_grid(result, status.report.text("method")));
  if (result.inside_fractions.size() > 0)
  {
    bound->ShallowCopy(to_bound_surface(surface, result.binding));
  }
  defects->ShallowCopy(
    bindpose::to_polydata(result.defects, surface.points.view(), surface.cell_of_triangle));
  return status;
}

void vtkTetrahedralizeSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << to_string(static_cast<bindpose::TetMethod>(this->Method)) << "\n";
  os << indent << "WindingThreshold: " << this->WindingThreshold << "\n";
  os << indent
     << "Segmentation: " << to_string(static_cast<bindpose::SegmentationMethod>(this->Segmentation))
     << "\n";
  os << indent << "CutSmoothness: " << this->CutSmoothness << "\n";
  os << indent << "CutSigma: " << this->CutSigma << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "Quality: " << this->Quality << "\n";
  os << indent << "Bare: " << this->Bare << "\n";
  os << indent << "InteriorEdge: " << this->InteriorEdge << "\n";
  os << indent << "KeepOutside: " << (this->KeepOutside ? "on" : "off") << "\n";
  os << indent << "WrapAlpha: " << this->WrapAlpha << "\n";
  os << indent << "WrapOffset: " << this->WrapOffset << "\n";
  os << indent << "FtetwildEpsilon: " << this->FtetwildEpsilon << "\n";
}
