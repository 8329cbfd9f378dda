// Connects the kernel bindpose::FullArap to VTK. The bind stores everything that does not depend on
// the pose. The kernel caches the factorization until a mode changes.
#include "vtkFullARAP.h"

#include "arap/full_arap.h"
#include "arap_input.h"
#include "pose_input.h"
#include "weights_input.h"

#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <algorithm>

using namespace bindpose;

vtkStandardNewMacro(vtkFullARAP);

struct vtkFullARAP::Internals
{
  FullArap arap;
};

vtkFullARAP::vtkFullARAP() : Internal(this->GetBlock()) {}

vtkFullARAP::~vtkFullARAP() = default;

void vtkFullARAP::SetRegionArrayName(const std::string& name)
{
  this->SetBindParameter(this->RegionArrayName, name);
}

std::vector<std::string> vtkFullARAP::BindArrays()
{
  return { this->RegionArrayName };
}

Status vtkFullARAP::Bind(ExecutionContext& context, const PoseInput& input)
{
  FullArapOptions options;
  ArapElements elements;
  Status status = to_arap(input.mesh, this->GetEnergy(), elements, options.energy);
  const bool regions = std::any_of(input.handles.begin(), input.handles.end(),
    [](const Handle& handle) { return handle.kind == HandleKind::region; });
  if (status.ok() && regions)
  {
    status = to_region_ids(input.mesh, this->RegionArrayName, options.region_ids);
  }
  if (!status.ok())
  {
    return status;
  }
  FullArap& arap = this->Internal->arap;
  return elements.volume
    ? arap.bind(context, input.points, elements.tets.tets.view(), input.handles, options)
    : arap.bind(context, input.points, elements.surface.triangles.view(), input.handles, options);
}

Status vtkFullARAP::Deform(ExecutionContext& context, const PoseInput& input, PosedPoints& posed)
{
  Phase phase(context, "solve", 0.8, 1.0);
  FullArap::SolveOptions options;
  options.tolerance = this->Tolerance;
  options.max_iterations = this->MaximumIterations;
  options.start = this->WarmStart ? FullArap::Start::last : FullArap::Start::guess;
  options.anderson_window = this->AndersonWindow;
  FullArap& arap = this->Internal->arap;
  const Status status = arap.solve(context, input.pose, options);
  if (!status.usable())
  {
    return status;
  }
  posed.points = arap.posed();
  if (this->GetRotationArrays())
  {
    posed.groups = &arap.groups();
    posed.rotations = arap.rotations();
  }
  return status;
}

void vtkFullARAP::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RegionArrayName: " << this->RegionArrayName << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "AndersonWindow: " << this->AndersonWindow << "\n";
  os << indent << "WarmStart: " << (this->WarmStart ? "on" : "off") << "\n";
}
