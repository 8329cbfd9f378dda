// Glue around the kernel bindpose::ReducedArap: the bind keeps its projected matrices, a pose asks
// it for transforms and blends them.
#include "vtkReducedARAP.h"

#include "pose/reduced_arap.h"
#include "pose_input.h"

#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

using namespace bindpose;

vtkStandardNewMacro(vtkReducedARAP);

struct vtkReducedARAP::Internals
{
  ReducedArap arap;
};

namespace
{
bool has_volume_cells(vtkDataSet* mesh)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(mesh);
  for (vtkIdType c = 0; grid && c < grid->GetNumberOfCells(); ++c)
  {
    if (grid->GetCell(c)->GetCellDimension() == 3)
    {
      return true;
    }
  }
  return false;
}

const char* energy_name(int energy)
{
  switch (energy)
  {
    case vtkReducedARAP::SPOKES_AND_RIMS:
      return "spokes and rims";
    case vtkReducedARAP::TETRAHEDRA:
      return "tetrahedra";
    case vtkReducedARAP::TRIANGLES:
      return "triangles";
    default:
      return "auto";
  }
}
} // namespace

vtkReducedARAP::vtkReducedARAP() : Internal(new Internals) {}

vtkReducedARAP::~vtkReducedARAP() = default;

void vtkReducedARAP::SetEnergy(int energy)
{
  energy = std::clamp<int>(energy, AUTO, TRIANGLES);
  if (this->Energy != energy)
  {
    this->Energy = energy;
    this->BindModified();
  }
}

void vtkReducedARAP::SetNumberOfClusters(int clusters)
{
  clusters = std::max(clusters, 0);
  if (this->NumberOfClusters != clusters)
  {
    this->NumberOfClusters = clusters;
    this->BindModified();
  }
}

void vtkReducedARAP::SetNumberOfExtraWeights(int extra)
{
  extra = std::max(extra, 0);
  if (this->NumberOfExtraWeights != extra)
  {
    this->NumberOfExtraWeights = extra;
    this->BindModified();
  }
}

Status vtkReducedARAP::Bind(const PoseInput& input, ExecutionContext& context)
{
  ReducedArapOptions options;
  options.energy = this->Energy == SPOKES_AND_RIMS ? ArapEnergy::spokes_and_rims
    : this->Energy == AUTO                         ? ArapEnergy::automatic
                                                   : ArapEnergy::elements;
  options.clusters = this->NumberOfClusters;
  options.extra_weights = this->NumberOfExtraWeights;
  if (has_volume_cells(input.mesh))
  {
    TetInput tets;
    const Status status = to_tets(input.mesh, tets);
    if (!status.ok())
    {
      return status;
    }
    if (this->Energy == TRIANGLES)
    {
      return Status::invalid_input("the triangles energy needs a surface, but the mesh is tets");
    }
    return this->Internal->arap.bind(
      context, input.points, tets.tets.view(), input.weights, input.handles, options);
  }
  SurfaceInput surface;
  const Status status = to_surface(input.mesh, surface);
  if (!status.ok())
  {
    return status;
  }
  if (this->Energy == TETRAHEDRA)
  {
    return Status::invalid_input("the tetrahedra energy needs tets, but the mesh is a surface");
  }
  return this->Internal->arap.bind(
    context, input.points, surface.triangles.view(), input.weights, input.handles, options);
}

Status vtkReducedARAP::Deform(const PoseInput& input, ExecutionContext& context, PosedPoints& posed)
{
  ReducedArap& arap = this->Internal->arap;
  Status status;
  {
    Phase phase(context, "solve", 0.8, 0.9);
    ReducedArap::SolveOptions options;
    options.tolerance = this->Tolerance;
    options.max_iterations = this->MaximumIterations;
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
  return moved.ok() ? status : moved;
}

Status vtkReducedARAP::DeformNormals(
  const PoseInput& input, ExecutionContext& context, const PosedPoints&, PosedPoints& normals)
{
  const SharedMatrix<Weights> rest = to_matrix(input.mesh->GetPointData()->GetNormals());
  const Eigen::Map<const Points> directions(rest.view().data(), rest.view().rows(), 3);
  return this->Internal->arap.deform_normals(context, directions, normals.points);
}

void vtkReducedARAP::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Energy: " << energy_name(this->Energy) << "\n";
  os << indent << "NumberOfClusters: " << this->NumberOfClusters << "\n";
  os << indent << "NumberOfExtraWeights: " << this->NumberOfExtraWeights << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "WarmStart: " << (this->WarmStart ? "on" : "off") << "\n";
}
