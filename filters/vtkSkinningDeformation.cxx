// Glue around the kernel bindpose::Skinning: the bind keeps its sparse weights.
#include "vtkSkinningDeformation.h"

#include "pose/skinning.h"
#include "pose_input.h"

#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

using namespace bindpose;

vtkStandardNewMacro(vtkSkinningDeformation);

struct vtkSkinningDeformation::Internals
{
  Skinning skinning;
  std::vector<Affine> transforms;
};

vtkSkinningDeformation::vtkSkinningDeformation() : Internal(new Internals) {}

vtkSkinningDeformation::~vtkSkinningDeformation() = default;

Status vtkSkinningDeformation::Bind(const PoseInput& input, ExecutionContext& context)
{
  return this->Internal->skinning.bind(context, input.weights);
}

Status vtkSkinningDeformation::Deform(
  const PoseInput& input, ExecutionContext& context, PosedPoints& posed)
{
  Phase phase(context, "skin", 0.8, 1.0);
  Status status = skinning_transforms(input.handles, input.pose, this->Internal->transforms);
  if (!status.usable())
  {
    return status;
  }
  Status moved = this->Method == DUAL_QUATERNION
    ? this->Internal->skinning.dual_quaternion(context, input.points, this->Internal->transforms,
        handle_pivots(input.handles), posed.points)
    : this->Internal->skinning.linear_blend(
        context, input.points, this->Internal->transforms, posed.points);
  posed.transforms = this->Internal->transforms;
  moved.warnings.insert(moved.warnings.end(), status.warnings.begin(), status.warnings.end());
  moved.report.set("method", this->Method == DUAL_QUATERNION ? "dual_quaternion" : "linear_blend");
  return moved;
}

Status vtkSkinningDeformation::DeformNormals(
  const PoseInput& input, ExecutionContext& context, const PosedPoints&, PosedPoints& normals)
{
  const SharedMatrix<Weights> rest = to_matrix(input.mesh->GetPointData()->GetNormals());
  const Eigen::Map<const Points> directions(rest.view().data(), rest.view().rows(), 3);
  return this->Method == DUAL_QUATERNION
    ? this->Internal->skinning.dual_quaternion_normals(context, directions,
        this->Internal->transforms, handle_pivots(input.handles), normals.points)
    : this->Internal->skinning.linear_blend_normals(
        context, directions, this->Internal->transforms, normals.points);
}

void vtkSkinningDeformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent
     << "Method: " << (this->Method == DUAL_QUATERNION ? "dual quaternion" : "linear blend")
     << "\n";
}
