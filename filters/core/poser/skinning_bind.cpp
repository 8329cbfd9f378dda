#include "poser/skinning_bind.h"

#include "poser/bone_endpoints.h"
#include "skinning/rotation_centers.h"

#include <tuple>

namespace bindpose
{

namespace
{
bool same_weights(const SkinningOptions& a, const SkinningOptions& b)
{
  return std::tie(a.single_precision, a.smallest_weight, a.influences) ==
    std::tie(b.single_precision, b.smallest_weight, b.influences);
}

void add_warnings(const Status& step, Status& status)
{
  status.warnings.insert(status.warnings.end(), step.warnings.begin(), step.warnings.end());
}
} // namespace

bool SkinningBind::has_endpoints(
  const SkinnedShape& shape, const SkinningMethodOptions& options) const
{
  return options.method != SkinningMethod::stretchable_bones ||
    options.endpoints == EndpointMethod::projection || shape.endpoints.rows() > 0 ||
    !has_bones(shape.handles) || this->endpoint_method_ == options.endpoints;
}

bool SkinningBind::needs_elements(
  const SkinnedShape& shape, const SkinningMethodOptions& options) const
{
  return !this->has_endpoints(shape, options) ||
    (options.method == SkinningMethod::rotation_centers && this->centers_.rows() == 0) ||
    (options.pseudo_edges == PseudoEdgeChoice::automatic && !this->automatic_edges_);
}

bool SkinningBind::is_bound(const SkinnedShape& shape, const SkinningMethodOptions& options) const
{
  return this->bound_ && same_weights(*this->bound_, options.weights) &&
    !this->needs_elements(shape, options);
}

Status SkinningBind::bind(ExecutionContext& context, const SkinnedShape& shape, TetsView tets,
  TrianglesView triangles, const SkinningMethodOptions& options)
{
  Status status;
  if (!this->bound_ || !same_weights(*this->bound_, options.weights))
  {
    const ProgressRange range(context, 0.0, this->needs_elements(shape, options) ? 0.05 : 1.0);
    this->bound_.reset();
    this->pivots_ = handle_pivots(shape.handles);
    SkinningOptions weights = options.weights;
    weights.center.reset();
    if (this->pivots_.rows() > 0)
    {
      weights.center = Vec3(this->pivots_.colwise().mean().transpose());
    }
    status = this->skinning_.bind(context, shape.weights, weights);
    if (!status.usable())
    {
      return status;
    }
    this->bound_ = options.weights;
  }
  if (options.pseudo_edges == PseudoEdgeChoice::automatic && !this->automatic_edges_)
  {
    Phase phase(context, "edges", 0.05, 0.1);
    PseudoEdges edges;
    const Status found = tets.rows() > 0
      ? automatic_pseudo_edges(context, shape.points, tets, shape.handles, edges)
      : automatic_pseudo_edges(context, shape.points, triangles, shape.handles, edges);
    if (!found.ok())
    {
      return found;
    }
    add_warnings(found, status);
    this->automatic_edges_ = std::move(edges);
  }
  if (options.method == SkinningMethod::rotation_centers && this->centers_.rows() == 0)
  {
    const Status found = this->bind_centers(context, shape, tets, triangles);
    if (!found.ok())
    {
      return found;
    }
  }
  if (!this->has_endpoints(shape, options))
  {
    const Status found = this->bind_endpoints(context, shape, tets, triangles, options.endpoints);
    if (!found.usable())
    {
      return found;
    }
    add_warnings(found, status);
  }
  return status;
}

Status SkinningBind::bind_centers(
  ExecutionContext& context, const SkinnedShape& shape, TetsView tets, TrianglesView triangles)
{
  Phase phase(context, "centers", 0.1, 1.0);
  Points centers;
  Status status = tets.rows() > 0
    ? rotation_centers(context, {}, shape.points, tets, shape.weights, centers)
    : rotation_centers(context, {}, shape.points, triangles, shape.weights, centers);
  if (status.ok())
  {
    this->centers_ = std::move(centers);
    this->centers_report_ = status.report;
  }
  return status;
}

Status SkinningBind::bind_endpoints(ExecutionContext& context, const SkinnedShape& shape,
  TetsView tets, TrianglesView triangles, EndpointMethod method)
{
  Phase phase(context, "endpoints", 0.1, 1.0);
  Domain domain;
  domain.points = shape.points;
  domain.tets = tets;
  domain.triangles = triangles;
  Weights endpoints;
  Status status = solve_endpoint_weights(
    context, domain, shape.handles, method, WeightsDomain::automatic, endpoints);
  if (status.usable())
  {
    this->endpoints_ = std::move(endpoints);
    this->endpoint_method_ = method;
  }
  return status;
}

WeightsView SkinningBind::endpoints(const SkinnedShape& shape, EndpointMethod method) const
{
  // Endpoint weights of the shape take precedence over computed endpoint weights. If there are
  // neither, return a view of size 0; Skinning::stretchable_bones() then projects points onto
  // bones.
  return shape.endpoints.rows() == 0 && this->endpoint_method_ == method
    ? WeightsView(this->endpoints_)
    : shape.endpoints;
}

Status SkinningBind::pose(ExecutionContext& context, const SkinnedShape& shape,
  const Pose& input_pose, const PseudoEdges& given_edges, const SkinningMethodOptions& options,
  PointsOutput posed)
{
  Pose pose = input_pose;
  const PseudoEdges& edges =
    options.pseudo_edges == PseudoEdgeChoice::automatic ? *this->automatic_edges_ : given_edges;
  const bool uses_pseudo_edges = options.pseudo_edges != PseudoEdgeChoice::none && !edges.empty();
  if (uses_pseudo_edges)
  {
    rotate_by_pseudo_edges(shape.handles, edges, options.pseudo_edge_stretch, pose);
  }
  const Status found = skinning_transforms(shape.handles, pose, this->transforms_);
  if (!found.usable())
  {
    return found;
  }
  Status status;
  switch (options.method)
  {
    case SkinningMethod::dual_quaternion:
      status = this->skinning_.dual_quaternion(
        context, shape.points, this->transforms_, this->pivots_, posed);
      break;
    case SkinningMethod::stretchable_bones:
      status = this->skinning_.stretchable_bones(context, shape.points, this->transforms_,
        bone_changes(shape.handles, input_pose), this->endpoints(shape, options.endpoints), posed);
      break;
    case SkinningMethod::rotation_centers:
      status = this->skinning_.centers_of_rotation(
        context, shape.points, this->transforms_, this->centers_, posed);
      status.report.merge(this->centers_report_);
      break;
    default:
      status = this->skinning_.linear_blend(context, shape.points, this->transforms_, posed);
      break;
  }
  add_warnings(found, status);
  if (uses_pseudo_edges)
  {
    status.report.set("counts.pseudo_edges", static_cast<Index>(edges.size()));
  }
  return status;
}

Status SkinningBind::pose_normals(
  ExecutionContext& context, PointsView rest, SkinningMethod method, PointsOutput posed) const
{
  switch (method)
  {
    case SkinningMethod::dual_quaternion:
      return this->skinning_.dual_quaternion_normals(
        context, rest, this->transforms_, this->pivots_, posed);
    case SkinningMethod::rotation_centers:
      return this->skinning_.centers_of_rotation_normals(context, rest, this->transforms_, posed);
    default:
      return this->skinning_.linear_blend_normals(context, rest, this->transforms_, posed);
  }
}

} // namespace bindpose
