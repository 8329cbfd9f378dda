// Connects the kernel bindpose::SkinningBind to VTK.
#include "vtkSkinningDeformation.h"

#include "pose_elements.h"
#include "pose_input.h"
#include "poser/skinning_bind.h"
#include "pseudo_edge_cells.h"
#include "weights_input.h"

#include "vtkDataArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

using namespace bindpose;

vtkStandardNewMacro(vtkSkinningDeformation);

static_assert(
  vtkSkinningDeformation::DUAL_QUATERNION == static_cast<int>(SkinningMethod::dual_quaternion));
static_assert(
  vtkSkinningDeformation::GIVEN_PSEUDO_EDGES == static_cast<int>(PseudoEdgeChoice::given));
static_assert(vtkSkinningDeformation::CENTERS_OF_ROTATION ==
  static_cast<int>(SkinningMethod::rotation_centers));
static_assert(
  vtkSkinningDeformation::STRETCHABLE_BONES == static_cast<int>(SkinningMethod::stretchable_bones));
static_assert(
  vtkSkinningDeformation::AUTOMATIC_PSEUDO_EDGES == static_cast<int>(PseudoEdgeChoice::automatic));

namespace
{
constexpr const char* method_names[] = { "linear_blend", "dual_quaternion", "stretchable_bones",
  "centers_of_rotation" };
constexpr const char* pseudo_edges_names[] = { "none", "given", "automatic" };

/// Return the options of the filter in the types of the kernel.
SkinningMethodOptions options_of(vtkSkinningDeformation& filter)
{
  SkinningMethodOptions options;
  options.method = static_cast<SkinningMethod>(filter.GetMethod());
  options.weights.single_precision = filter.GetSinglePrecision();
  options.weights.smallest_weight = filter.GetSmallestWeight();
  options.weights.influences = filter.GetMaximumInfluences();
  options.pseudo_edges = static_cast<PseudoEdgeChoice>(filter.GetPseudoEdges());
  options.pseudo_edge_stretch = filter.GetPseudoEdgeStretch();
  return options;
}
} // namespace

struct vtkSkinningDeformation::Internals
{
  SkinningBind bind;
  SharedMatrix<Weights> endpoints; // endpoint weights; no rows if the mesh has none
  /// Return the shape that the kernel poses: points, weights, handles and endpoint weights.
  SkinnedShape shape(const PoseInput& input) const
  {
    return { input.points, input.weights, input.handles, this->endpoints.view() };
  }
};

vtkSkinningDeformation::vtkSkinningDeformation() : Internal(this->GetBlock()) {}

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

Status vtkSkinningDeformation::Bind(ExecutionContext& context, const PoseInput& input)
{
  Internals& internal = *this->Internal;
  internal.bind.reset();
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
      status =
        check_endpoint_weights(internal.endpoints.view(), input.handles, this->EndpointArrayName);
    }
    if (!status.ok())
    {
      return status;
    }
  }
  return this->BindMissing(context, input);
}

/// Extend the bind by the data that the current method needs, if that data is missing.
Status vtkSkinningDeformation::BindMissing(ExecutionContext& context, const PoseInput& input)
{
  Internals& internal = *this->Internal;
  const SkinnedShape shape = internal.shape(input);
  const SkinningMethodOptions options = options_of(*this);
  if (internal.bind.is_bound(shape, options))
  {
    return {};
  }
  const PoseElements elements =
    internal.bind.needs_elements(shape, options) ? to_pose_elements(input.mesh) : PoseElements();
  return internal.bind.bind(
    context, shape, elements.tets.view(), elements.triangles.view(), options);
}

int vtkSkinningDeformation::GetPiecePort()
{
  const bool by_row = this->Method == LINEAR_BLEND || this->Method == DUAL_QUATERNION;
  return by_row && this->PseudoEdges != AUTOMATIC_PSEUDO_EDGES ? 0 : -1;
}

StretchUse vtkSkinningDeformation::GetStretchUse()
{
  return this->Method == STRETCHABLE_BONES ? StretchUse::all : StretchUse::tails;
}

Status vtkSkinningDeformation::Deform(
  ExecutionContext& context, const PoseInput& input, PosedPoints& posed)
{
  Internals& internal = *this->Internal;
  Status bound;
  {
    // The method may have changed since the bind.
    const ProgressRange range(context, 0.0, 0.8);
    bound = this->BindMissing(context, input);
  }
  Phase phase(context, "skin", 0.8, 1.0);
  bindpose::PseudoEdges edges;
  if (bound.usable() && this->PseudoEdges == GIVEN_PSEUDO_EDGES)
  {
    const Status converted = to_pseudo_edges(input.handle_data, input.handles, input.cells, edges);
    bound = converted.ok() ? bound : converted;
  }
  if (!bound.usable())
  {
    return bound;
  }
  Status status = internal.bind.pose(
    context, internal.shape(input), input.pose, edges, options_of(*this), posed.points);
  posed.transforms = internal.bind.transforms();
  status.warnings.insert(status.warnings.end(), bound.warnings.begin(), bound.warnings.end());
  status.report.set("method", method_names[this->Method]);
  return status;
}

Status vtkSkinningDeformation::DeformNormals(
  ExecutionContext& context, const PoseInput& input, const PosedPoints& posed, PosedPoints& normals)
{
  const auto method = static_cast<SkinningMethod>(this->Method);
  if (!SkinningBind::poses_normals(method))
  {
    return this->Superclass::DeformNormals(context, input, posed, normals);
  }
  const SharedMatrix<Weights> rest = to_matrix(input.mesh->GetPointData()->GetNormals());
  const Eigen::Map<const Points> directions(rest.view().data(), rest.view().rows(), 3);
  return this->Internal->bind.pose_normals(context, directions, method, normals.points);
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
