#include "poser/bone_endpoints.h"

#include "weights/bounded_biharmonic_weights.h"

namespace bindpose
{

namespace
{
/// Return the points and segments that the auxiliary handles of endpoint_weights() add to the mesh:
/// the ends of the bones and, for the method `bounded`, the cage edge between the two ends of one
/// bone.
HandleElements elements_of(const Handles& ends)
{
  HandleElements elements;
  const auto count = static_cast<Index>(ends.size());
  const bool is_edge = !ends.empty() && !ends.front().cage.empty();
  elements.points.resize(is_edge ? 2 * count : count, 3);
  for (Index j = 0; j < elements.points.rows(); ++j)
  {
    elements.points.row(j) = ends[static_cast<std::size_t>(j % count)].head;
  }
  elements.segments.resize(is_edge ? 1 : 0, 2);
  if (is_edge)
  {
    elements.segments << count, count + 1;
  }
  elements.triangles.resize(0, 3);
  return elements;
}

Status solve_on_surface(ExecutionContext& context, const Domain& shape, const Handles& handles,
  WeightsDomain domain, const WeightsMethod& method, Weights& weights)
{
  SurfaceWeightsOptions options;
  options.domain = domain;
  options.handle_elements = elements_of(handles);
  SurfaceWeights result;
  Status status = surface_weights(
    context, shape.points, shape.triangles, {}, handles, options, {}, method, result);
  weights = std::move(result.weights);
  return status;
}

Status solve_in_tets(ExecutionContext& context, const Domain& shape, const Handles& handles,
  const WeightsMethod& method, Weights& weights)
{
  WeightsProblem problem;
  WeightsResult result;
  Status status = make_weights_problem(context, shape, {}, handles, {}, problem);
  if (status.usable())
  {
    status = method(context, problem, result);
  }
  if (status.usable())
  {
    // The solver may add points after those of the shape.
    weights = result.weights.topRows(shape.points.rows());
  }
  return status;
}
} // namespace

Status solve_endpoint_weights(ExecutionContext& context, const Domain& shape,
  const Handles& handles, EndpointMethod method, WeightsDomain domain, Weights& endpoints)
{
  const WeightsMethod bounded =
    [](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& result)
  { return bounded_biharmonic_weights(method_context, problem, {}, result); };
  const BoundedSolve solve = [&](ExecutionContext& solve_context, const Handles& ends,
                               Weights& weights) -> Status
  {
    return shape.is_volume()
      ? solve_in_tets(solve_context, shape, ends, bounded, weights)
      : solve_on_surface(solve_context, shape, ends, domain, bounded, weights);
  };
  return endpoint_weights(context, shape.points, handles, method, solve, endpoints);
}

} // namespace bindpose
