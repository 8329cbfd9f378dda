// Glue around the kernel bindpose::Skinning: the bind keeps its sparse weights.
#include "vtkSkinningDeformation.h"

#include "pose/skinning.h"
#include "pose_input.h"
#include "weights_input.h"

#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

using namespace bindpose;

vtkStandardNewMacro(vtkSkinningDeformation);

namespace
{
constexpr const char* method_names[] = { "linear_blend", "dual_quaternion", "stretchable_bones" };

Status check_endpoints(WeightsView endpoints, const Handles& handles, const std::string& name)
{
  for (Index v = 0; v < endpoints.rows(); ++v)
  {
    for (Index j = 0; j < endpoints.cols(); ++j)
    {
      const double e = endpoints(v, j);
      if (e < 0.0 || e > 1.0)
      {
        return Status::invalid_input("the array '" + name + "' has " + std::to_string(e) +
          " for handle '" + handles[static_cast<std::size_t>(j)].name + "' at point " +
          std::to_string(v) + ", not between 0 (the bone's head) and 1 (its tail)");
      }
    }
  }
  return {};
}
} // namespace

struct vtkSkinningDeformation::Internals
{
  Skinning skinning;
  SharedMatrix<Weights> endpoints; // size 0: there are none
  std::vector<Affine> transforms;
};

vtkSkinningDeformation::vtkSkinningDeformation() : Internal(new Internals) {}

vtkSkinningDeformation::~vtkSkinningDeformation() = default;

void vtkSkinningDeformation::SetSinglePrecision(bool single)
{
  this->SetBindParameter(this->SinglePrecision, single);
}

void vtkSkinningDeformation::SetSmallestWeight(double smallest)
{
  this->SetBindParameter(this->SmallestWeight, smallest);
}

void vtkSkinningDeformation::SetMaximumInfluences(int influences)
{
  this->SetBindParameter(this->MaximumInfluences, influences);
}

void vtkSkinningDeformation::SetEndpointArrayName(const std::string& name)
{
  this->SetBindParameter(this->EndpointArrayName, name);
}

std::vector<std::string> vtkSkinningDeformation::BindArrays()
{
  std::vector<std::string> names = this->Superclass::BindArrays();
  names.push_back(this->EndpointArrayName);
  return names;
}

Status vtkSkinningDeformation::Bind(const PoseInput& input, ExecutionContext& context)
{
  Internals& internal = *this->Internal;
  internal.endpoints = {};
  vtkDataArray* endpoints = this->EndpointArrayName.empty()
    ? nullptr
    : input.mesh->GetPointData()->GetArray(this->EndpointArrayName.c_str());
  if (endpoints)
  {
    Status status = check_weights(endpoints, input.mesh->GetNumberOfPoints(), input.handles);
    if (status.ok())
    {
      internal.endpoints = to_matrix(endpoints);
      status = check_endpoints(internal.endpoints.view(), input.handles, this->EndpointArrayName);
    }
    if (!status.ok())
    {
      return status;
    }
  }
  SkinningOptions options;
  options.single_precision = this->SinglePrecision;
  options.smallest_weight = this->SmallestWeight;
  options.influences = this->MaximumInfluences;
  return internal.skinning.bind(context, input.weights, options);
}

Status vtkSkinningDeformation::Deform(
  const PoseInput& input, ExecutionContext& context, PosedPoints& posed)
{
  Phase phase(context, "skin", 0.8, 1.0);
  Internals& internal = *this->Internal;
  Status status = skinning_transforms(input.handles, input.pose, internal.transforms);
  if (!status.usable())
  {
    return status;
  }
  Status moved;
  switch (this->Method)
  {
    case DUAL_QUATERNION:
      moved = internal.skinning.dual_quaternion(
        context, input.points, internal.transforms, handle_pivots(input.handles), posed.points);
      break;
    case STRETCHABLE_BONES:
      moved = internal.skinning.stretchable_bones(context, input.points, internal.transforms,
        bone_changes(input.handles, input.pose), internal.endpoints.view(), posed.points);
      break;
    default:
      moved =
        internal.skinning.linear_blend(context, input.points, internal.transforms, posed.points);
      break;
  }
  posed.transforms = internal.transforms;
  moved.warnings.insert(moved.warnings.end(), status.warnings.begin(), status.warnings.end());
  moved.report.set("method", method_names[this->Method]);
  return moved;
}

Status vtkSkinningDeformation::DeformNormals(
  const PoseInput& input, ExecutionContext& context, const PosedPoints& posed, PosedPoints& normals)
{
  if (this->Method == STRETCHABLE_BONES)
  {
    // A stretch changes slopes through the endpoint weights, too: those of the posed polygons.
    return this->Superclass::DeformNormals(input, context, posed, normals);
  }
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
  os << indent << "Method: " << method_names[this->Method] << "\n";
  os << indent << "SinglePrecision: " << this->SinglePrecision << "\n";
  os << indent << "SmallestWeight: " << this->SmallestWeight << "\n";
  os << indent << "MaximumInfluences: " << this->MaximumInfluences << "\n";
  os << indent << "EndpointArrayName: " << this->EndpointArrayName << "\n";
}
