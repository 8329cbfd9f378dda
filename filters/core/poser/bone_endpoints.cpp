#include "poser/bone_endpoints.h"

#include "weights/bounded_biharmonic_weights.h"

namespace bindpose
{

namespace
{
/// Return the ends of handles, and their bones and elements of cages. Edges and faces of cages have
/// their own points, as in a handle dataset.
HandlePlaces places_of(const Handles& handles)
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 2>> segments;
  std::vector<std::array<Index, 3>> triangles;
  const auto add = [&](const Vec3& point)
  {
    points.push_back(point);
    return static_cast<Index>(points.size()) - 1;
  };
  for (const Handle& handle : handles)
  {
    const Index head = add(handle.head);
    if (handle.kind == HandleKind::bone)
    {
      segments.push_back({ head, add(handle.tail) });
    }
  }
  for (const Handle& handle : handles)
  {
    for (const CageElement& element : handle.cage)
    {
      const auto corner = [&](int k)
      { return add(handles[static_cast<std::size_t>(element[k])].head); };
      const Index a = corner(0);
      const Index b = corner(1);
      if (element[2] < 0)
      {
        segments.push_back({ a, b });
        continue;
      }
      const Index c = corner(2);
      segments.insert(segments.end(), { { c, a }, { a, b }, { b, c } });
      triangles.push_back({ a, b, c });
    }
  }
  HandlePlaces places;
  places.points.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    places.points.row(static_cast<Index>(i)) = points[i];
  }
  places.segments.resize(static_cast<Index>(segments.size()), 2);
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    places.segments.row(static_cast<Index>(i)) << segments[i][0], segments[i][1];
  }
  places.triangles.resize(static_cast<Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    places.triangles.row(static_cast<Index>(i)) << triangles[i][0], triangles[i][1],
      triangles[i][2];
  }
  return places;
}

Status solve_on_surface(ExecutionContext& context, const Domain& shape, const Handles& handles,
  WeightsDomain domain, const WeightsMethod& method, Weights& weights)
{
  SurfaceWeightsOptions options;
  options.domain = domain;
  options.places = places_of(handles);
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
    [](ExecutionContext& of_method, const WeightsProblem& problem, WeightsResult& result)
  { return bounded_biharmonic_weights(of_method, problem, {}, result); };
  const BoundedSolve solve = [&](ExecutionContext& of_solve, const Handles& ends,
                               Weights& weights) -> Status
  {
    return shape.is_volume() ? solve_in_tets(of_solve, shape, ends, bounded, weights)
                             : solve_on_surface(of_solve, shape, ends, domain, bounded, weights);
  };
  return endpoint_weights(context, shape.points, handles, method, solve, endpoints);
}

} // namespace bindpose
