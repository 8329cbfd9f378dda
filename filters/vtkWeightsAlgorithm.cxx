// Computes weights on a mesh. The kernels insert the handles into the mesh and solve. This filter
// converts the result to arrays, and interpolates the arrays of the input at the inserted points.
//
// The result of the bind is stored as VTK objects (weights, certificates, and points and cells if
// handles were inserted). As long as the bind is valid, the output gets the same objects, so that
// downstream filters see no change.
#include "vtkWeightsAlgorithm.h"

#include "base/execution.h"
#include "bind_key.h"
#include "conversion.h"
#include "handle_geometry.h"
#include "term_arrays.h"
#include "tets_data.h"
#include "weights/preview_weights.h"
#include "weights/surface_weights.h"
#include "weights_arrays.h"
#include "weights_input.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

using namespace bindpose;

namespace
{
constexpr char array_name[] = "Weights";
constexpr char raw_array_name[] = "RawWeights";
constexpr char mask_name[] = "WeightsMask";
constexpr char original_ids_name[] = "OriginalPointIds";

bool is_integral(vtkDataArray* array)
{
  return array && array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE;
}

/// Return a copy of a point array, extended by interpolated values at the inserted points.
vtkSmartPointer<vtkAbstractArray> extend_array(
  vtkAbstractArray* array, vtkIdType count, const std::vector<InsertedVertex>& inserted)
{
  vtkSmartPointer<vtkAbstractArray> result;
  result.TakeReference(array->NewInstance());
  result->DeepCopy(array);
  result->Resize(count + static_cast<vtkIdType>(inserted.size()));
  result->SetNumberOfTuples(count + static_cast<vtkIdType>(inserted.size()));
  auto* numbers = vtkDataArray::SafeDownCast(result);
  const bool labels = is_integral(numbers);
  const bool original_ids = labels && std::string(array->GetName()) == original_ids_name;
  vtkNew<vtkIdList> parents;
  for (std::size_t i = 0; i < inserted.size(); ++i)
  {
    const vtkIdType at = count + static_cast<vtkIdType>(i);
    parents->Reset();
    std::vector<double> coordinates;
    for (int k = 0; k < 4; ++k)
    {
      if (inserted[i].barycentric[k] > 1e-12)
      {
        parents->InsertNextId(inserted[i].parents[k]);
        coordinates.push_back(inserted[i].barycentric[k]);
      }
    }
    if (!labels)
    {
      result->InterpolateTuple(at, parents, array, coordinates.data());
      continue;
    }
    for (int c = 0; c < numbers->GetNumberOfComponents(); ++c)
    {
      const double first = numbers->GetComponent(parents->GetId(0), c);
      bool agree = !original_ids;
      for (vtkIdType k = 1; k < parents->GetNumberOfIds(); ++k)
      {
        agree = agree && numbers->GetComponent(parents->GetId(k), c) == first;
      }
      numbers->SetComponent(at, c, original_ids ? -1.0 : agree ? first : 0.0);
    }
  }
  return result;
}

/// Weights on a mesh, which may have additional points for handles.
struct SolvedMesh
{
  vtkSmartPointer<vtkDoubleArray> weights;
  // Weights before normalization (division of each row by its sum); null: not requested.
  vtkSmartPointer<vtkDoubleArray> raw;
  // Mask of the vertices that have weights; null: all vertices have weights.
  vtkSmartPointer<vtkUnsignedCharArray> mask;
  std::vector<vtkSmartPointer<vtkDoubleArray>> certificates;
  // The following members are null unless handles were inserted.
  vtkSmartPointer<vtkPoints> points;
  vtkSmartPointer<vtkCellArray> cells;
  vtkSmartPointer<vtkUnsignedCharArray> types; // cell types of an unstructured grid
  std::vector<InsertedVertex> inserted;
  std::vector<Index> parent_cell;

  void set_weights(const Weights& normalized, const Weights* raw_weights, const Handles& handles,
    const WeightsResult& result);
  void set_mesh(const WeightsProblem& problem, const std::vector<Index>& cell_of_element);
  void write(vtkPointSet* mesh, vtkPointSet* output) const;

private:
  void refine(vtkPointSet* mesh, vtkPointSet* output) const;
};

void SolvedMesh::set_weights(const Weights& normalized, const Weights* raw_weights,
  const Handles& handles, const WeightsResult& result)
{
  this->weights = to_weights_array(array_name, normalized, handles);
  if (raw_weights)
  {
    this->raw = to_weights_array(raw_array_name, *raw_weights, handles);
  }
  this->certificates = to_certificate_arrays(array_name, result);
}

void SolvedMesh::set_mesh(const WeightsProblem& problem, const std::vector<Index>& cell_of_element)
{
  const std::vector<VertexRole>& roles = problem.constraints.roles;
  if (std::count(roles.begin(), roles.end(), VertexRole::unreferenced) > 0)
  {
    this->mask = vtkSmartPointer<vtkUnsignedCharArray>::New();
    this->mask->SetName(mask_name);
    for (const VertexRole role : roles)
    {
      this->mask->InsertNextValue(role != VertexRole::unreferenced);
    }
  }
  if (problem.mesh.inserted.empty())
  {
    return;
  }
  const Domain& refined = problem.mesh.domain;
  const Points positions = problem.frame.from_frame(refined.points);
  this->points = to_vtk_points(positions);
  this->cells = refined.is_volume() ? to_unstructured_grid(positions, refined.tets)->GetCells()
                                    : to_polydata(positions, refined.triangles)->GetPolys();
  this->types = vtkSmartPointer<vtkUnsignedCharArray>::New();
  this->types->SetNumberOfValues(this->cells->GetNumberOfCells());
  this->types->FillValue(refined.is_volume() ? VTK_TETRA : VTK_TRIANGLE);
  this->inserted = problem.mesh.inserted;
  this->parent_cell = problem.mesh.parent_element;
  if (!cell_of_element.empty())
  {
    for (Index& cell : this->parent_cell)
    {
      cell = cell_of_element[cell];
    }
  }
}

/// Write the mesh with weights. If handles were inserted, the mesh includes the inserted points.
void SolvedMesh::write(vtkPointSet* mesh, vtkPointSet* output) const
{
  if (this->points)
  {
    this->refine(mesh, output);
  }
  else
  {
    output->ShallowCopy(mesh);
  }
  output->GetPointData()->AddArray(this->weights);
  output->GetPointData()->RemoveArray(raw_array_name);
  if (this->raw)
  {
    output->GetPointData()->AddArray(this->raw);
  }
  output->GetPointData()->RemoveArray(mask_name);
  if (this->mask)
  {
    output->GetPointData()->AddArray(this->mask);
  }
  for (const auto& array : this->certificates)
  {
    output->GetFieldData()->AddArray(array);
  }
}

/// Write the refined mesh (the mesh with inserted points and split cells) to `output`. The arrays
/// of the original `mesh` are copied and extended to the new points and cells.
void SolvedMesh::refine(vtkPointSet* mesh, vtkPointSet* output) const
{
  output->Initialize();
  output->SetPoints(this->points);
  if (auto* polydata = vtkPolyData::SafeDownCast(output))
  {
    polydata->SetPolys(this->cells);
  }
  else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(output))
  {
    grid->SetCells(this->types, this->cells);
  }
  output->GetFieldData()->PassData(mesh->GetFieldData());
  vtkPointData* from = mesh->GetPointData();
  vtkPointData* to = output->GetPointData();
  for (int a = 0; a < from->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* array = from->GetAbstractArray(a);
    if (array->GetName() && std::string(array->GetName()) != array_name)
    {
      to->AddArray(extend_array(array, mesh->GetNumberOfPoints(), this->inserted));
    }
  }
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* active = from->GetAbstractAttribute(type);
    if (active && active->GetName())
    {
      to->SetActiveAttribute(active->GetName(), type);
    }
  }
  vtkCellData* cells_from = mesh->GetCellData();
  vtkCellData* cells_to = output->GetCellData();
  const auto count = static_cast<vtkIdType>(this->parent_cell.size());
  cells_to->CopyAllOn();
  cells_to->CopyAllocate(cells_from, count);
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    cells_to->CopyData(cells_from, this->parent_cell[cell], cell);
  }
}
} // namespace

struct vtkWeightsAlgorithm::Cache
{
  bool valid = false;
  BindKey key;
  Status status;
  SolvedMesh mesh;
  vtkSmartPointer<vtkPolyData> extrema;
  // The dataset of output 2; null if the weights were solved on the mesh itself.
  vtkSmartPointer<vtkUnstructuredGrid> volume;
};

vtkWeightsAlgorithm::vtkWeightsAlgorithm()
  : TermNames(new TermArrayNames), BindCache(this->GetBlock())
{
  this->SetNumberOfOutputPorts(3);
}

vtkWeightsAlgorithm::~vtkWeightsAlgorithm() = default;

void vtkWeightsAlgorithm::BindModified()
{
  this->BindTime.Modified();
  this->Modified();
}

void vtkWeightsAlgorithm::SetTolerance(double tolerance)
{
  this->SetBindParameter(this->Tolerance, tolerance);
}

void vtkWeightsAlgorithm::SetMaximumIterations(int iterations)
{
  this->SetBindParameter(this->MaximumIterations, iterations);
}

void vtkWeightsAlgorithm::SetRegionArrayName(const std::string& name)
{
  this->SetBindParameter(this->RegionArrayName, name);
}

void vtkWeightsAlgorithm::SetKeepRaw(bool keep)
{
  this->SetBindParameter(this->KeepRaw, keep);
}

void vtkWeightsAlgorithm::SetDomain(int domain)
{
  domain = std::clamp(domain, static_cast<int>(SURFACE), static_cast<int>(CAGE));
  this->SetBindParameter(this->Domain, domain);
}

void vtkWeightsAlgorithm::SetStage(int stage)
{
  stage = std::clamp(stage, static_cast<int>(CERTIFIED), static_cast<int>(PREVIEW));
  this->SetBindParameter(this->Stage, stage);
}

void vtkWeightsAlgorithm::SetEmbeddingResolution(vtkIdType resolution)
{
  this->SetBindParameter(this->EmbeddingResolution, resolution);
}

void vtkWeightsAlgorithm::SetKeepMesh(bool keep)
{
  this->SetBindParameter(this->KeepMesh, keep);
}

void vtkWeightsAlgorithm::SetRigidityArrayName(const std::string& name)
{
  this->SetBindParameter(this->TermNames->rigidity, name);
}

std::string vtkWeightsAlgorithm::GetRigidityArrayName()
{
  return this->TermNames->rigidity;
}

void vtkWeightsAlgorithm::SetRigidSetArrayName(const std::string& name)
{
  this->SetBindParameter(this->TermNames->rigid_sets, name);
}

std::string vtkWeightsAlgorithm::GetRigidSetArrayName()
{
  return this->TermNames->rigid_sets;
}

void vtkWeightsAlgorithm::SetLowerArrayName(const std::string& name)
{
  this->SetBindParameter(this->TermNames->lower, name);
}

std::string vtkWeightsAlgorithm::GetLowerArrayName()
{
  return this->TermNames->lower;
}

void vtkWeightsAlgorithm::SetUpperArrayName(const std::string& name)
{
  this->SetBindParameter(this->TermNames->upper, name);
}

std::string vtkWeightsAlgorithm::GetUpperArrayName()
{
  return this->TermNames->upper;
}

void vtkWeightsAlgorithm::SetPinnedArrayName(const std::string& name)
{
  this->SetBindParameter(this->TermNames->pinned, name);
}

std::string vtkWeightsAlgorithm::GetPinnedArrayName()
{
  return this->TermNames->pinned;
}

void vtkWeightsAlgorithm::SetMirrorArrayName(const std::string& name)
{
  this->SetBindParameter(this->TermNames->mirror, name);
}

std::string vtkWeightsAlgorithm::GetMirrorArrayName()
{
  return this->TermNames->mirror;
}

void vtkWeightsAlgorithm::SetBounds(double smallest, double largest)
{
  if (this->Bounds[0] != smallest || this->Bounds[1] != largest)
  {
    this->Bounds[0] = smallest;
    this->Bounds[1] = largest;
    this->BindModified();
  }
}

void vtkWeightsAlgorithm::SetMirrorNormal(double x, double y, double z)
{
  if (this->MirrorNormal[0] != x || this->MirrorNormal[1] != y || this->MirrorNormal[2] != z)
  {
    this->MirrorNormal[0] = x;
    this->MirrorNormal[1] = y;
    this->MirrorNormal[2] = z;
    this->BindModified();
  }
}

void vtkWeightsAlgorithm::SetMirrorOrigin(double x, double y, double z)
{
  if (this->MirrorOrigin[0] != x || this->MirrorOrigin[1] != y || this->MirrorOrigin[2] != z)
  {
    this->MirrorOrigin[0] = x;
    this->MirrorOrigin[1] = y;
    this->MirrorOrigin[2] = z;
    this->BindModified();
  }
}

void vtkWeightsAlgorithm::SetMaximumInfluences(int influences)
{
  this->SetBindParameter(this->MaximumInfluences, influences);
}

void vtkWeightsAlgorithm::SetPartitionOfUnity(int mode)
{
  mode = std::clamp(mode, int(NORMALIZE), int(COUPLED));
  this->SetBindParameter(this->PartitionOfUnity, mode);
}

int vtkWeightsAlgorithm::FillOutputPortInformation(int port, vtkInformation* info)
{
  constexpr const char* types[] = { "vtkPointSet", "vtkPolyData", "vtkUnstructuredGrid" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

Status vtkWeightsAlgorithm::Bind(
  ExecutionContext& context, vtkDataSet* mesh, vtkDataObject* handle_data, Cache& bound)
{
  Handles handles;
  bindpose::Domain domain;
  std::vector<Index> cell_of_element;
  std::vector<Index> handle_cells;
  Status status = to_handles(vtkPolyData::SafeDownCast(handle_data), handles, &handle_cells);
  if (status.ok())
  {
    status = to_domain(mesh, domain, cell_of_element);
  }
  std::vector<Index> region_ids;
  const bool regions = std::any_of(handles.begin(), handles.end(),
    [](const Handle& handle) { return handle.kind == HandleKind::region; });
  if (status.ok() && regions)
  {
    status = to_region_ids(mesh, this->RegionArrayName, region_ids);
  }
  if (!status.ok())
  {
    return status;
  }
  WeightsOptions options;
  if (this->TakesTerms() && this->Stage == CERTIFIED)
  {
    status = to_terms(mesh, *this->TermNames, static_cast<Index>(handles.size()), options.terms);
    if (!status.ok())
    {
      return status;
    }
    status = to_handle_bounds(
      vtkPolyData::SafeDownCast(handle_data), handle_cells, this->Bounds, options.terms);
    if (!status.ok())
    {
      return status;
    }
    options.terms.mirror_normal = Vec3(this->MirrorNormal);
    options.terms.mirror_origin = Vec3(this->MirrorOrigin);
    options.maximum_influences = this->MaximumInfluences;
    options.partition = static_cast<bindpose::PartitionOfUnity>(this->PartitionOfUnity);
  }
  options.tolerance = this->Tolerance;
  options.maximum_iterations = this->MaximumIterations;
  options.solver.memory_limit = this->MemoryLimit;
  options.insertion.keep_mesh = this->KeepMesh;
  const WeightsMethod method =
    [&](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& result)
  {
    return this->Stage == PREVIEW ? preview_weights(method_context, problem, options, result)
                                  : this->Solve(method_context, problem, options, result);
  };
  const auto send_preview = [&](const Weights& weights)
  { this->InvokeEvent(PreviewEvent, to_weights_array(array_name, weights, handles)); };
  // Compute no preview if there are rigid sets, because the preview ignores them. If only a rigid
  // set connects a component to handles, the component would be unconstrained, and the preview's
  // energy singular.
  const bool wants_preview =
    this->Stage == CERTIFIED && this->HasObserver(PreviewEvent) && options.terms.rigid_sets.empty();
  if (domain.is_volume() || this->Domain == SURFACE)
  {
    WeightsProblem problem;
    WeightsResult result;
    status = make_weights_problem(context, domain, region_ids, handles, options, problem);
    if (status.ok() && wants_preview)
    {
      status = preview_weights(context, problem, options, result);
      if (status.usable())
      {
        send_preview(result.weights.topRows(domain.points.rows()));
      }
    }
    if (status.usable())
    {
      status = method(context, problem, result);
    }
    if (status.usable())
    {
      if (!domain.is_volume())
      {
        status.report.set("domain", to_string(WeightsDomain::surface));
      }
      bound.mesh.set_weights(
        result.weights, this->KeepRaw ? &result.raw : nullptr, handles, result);
      bound.mesh.set_mesh(problem, cell_of_element);
      bound.extrema = to_extrema(problem, result);
    }
    return status;
  }
  HandleGeometry geometry;
  status = to_handle_geometry(vtkPolyData::SafeDownCast(handle_data), geometry);
  if (!status.ok())
  {
    return status;
  }
  SurfaceWeightsOptions surface;
  surface.domain = static_cast<WeightsDomain>(this->Domain);
  surface.resolution = this->EmbeddingResolution;
  surface.check_resolution = this->Stage == CERTIFIED;
  surface.keep_raw = this->KeepRaw;
  surface.handle_elements = to_handle_elements(geometry);
  if (wants_preview)
  {
    surface.preview = send_preview;
  }
  SurfaceWeights result;
  status = surface_weights(context, domain.points, domain.triangles, region_ids, handles, surface,
    options, method, result);
  if (status.usable())
  {
    bound.mesh.set_weights(
      result.weights, this->KeepRaw ? &result.raw : nullptr, handles, result.solved);
    bound.extrema = to_extrema(result.problem, result.solved);
    if (result.domain != WeightsDomain::surface)
    {
      SolvedMesh solved;
      solved.set_weights(result.solved.weights, this->KeepRaw ? &result.solved.raw : nullptr,
        handles, result.solved);
      solved.set_mesh(result.problem, {});
      bound.volume = vtkSmartPointer<vtkUnstructuredGrid>::New();
      solved.write(result.plane_cage.triangles.rows() > 0
          ? to_unstructured_grid(result.plane_cage.points, result.plane_cage.triangles)
          : to_unstructured_grid(result.tets, status.report.text("tetrahedralize.method")),
        bound.volume);
    }
  }
  return status;
}

Status vtkWeightsAlgorithm::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  vtkPointSet* mesh = vtkPointSet::GetData(input[0]);
  vtkPolyData* handles = vtkPolyData::GetData(input[1]);
  vtkPointSet* result = vtkPointSet::GetData(output);
  if (!mesh || !result)
  {
    return Status::invalid_input("the input mesh is missing");
  }
  if (!handles)
  {
    return Status::invalid_input("the input has no handles");
  }
  BindKey key;
  key.add(this->BindTime.GetMTime());
  std::vector<std::string> names = { this->RegionArrayName };
  if (this->TakesTerms())
  {
    const std::vector<std::string> terms = this->TermNames->all();
    names.insert(names.end(), terms.begin(), terms.end());
  }
  for (vtkObject* object : bind_objects(mesh, names))
  {
    key.add(object);
  }
  for (vtkObject* object : bind_objects(handles))
  {
    key.add(object);
  }
  key.add(this->TakesTerms() ? handles->GetCellData()->GetArray(handle_bounds_name) : nullptr);
  const bool bind = !this->BindCache->valid || this->BindCache->key != key;
  if (bind)
  {
    Cache new_cache;
    const Status status = this->Bind(context, mesh, handles, new_cache);
    if (!status.usable())
    {
      return status;
    }
    new_cache.status = status;
    // Store the seconds of the bind in the cached report, so that all reports contain them until
    // the next bind.
    new_cache.status.report.merge(context.seconds());
    new_cache.key = key;
    new_cache.valid = true;
    *this->BindCache = std::move(new_cache);
    this->NumberOfBinds += 1;
  }
  this->BindCache->mesh.write(mesh, result);
  vtkDataObject::GetData(output, 1)->ShallowCopy(this->BindCache->extrema);
  vtkDataObject* volume = vtkDataObject::GetData(output, 2);
  volume->Initialize();
  if (this->BindCache->volume)
  {
    volume->ShallowCopy(this->BindCache->volume);
  }

  Status status = this->BindCache->status;
  status.report.set("binds", this->NumberOfBinds);
  if (!bind && !status.warnings.empty())
  {
    // Warnings are issued only by the update that computes the bind; the report keeps them.
    status.report.set("warnings[]", status.warnings);
    status.warnings.clear();
  }
  return status;
}

void vtkWeightsAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "RegionArrayName: " << this->RegionArrayName << "\n";
  os << indent << "Domain: " << to_string(static_cast<WeightsDomain>(this->Domain)) << "\n";
  os << indent << "Stage: " << (this->Stage == PREVIEW ? "preview" : "certified") << "\n";
  os << indent << "EmbeddingResolution: " << this->EmbeddingResolution << "\n";
  os << indent << "KeepMesh: " << (this->KeepMesh ? "on" : "off") << "\n";
  os << indent << "KeepRaw: " << (this->KeepRaw ? "on" : "off") << "\n";
  os << indent << "RigidityArrayName: " << this->TermNames->rigidity << "\n";
  os << indent << "RigidSetArrayName: " << this->TermNames->rigid_sets << "\n";
  os << indent << "LowerArrayName: " << this->TermNames->lower << "\n";
  os << indent << "UpperArrayName: " << this->TermNames->upper << "\n";
  os << indent << "PinnedArrayName: " << this->TermNames->pinned << "\n";
  os << indent << "MirrorArrayName: " << this->TermNames->mirror << "\n";
  os << indent << "Bounds: " << this->Bounds[0] << ", " << this->Bounds[1] << "\n";
  os << indent << "MirrorNormal: " << this->MirrorNormal[0] << ", " << this->MirrorNormal[1] << ", "
     << this->MirrorNormal[2] << "\n";
  os << indent << "MirrorOrigin: " << this->MirrorOrigin[0] << ", " << this->MirrorOrigin[1] << ", "
     << this->MirrorOrigin[2] << "\n";
  os << indent << "MaximumInfluences: " << this->MaximumInfluences << "\n";
  os << indent
     << "PartitionOfUnity: " << (this->PartitionOfUnity == COUPLED ? "coupled" : "normalize")
     << "\n";
  os << indent << "NumberOfBinds: " << this->NumberOfBinds << "\n";
}
