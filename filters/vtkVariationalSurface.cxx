// Connects the kernel bindpose::VariationalSurface to VTK. Point arrays of the mesh are converted
// to options of the kernel.
#include "vtkVariationalSurface.h"

#include "fairing/variational_surface.h"
#include "pose_input.h"
#include "weights_input.h"

#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>

using namespace bindpose;

vtkStandardNewMacro(vtkVariationalSurface);

struct vtkVariationalSurface::Internals
{
  VariationalSurface surface;
};

namespace
{
/// Copy a point array with `minimum_components` to 3 components to `rows`, #V x 3. A missing third
/// component becomes 0. If there is no array of that name, `rows` is not changed.
Status to_rows(vtkPointSet* mesh, const std::string& name, int minimum_components, Points& rows)
{
  vtkAbstractArray* found = mesh->GetPointData()->GetAbstractArray(name.c_str());
  if (!found)
  {
    return {};
  }
  auto* array = vtkDataArray::SafeDownCast(found);
  if (!array || array->GetNumberOfComponents() < minimum_components ||
    array->GetNumberOfComponents() > 3)
  {
    return Status::invalid_input("the point array '" + name + "' must have " +
      (minimum_components == 2 ? "2 or " : "") + "3 components");
  }
  const SharedMatrix<Weights> values = to_matrix(array);
  rows = Points::Zero(values.view().rows(), 3);
  rows.leftCols(values.view().cols()) = values.view();
  return {};
}

Status to_flags(vtkPointSet* mesh, const std::string& name, std::vector<char>& flags)
{
  vtkAbstractArray* found = mesh->GetPointData()->GetAbstractArray(name.c_str());
  if (!found)
  {
    return {};
  }
  auto* array = vtkDataArray::SafeDownCast(found);
  if (!array || array->GetNumberOfComponents() != 1)
  {
    return Status::invalid_input(
      "the point array '" + name + "' of fixed points must have one component");
  }
  for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
  {
    flags.push_back(array->GetComponent(v, 0) != 0.0);
  }
  return {};
}
} // namespace

vtkVariationalSurface::vtkVariationalSurface() : Internal(this->GetBlock()) {}

vtkVariationalSurface::~vtkVariationalSurface() = default;

void vtkVariationalSurface::SetOrder(int order)
{
  this->SetBindParameter(this->Order, std::clamp(order, 1, 3));
}

void vtkVariationalSurface::SetBoundary(int boundary)
{
  this->SetBindParameter(this->Boundary, std::clamp<int>(boundary, REGION, TANGENT));
}

void vtkVariationalSurface::SetTangentSource(int source)
{
  this->SetBindParameter(this->TangentSource, std::clamp<int>(source, SURROUNDINGS, CLAMPED));
}

void vtkVariationalSurface::SetFair(bool fair)
{
  this->SetBindParameter(this->Fair, fair);
}

void vtkVariationalSurface::SetRegionArrayName(const std::string& name)
{
  this->SetBindParameter(this->RegionArrayName, name);
}

void vtkVariationalSurface::SetFixedArrayName(const std::string& name)
{
  this->SetBindParameter(this->FixedArrayName, name);
}

void vtkVariationalSurface::SetParameterArrayName(const std::string& name)
{
  this->SetBindParameter(this->ParameterArrayName, name);
}

void vtkVariationalSurface::SetTangentArrayName(const std::string& name)
{
  this->SetBindParameter(this->TangentArrayName, name);
}

void vtkVariationalSurface::SetLoadArrayName(const std::string& name)
{
  this->SetBindParameter(this->LoadArrayName, name);
}

int vtkVariationalSurface::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

std::vector<std::string> vtkVariationalSurface::BindArrays()
{
  return { this->RegionArrayName, this->FixedArrayName, this->ParameterArrayName,
    this->TangentArrayName, this->LoadArrayName };
}

Status vtkVariationalSurface::Bind(ExecutionContext& context, const PoseInput& input)
{
  VariationalSurfaceOptions options;
  options.order = this->Order;
  options.boundary = static_cast<PatchBoundary>(this->Boundary);
  options.tangent_source = static_cast<PatchTangents>(this->TangentSource);
  options.fair = this->Fair;
  SurfaceInput surface;
  Status status = to_surface(input.mesh, surface);
  const bool regions = std::any_of(input.handles.begin(), input.handles.end(),
    [](const Handle& handle) { return handle.kind == HandleKind::region; });
  if (status.ok() && regions)
  {
    status = to_region_ids(input.mesh, this->RegionArrayName, options.region_ids);
  }
  if (status.ok())
  {
    status = to_flags(input.mesh, this->FixedArrayName, options.fixed);
  }
  if (status.ok())
  {
    status = to_rows(input.mesh, this->ParameterArrayName, 2, options.parameters);
  }
  if (status.ok() && options.boundary == PatchBoundary::tangent &&
    options.tangent_source == PatchTangents::prescribed)
  {
    status = to_rows(input.mesh, this->TangentArrayName, 3, options.tangents);
    if (status.ok() && options.tangents.rows() == 0)
    {
      status = Status::invalid_input(
        "the mesh has no point array '" + this->TangentArrayName + "' of tangents");
    }
  }
  if (status.ok())
  {
    status = to_rows(input.mesh, this->LoadArrayName, 3, options.load);
  }
  return status.ok() ? this->Internal->surface.bind(
                         context, input.points, surface.triangles.view(), input.handles, options)
                     : status;
}

Status vtkVariationalSurface::Deform(
  ExecutionContext& context, const PoseInput& input, PosedPoints& posed)
{
  const Status status = this->Internal->surface.solve(context, input.pose);
  if (status.usable())
  {
    posed.points = this->Internal->surface.posed();
  }
  return status;
}

void vtkVariationalSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  const char* const boundaries[] = { "region", "curve", "tangent" };
  const char* const sources[] = { "surroundings", "given", "clamped" };
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "Boundary: " << boundaries[this->Boundary] << "\n";
  os << indent << "TangentSource: " << sources[this->TangentSource] << "\n";
  os << indent << "Fair: " << (this->Fair ? "on" : "off") << "\n";
  os << indent << "RegionArrayName: " << this->RegionArrayName << "\n";
  os << indent << "FixedArrayName: " << this->FixedArrayName << "\n";
  os << indent << "ParameterArrayName: " << this->ParameterArrayName << "\n";
  os << indent << "TangentArrayName: " << this->TangentArrayName << "\n";
  os << indent << "LoadArrayName: " << this->LoadArrayName << "\n";
}
