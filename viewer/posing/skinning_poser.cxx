// Poses by skinning. Centers of rotation take seconds to compute, and endpoint weights take as long
// as a bind. Both are phases of bind(), so that the window can show their progress and cancel them.
#include "posing/skinning_poser.h"

#include "skinning/rotation_centers.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/surface_weights.h"

#include "conversion.h"
#include "handle_geometry.h"

#include "vtkPolyData.h"

namespace bindpose
{

namespace
{
bool has_bones(const Handles& handles)
{
  for (const Handle& handle : handles)
  {
    if (handle.kind == HandleKind::bone)
    {
      return true;
    }
  }
  return false;
}
} // namespace

bool SkinningPoser::has_endpoints(const PoseOptions& options) const
{
  return options.method != PoseMethod::stretchable_bones ||
    options.endpoints == EndpointMethod::projection || this->source().endpoints.rows() > 0 ||
    !has_bones(this->source().handles) || this->endpoint_method_ == options.endpoints;
}

bool SkinningPoser::is_bound(const PoseOptions& options) const
{
  return this->single_ == options.single_precision && this->has_endpoints(options) &&
    (options.method != PoseMethod::rotation_centers || this->centers_.rows() > 0) &&
    (options.pseudo_edges != PseudoEdgeChoice::automatic || this->automatic_edges_);
}

Status SkinningPoser::bind_missing(ExecutionContext& context, const PoseOptions& options)
{
  const PoseSource& source = this->source();
  Status status;
  if (this->single_ != options.single_precision)
  {
    Phase phase(context, "bind", 0.0, 0.05);
    SkinningOptions skinning;
    skinning.single_precision = options.single_precision;
    this->single_.reset();
    status = this->skinning_.bind(context, source.weights, skinning);
    if (!status.usable())
    {
      return status;
    }
    this->single_ = options.single_precision;
    this->pivots_ = handle_pivots(source.handles);
  }
  if (options.pseudo_edges == PseudoEdgeChoice::automatic && !this->automatic_edges_)
  {
    Phase phase(context, "edges", 0.05, 0.1);
    PseudoEdges edges;
    const Status found =
      automatic_pseudo_edges(context, source.points, source.triangles, source.handles, edges);
    if (!found.ok())
    {
      return found;
    }
    status.warnings.insert(status.warnings.end(), found.warnings.begin(), found.warnings.end());
    this->automatic_edges_ = std::move(edges);
  }
  if (options.method == PoseMethod::rotation_centers && this->centers_.rows() == 0)
  {
    Phase phase(context, "centers", 0.1, 1.0);
    Points centers;
    const Status found =
      rotation_centers(context, {}, source.points, source.triangles, source.weights, centers);
    if (!found.ok())
    {
      return found;
    }
    this->centers_ = std::move(centers);
  }
  if (!this->has_endpoints(options))
  {
    const Status made = this->make_endpoints(context, options.endpoints);
    if (!made.usable())
    {
      return made;
    }
    status.warnings.insert(status.warnings.end(), made.warnings.begin(), made.warnings.end());
  }
  return status;
}

/// Compute endpoint weights for a surface, as vtkBoneEndpointWeights does.
Status SkinningPoser::make_endpoints(ExecutionContext& context, EndpointMethod method)
{
  Phase phase(context, "endpoints", 0.1, 1.0);
  const PoseSource& source = this->source();
  const WeightsMethod bounded =
    [](const WeightsProblem& problem, ExecutionContext& of_method, WeightsResult& result)
  { return bounded_biharmonic_weights(problem, {}, of_method, result); };
  const BoundedSolve solve = [&](const Handles& ends, ExecutionContext& of_solve,
                               Weights& weights) -> Status
  {
    HandleGeometry geometry;
    Status status = to_handle_geometry(to_polydata(ends), geometry);
    if (!status.ok())
    {
      return status;
    }
    SurfaceWeightsOptions options;
    options.places = to_handle_places(geometry);
    SurfaceWeights result;
    status = surface_weights(
      source.points, source.triangles, {}, ends, options, {}, bounded, of_solve, result);
    weights = std::move(result.weights);
    return status;
  };
  Weights endpoints;
  const Status status =
    endpoint_weights(source.points, source.handles, method, solve, context, endpoints);
  if (status.usable())
  {
    this->endpoints_ = std::move(endpoints);
    this->endpoint_method_ = method;
  }
  return status;
}

Status SkinningPoser::pose(ExecutionContext& context, const Pose& given, const PoseOptions& options,
  Index /*most_iterations*/, Points& posed)
{
  const PoseSource& source = this->source();
  Phase phase(context, "skin");
  Status status;
  Pose pose = given;
  const bool automatic = options.pseudo_edges == PseudoEdgeChoice::automatic;
  if (options.pseudo_edges == PseudoEdgeChoice::given && !source.of_pseudo_edges.ok())
  {
    return source.of_pseudo_edges;
  }
  if (options.pseudo_edges != PseudoEdgeChoice::none)
  {
    turn_by_pseudo_edges(source.handles, automatic ? *this->automatic_edges_ : source.pseudo_edges,
      options.pseudo_edge_stretch, pose);
  }
  status = skinning_transforms(source.handles, pose, this->transforms_);
  if (!status.usable())
  {
    return status;
  }
  Status moved;
  switch (options.method)
  {
    case PoseMethod::dual_quaternion:
      moved = this->skinning_.dual_quaternion(
        context, source.points, this->transforms_, this->pivots_, posed);
      break;
    case PoseMethod::stretchable_bones:
      if (!has_bones(source.handles))
      {
        status.warnings.emplace_back("no handle is a bone that can stretch or twist, so the result "
                                     "equals linear blend skinning");
      }
      moved = this->skinning_.stretchable_bones(context, source.points, this->transforms_,
        bone_changes(source.handles, given),
        source.endpoints.rows() > 0                         ? WeightsView(source.endpoints)
          : options.endpoints == EndpointMethod::projection ? WeightsView(Weights())
                                                            : WeightsView(this->endpoints_),
        posed);
      break;
    case PoseMethod::rotation_centers:
      moved = this->skinning_.about_centers(
        context, source.points, this->transforms_, this->centers_, posed);
      break;
    default:
      moved = this->skinning_.linear_blend(context, source.points, this->transforms_, posed);
      break;
  }
  moved.warnings.insert(moved.warnings.end(), status.warnings.begin(), status.warnings.end());
  moved.report.set("seconds.skin", phase.seconds());
  return moved;
}

} // namespace bindpose
