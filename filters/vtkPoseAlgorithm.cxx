// Base class of the pose filters. It creates the output and measures the stretch for all pose
// methods; subclasses implement the bind and the motion of the points.
#include "vtkPoseAlgorithm.h"

#include "base/execution.h"
#include "pose_elements.h"
#include "pose_input.h"
#include "rotation_arrays.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <optional>

using namespace bindpose;

struct vtkPoseAlgorithm::RestData
{
  std::optional<PoseElements> elements;
  RestElements rest;
  vtkSmartPointer<vtkIntArray> clusters;
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

/// Return an array of `rows` points with undefined values.
vtkSmartPointer<vtkDoubleArray> new_points(Index rows)
{
  auto points = vtkSmartPointer<vtkDoubleArray>::New();
  points->SetNumberOfComponents(3);
  points->SetNumberOfTuples(rows);
  return points;
}

/// Return the memory of an array of points as a matrix.
Eigen::Map<Points> memory_of(vtkDoubleArray* points)
{
  return { points->GetPointer(0), points->GetNumberOfTuples(), 3 };
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

vtkPoseAlgorithm::vtkPoseAlgorithm() : RestCache(this->GetBlock()) {}

vtkPoseAlgorithm::~vtkPoseAlgorithm() = default;

Status vtkPoseAlgorithm::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  auto* result = vtkPointSet::GetData(output, 0);
  if (this->IsEmptyPiece(input, output))
  {
    if (auto* piece = vtkPointSet::GetData(input[0], 0))
    {
      result->ShallowCopy(piece);
    }
    Status status;
    status.report.set("counts.vertices", 0);
    return status;
  }
  const Status prepared = this->PrepareRest(context, input, {});
  if (!prepared.usable())
  {
    return prepared;
  }
  const PoseInput& pose_input = this->GetPoseInput();
  vtkPointSet* mesh = pose_input.mesh;

  const vtkSmartPointer<vtkDoubleArray> points = new_points(mesh->GetNumberOfPoints());
  PosedPoints posed(memory_of(points));
  Status deformed = this->Deform(context, pose_input, posed);
  if (!deformed.usable())
  {
    return deformed;
  }
  result->ShallowCopy(mesh);
  vtkNew<vtkPoints> posed_points;
  posed_points->SetData(points);
  result->SetPoints(posed_points);
  if (!posed.transforms.empty())
  {
    result->GetFieldData()->AddArray(to_array(posed.transforms));
  }
  if (!posed.rotations.empty())
  {
    add_rotations(
      *posed.groups, posed.rotations, this->RestCache->clusters, result->GetPointData());
  }
  auto* polydata = vtkPolyData::SafeDownCast(result);
  if (vtkDataArray* rest = polydata ? polydata->GetPointData()->GetNormals() : nullptr)
  {
    Points normals(posed.points.rows(), 3);
    PosedPoints posed_normals({ normals.data(), normals.rows(), 3 });
    const Status normal_status = this->DeformNormals(context, pose_input, posed, posed_normals);
    if (!normal_status.usable())
    {
      return normal_status;
    }
    polydata->GetPointData()->SetNormals(to_normals(normals, rest));
  }

  Status stretch;
  if (this->StretchLimit != 0.0)
  {
    Phase phase(context, "stretch", 1.0, 1.0);
    if (!this->RestCache->elements)
    {
      this->RestCache->elements = to_pose_elements(mesh);
      this->RestCache->rest = to_rest_elements(*this->RestCache->elements, pose_input.points);
    }
    stretch = measure_stretch(context, { this->StretchLimit, this->StretchArray },
      *this->RestCache->elements, this->RestCache->rest, posed.points, result);
    if (!stretch.ok())
    {
      return stretch;
    }
  }

  const std::string unused = unused_stretch(pose_input.pose, this->GetStretchUse());
  if (!unused.empty())
  {
    deformed.warnings.push_back(unused);
  }
  deformed.report.merge(stretch.report);
  deformed.warnings.insert(
    deformed.warnings.end(), stretch.warnings.begin(), stretch.warnings.end());
  return this->WithBindReport(deformed);
}

/// Call Prepare(). If it binds again, clear the cached data of the rest shape.
Status vtkPoseAlgorithm::PrepareRest(
  ExecutionContext& context, vtkInformationVector** input, const std::string& pose)
{
  const int binds = this->GetNumberOfBinds();
  const Status prepared = this->Prepare(context, input, pose);
  if (this->GetNumberOfBinds() != binds)
  {
    *this->RestCache = RestData();
  }
  return prepared;
}

bool vtkPoseAlgorithm::PosePoints(const std::string& pose, vtkDoubleArray* points)
{
  return this->ExecuteDirectly(
    [&](ExecutionContext& context)
    {
      if (!points)
      {
        return Status::invalid_input("PosePoints() needs an array for the points");
      }
      if (vtkCompositeDataSet::SafeDownCast(this->GetInput(0)) ||
        vtkCompositeDataSet::SafeDownCast(this->GetInput(1)))
      {
        return Status::invalid_input("PosePoints() needs one mesh and its handles, not blocks");
      }
      if (!this->CanPosePoints())
      {
        return Status::invalid_input(
          std::string(this->GetClassName()) + " has no PosePoints(): its points depend on time");
      }
      const Status prepared =
        this->PrepareRest(context, this->GetExecutive()->GetInputInformation(), pose);
      if (!prepared.usable())
      {
        return prepared;
      }
      const PoseInput& input = this->GetPoseInput();
      const void* memory = points->GetNumberOfValues() > 0 ? points->GetVoidPointer(0) : nullptr;
      if (memory && memory == input.mesh->GetPoints()->GetVoidPointer(0))
      {
        return Status::invalid_input("the output array shares its memory with the points of the "
                                     "mesh at rest; pass another array");
      }
      if (points->GetNumberOfComponents() != 3 ||
        points->GetNumberOfTuples() != input.points.rows())
      {
        points->SetNumberOfComponents(3);
        points->SetNumberOfTuples(input.points.rows());
      }
      PosedPoints posed(memory_of(points));
      Status deformed = this->Deform(context, input, posed);
      if (!deformed.usable())
      {
        return deformed;
      }
      const std::string unused = unused_stretch(input.pose, this->GetStretchUse());
      if (!unused.empty())
      {
        deformed.warnings.push_back(unused);
      }
      points->Modified();
      return this->WithBindReport(deformed);
    });
}

StretchUse vtkPoseAlgorithm::GetStretchUse()
{
  return StretchUse::ends;
}

Status vtkPoseAlgorithm::DeformNormals(
  ExecutionContext&, const PoseInput& input, const PosedPoints& posed, PosedPoints& normals)
{
  SurfaceInput surface;
  const Status status = to_surface(input.mesh, surface);
  if (!status.ok())
  {
    return status;
  }
  const TrianglesView triangles = surface.triangles.view();
  const Eigen::Map<Points>& p = posed.points;
  Eigen::Map<Points>& n = normals.points;
  n.setZero();
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
  os << indent << "StretchLimit: " << this->StretchLimit << "\n";
  os << indent << "StretchArray: " << this->StretchArray << "\n";
}
