// Conversion, the bind cache and the output are the same for every way to pose; only what a bind
// keeps and how points are moved differ.
//
// The cache key holds the modification times of the arrays that a bind reads, never those of a
// dataset: editing `Transform` raises the handle dataset's time, and a filter upstream that runs
// again raises its output's, though neither changes what was bound.
#include "vtkPoseAlgorithm.h"

#include "base/execution.h"
#include "bind_key.h"
#include "pose_elements.h"
#include "pose_input.h"
#include "weights_input.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <optional>

using namespace bindpose;

struct vtkPoseAlgorithm::Cache
{
  bool valid = false;
  BindKey key;
  Handles handles;
  std::vector<Index> cells;
  SharedMatrix<Points> points;
  SharedMatrix<Weights> weights;
  std::optional<PoseElements> elements; // once they are asked for
  Status status; // of the bind: its report and warnings stand on every output
};

namespace
{
vtkSmartPointer<vtkDoubleArray> to_array(const std::vector<Affine>& transforms)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("HandleTransforms");
  array->SetNumberOfComponents(12);
  for (const Affine& transform : transforms)
  {
    array->InsertNextTuple(transform.data());
  }
  return array;
}

vtkSmartPointer<vtkDataArray> to_normals(const Points& normals, vtkDataArray* like)
{
  vtkSmartPointer<vtkDataArray> result;
  result.TakeReference(like->NewInstance());
  result->SetName(like->GetName());
  result->SetNumberOfComponents(3);
  result->SetNumberOfTuples(normals.rows());
  for (Index v = 0; v < normals.rows(); ++v)
  {
    result->SetTuple(v, normals.data() + 3 * v);
  }
  return result;
}
} // namespace

vtkPoseAlgorithm::vtkPoseAlgorithm() : Bound(new Cache)
{
  this->BindTime.Modified();
}

vtkPoseAlgorithm::~vtkPoseAlgorithm() = default;

void vtkPoseAlgorithm::SetArrayName(const std::string& name)
{
  this->SetBindParameter(this->ArrayName, name);
}

std::vector<std::string> vtkPoseAlgorithm::BindArrays()
{
  return std::vector<std::string>(this->NeedsWeights() ? 1 : 0, this->ArrayName);
}

void vtkPoseAlgorithm::BindModified()
{
  this->BindTime.Modified();
  this->Modified();
}

int vtkPoseAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  // The executive passes on what port 0 says of times; handles' times come before a mesh's.
  using SDDP = vtkStreamingDemandDrivenPipeline;
  vtkInformation* handles = input[1]->GetInformationObject(0);
  vtkInformation* info = output->GetInformationObject(0);
  if (handles && handles->Has(SDDP::TIME_RANGE()))
  {
    info->CopyEntry(handles, SDDP::TIME_RANGE());
    info->Remove(SDDP::TIME_STEPS());
    if (handles->Has(SDDP::TIME_STEPS()))
    {
      info->CopyEntry(handles, SDDP::TIME_STEPS());
    }
  }
  return 1;
}

Status vtkPoseAlgorithm::Execute(
  vtkInformationVector** input, vtkInformationVector* output, ExecutionContext& context)
{
  auto* mesh = vtkPointSet::GetData(input[0], 0);
  auto* handle_data = vtkPolyData::GetData(input[1], 0);
  auto* result = vtkPointSet::GetData(output, 0);
  if (!mesh || mesh->GetNumberOfPoints() == 0)
  {
    return Status::invalid_input("the mesh to pose is empty");
  }
  vtkDataArray* weights =
    this->NeedsWeights() ? mesh->GetPointData()->GetArray(this->ArrayName.c_str()) : nullptr;
  if (!weights && this->NeedsWeights())
  {
    return no_weights(mesh, this->ArrayName);
  }
  if (!handle_data && this->NeedsHandles())
  {
    return Status::invalid_input("there is no handle");
  }

  BindKey key;
  key.add(this->BindTime.GetMTime());
  for (vtkObject* object : bind_objects(mesh, this->BindArrays()))
  {
    key.add(object);
  }
  if (handle_data)
  {
    for (vtkObject* object : bind_objects(handle_data))
    {
      key.add(object);
    }
  }
  Cache& bound = *this->Bound;
  const bool bind = !bound.valid || bound.key != key;
  if (bind)
  {
    bound = Cache();
    Status status;
    if (handle_data)
    {
      status = to_handles(handle_data, bound.handles, &bound.cells);
    }
    if (!status.ok())
    {
      return status;
    }
    if (weights)
    {
      status = check_weights(weights, mesh->GetNumberOfPoints(), bound.handles);
      if (!status.ok())
      {
        return status;
      }
      bound.weights = to_matrix(weights);
    }
    bound.points = to_points(mesh);
    if (!bound.points.view().allFinite())
    {
      return Status::invalid_input("the mesh has a coordinate that is not a finite number");
    }
  }
  Pose pose;
  Status status;
  if (handle_data)
  {
    status = to_pose(handle_data, bound.handles, bound.cells, pose);
  }
  if (!status.ok())
  {
    return status;
  }
  const PoseInput pose_input{ mesh, bound.points.view(), bound.weights.view(), bound.handles, pose,
    handle_data, bound.cells };
  if (bind)
  {
    Phase phase(context, "bind", 0.0, 0.8);
    const Status made = this->Bind(pose_input, context);
    if (!made.usable())
    {
      return made;
    }
    bound.status.report.merge(made.report);
    bound.status.warnings.insert(
      bound.status.warnings.end(), made.warnings.begin(), made.warnings.end());
    bound.key = key;
    bound.valid = true;
    this->NumberOfBinds += 1;
  }

  PosedPoints posed;
  Status deformed = this->Deform(pose_input, context, posed);
  if (!deformed.usable())
  {
    return deformed;
  }
  result->ShallowCopy(mesh);
  result->SetPoints(to_vtk_points(posed.points));
  if (!posed.transforms.empty())
  {
    result->GetFieldData()->AddArray(to_array(posed.transforms));
  }
  auto* polydata = vtkPolyData::SafeDownCast(result);
  if (vtkDataArray* rest = polydata ? polydata->GetPointData()->GetNormals() : nullptr)
  {
    PosedPoints normals;
    const Status turned = this->DeformNormals(pose_input, context, posed, normals);
    if (!turned.usable())
    {
      return turned;
    }
    polydata->GetPointData()->SetNormals(to_normals(normals.points, rest));
  }

  Status stretch;
  if (this->StretchLimit != 0.0)
  {
    Phase phase(context, "stretch", 1.0, 1.0);
    if (!bound.elements)
    {
      bound.elements = to_pose_elements(mesh);
    }
    stretch = measure_stretch(context, { this->StretchLimit, this->StretchArray }, *bound.elements,
      bound.points.view(), posed.points, result);
    if (!stretch.ok())
    {
      return stretch;
    }
  }

  Status total = deformed;
  Report report;
  report.set("counts.vertices", static_cast<int>(mesh->GetNumberOfPoints()));
  report.set("counts.handles", static_cast<int>(bound.handles.size()));
  report.set("binds", this->NumberOfBinds);
  report.merge(bound.status.report);
  report.merge(deformed.report);
  report.merge(stretch.report);
  total.report = report;
  total.warnings.insert(total.warnings.end(), stretch.warnings.begin(), stretch.warnings.end());
  // A bind's warnings are said once, when it is made.
  if (bind)
  {
    total.warnings.insert(
      total.warnings.begin(), bound.status.warnings.begin(), bound.status.warnings.end());
  }
  return total;
}

Status vtkPoseAlgorithm::DeformNormals(
  const PoseInput& input, ExecutionContext&, const PosedPoints& posed, PosedPoints& normals)
{
  SurfaceInput surface;
  const Status status = to_surface(input.mesh, surface);
  if (!status.ok())
  {
    return status;
  }
  const TrianglesView triangles = surface.triangles.view();
  const Points& p = posed.points;
  Points& n = normals.points;
  n.setZero(p.rows(), 3);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Vec3 a = p.row(triangles(t, 0));
    const Vec3 b = p.row(triangles(t, 1));
    const Vec3 c = p.row(triangles(t, 2));
    const Vec3 area = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k)
    {
      n.row(triangles(t, k)) += area.transpose();
    }
  }
  for (Index v = 0; v < n.rows(); ++v)
  {
    const double length = n.row(v).norm();
    n.row(v) =
      length > 0.0 ? Vec3(n.row(v).transpose() / length).transpose() : Vec3(0, 0, 1).transpose();
  }
  return {};
}

void vtkPoseAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "StretchLimit: " << this->StretchLimit << "\n";
  os << indent << "StretchArray: " << this->StretchArray << "\n";
  os << indent << "NumberOfBinds: " << this->NumberOfBinds << "\n";
}
