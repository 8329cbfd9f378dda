// Connects the kernel bindpose::ReducedArap to VTK. The bind stores projected matrices; a pose
// computes the transforms of the handles and blends them.
#include "vtkReducedARAP.h"

#include "arap/reduced_arap.h"
#include "arap_input.h"
#include "pose_input.h"

#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

using namespace bindpose;

vtkStandardNewMacro(vtkReducedARAP);

struct vtkReducedARAP::Internals
{
  ReducedArap arap;
};

vtkReducedARAP::vtkReducedARAP() : Internal(this->GetBlock()) {}

vtkReducedARAP::~vtkReducedARAP() = default;

Status vtkReducedARAP::Bind(ExecutionContext& context, const PoseInput& input)
{
  return bind_reduced(context, *this, this->Internal->arap, input);
}

Status vtkReducedARAP::Deform(ExecutionContext& context, const PoseInput& input, PosedPoints& posed)
{
  ReducedArap& arap = this->Internal->arap;
  Status status;
  {
    Phase phase(context, "solve", 0.8, 0.9);
    ReducedArap::SolveOptions options;
    options.tolerance = this->Tolerance;
    options.max_iterations = this->MaximumIterations;
    options.budget_microseconds = this->TimeBudget;
    options.anderson_window = this->AndersonWindow;
    options.mixed_precision = this->MixedPrecision;
    options.start = this->WarmStart ? ReducedArap::Start::last : ReducedArap::Start::guess;
    status = arap.solve(context, input.pose, options);
    if (!status.usable())
    {
      return status;
    }
  }
  Phase phase(context, "skin", 0.9, 1.0);
  const Status moved = arap.deform(context, input.points, posed.points);
  posed.transforms.assign(
    arap.transforms().begin(), arap.transforms().begin() + input.weights.cols());
  if (this->GetRotationArrays())
  {
    posed.groups = &arap.groups();
    posed.rotations = arap.rotations();
  }
  return moved.ok() ? status : moved;
}

Status vtkReducedARAP::DeformNormals(
  ExecutionContext& context, const PoseInput& input, const PosedPoints&, PosedPoints& normals)
{
  const SharedMatrix<Weights> rest = to_matrix(input.mesh->GetPointData()->GetNormals());
  const Eigen::Map<const Points> directions(rest.view().data(), rest.view().rows(), 3);
  return this->Internal->arap.deform_normals(context, directions, normals.points);
}

void vtkReducedARAP::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "TimeBudget: " << this->TimeBudget << "\n";
  os << indent << "AndersonWindow: " << this->AndersonWindow << "\n";
  os << indent << "WarmStart: " << (this->WarmStart ? "on" : "off") << "\n";
  os << indent << "MixedPrecision: " << (this->MixedPrecision ? "on" : "off") << "\n";
}
