// Connects the kernel bindpose::Skinning to VTK: the bind stores its sparse weights.
#include "vtkSkinningDeformation.h"

#include "pose_elements.h"
#include "pose_input.h"
#include "pseudo_edge_cells.h"
#include "skinning/rotation_centers.h"
#include "skinning/skinning.h"
#include "weights_input.h"

#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <optional>

using namespace bindpose;

vtkStandardNewMacro(vtkSkinningDeformation);

namespace
{
constexpr const char* method_names[] = { "linear_blend", "dual_quaternion", "stretchable_bones",
  "centers_of_rotation" };
constexpr const char* pseudo_edges_names[] = { "none", "given", "automatic" };

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
          std::to_string(v) + "; expected a value from 0 (the bone's head) to 1 (its tail)");
      }
    }
  }
  return {};
}
} // namespace

struct vtkSkinningDeformation::Internals
{
  Skinning skinning;
  SharedMatrix<Weights> endpoints; // endpoint weights; no columns if the mesh has none
  Points centers; // centers of rotation at rest, computed on first use
  Status of_centers;
  std::optional<bindpose::PseudoEdges> edges; // the automatic pseudo-edges, computed on first use
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
  internal.edges.reset();
  internal.centers.resize(0, 3);
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
  const bool centers = this->Method == CENTERS_OF_ROTATION;
  Status status;
  {
    const ProgressRange range(context, 0.0, centers ? 0.01 : 1.0);
    status = internal.skinning.bind(context, input.weights, options);
  }
  if (!status.usable() || !centers)
  {
    return status;
  }
  const Status found = this->FindCenters(input, context, 0.01, 1.0);
  return found.ok() ? status : found;
}

Status vtkSkinningDeformation::FindCenters(
  const PoseInput& input, ExecutionContext& context, double begin, double end)
{
  Phase phase(context, "centers", begin, end);
  Internals& internal = *this->Internal;
  const PoseElements elements = to_pose_elements(input.mesh);
  Points centers;
  internal.of_centers = elements.volume
    ? rotation_centers(context, {}, input.points, elements.tets.view(), input.weights, centers)
    : rotation_centers(
        context, {}, input.points, elements.triangles.view(), input.weights, centers);
  if (internal.of_centers.ok())
  {
    internal.centers = std::move(centers);
  }
  return internal.of_centers;
}

/// Compute the transforms of the pose, including the rotations from pseudo-edges.
Status vtkSkinningDeformation::FindTransforms(const PoseInput& input, ExecutionContext& context)
{
  Internals& internal = *this->Internal;
  Status status;
  bindpose::PseudoEdges edges;
  if (this->PseudoEdges == AUTOMATIC_PSEUDO_EDGES)
  {
    if (!internal.edges)
    {
      const PoseElements elements = to_pose_elements(input.mesh);
      bindpose::PseudoEdges found;
      status = elements.volume
        ? automatic_pseudo_edges(context, input.points, elements.tets.view(), input.handles, found)
        : automatic_pseudo_edges(
            context, input.points, elements.triangles.view(), input.handles, found);
      if (!status.ok())
      {
        return status;
      }
      internal.edges = std::move(found);
    }
    edges = *internal.edges;
  }
  else if (this->PseudoEdges == GIVEN_PSEUDO_EDGES)
  {
    status = to_pseudo_edges(input.handle_data, input.handles, input.cells, edges);
    if (!status.ok())
    {
      return status;
    }
  }
  Pose pose = input.pose;
  turn_by_pseudo_edges(input.handles, edges, this->PseudoEdgeStretch, pose);
  const Status found = skinning_transforms(input.handles, pose, internal.transforms);
  status.warnings.insert(status.warnings.end(), found.warnings.begin(), found.warnings.end());
  if (!edges.empty())
  {
    status.report.set("counts.pseudo_edges", static_cast<Index>(edges.size()));
  }
  return status;
}

StretchUse vtkSkinningDeformation::GetStretchUse()
{
  return this->Method == STRETCHABLE_BONES ? StretchUse::all : StretchUse::tails;
}

Status vtkSkinningDeformation::Deform(
  const PoseInput& input, ExecutionContext& context, PosedPoints& posed)
{
  Internals& internal = *this->Internal;
  if (this->Method == CENTERS_OF_ROTATION && internal.centers.rows() != input.points.rows())
  {
    const Status found = this->FindCenters(input, context, 0.0, 0.8);
    if (!found.ok())
    {
      return found;
    }
  }
  Phase phase(context, "skin", 0.8, 1.0);
  const Status status = this->FindTransforms(input, context);
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
    case CENTERS_OF_ROTATION:
      moved = internal.skinning.about_centers(
        context, input.points, internal.transforms, internal.centers, posed.points);
      moved.report.merge(internal.of_centers.report);
      break;
    default:
      moved =
        internal.skinning.linear_blend(context, input.points, internal.transforms, posed.points);
      break;
  }
  posed.transforms = internal.transforms;
  moved.warnings.insert(moved.warnings.end(), status.warnings.begin(), status.warnings.end());
  moved.report.merge(status.report);
  moved.report.set("method", method_names[this->Method]);
  return moved;
}

Status vtkSkinningDeformation::DeformNormals(
  const PoseInput& input, ExecutionContext& context, const PosedPoints& posed, PosedPoints& normals)
{
  if (this->Method == STRETCHABLE_BONES)
  {
    // With a stretch the endpoint weights also change the slope of the surface, so the skinned
    // normals are wrong. Use the normals of the posed polygons.
    return this->Superclass::DeformNormals(input, context, posed, normals);
  }
  const SharedMatrix<Weights> rest = to_matrix(input.mesh->GetPointData()->GetNormals());
  const Eigen::Map<const Points> directions(rest.view().data(), rest.view().rows(), 3);
  if (this->Method == CENTERS_OF_ROTATION)
  {
    return this->Internal->skinning.about_centers_normals(
      context, directions, this->Internal->transforms, normals.points);
  }
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
  os << indent << "PseudoEdges: " << pseudo_edges_names[this->PseudoEdges] << "\n";
  os << indent << "PseudoEdgeStretch: " << this->PseudoEdgeStretch << "\n";
  os << indent << "SinglePrecision: " << this->SinglePrecision << "\n";
  os << indent << "SmallestWeight: " << this->SmallestWeight << "\n";
  os << indent << "MaximumInfluences: " << this->MaximumInfluences << "\n";
  os << indent << "EndpointArrayName: " << this->EndpointArrayName << "\n";
}
