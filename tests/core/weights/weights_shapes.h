#ifndef weights_shapes_h
#define weights_shapes_h

// Domains and handles that the tests of weights share.

#include "weights/bounded_biharmonic_weights.h"
#include "weights/weights_problem.h"

#include "support/handles.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace bindpose::test
{

inline Domain to_domain(const TriangleMesh& mesh)
{
  Domain domain;
  domain.points = mesh.points;
  domain.triangles = mesh.triangles;
  return domain;
}

inline Domain to_domain(const TetMesh& mesh)
{
  Domain domain;
  domain.points = mesh.points;
  domain.tets = mesh.tets;
  return domain;
}

/// Make a problem from a domain and handles. Expect success.
inline WeightsProblem problem_of(const Domain& domain, const Handles& handles,
  const std::vector<Index>& regions = {}, const WeightsOptions& options = {})
{
  ExecutionContext context;
  WeightsProblem problem;
  const Status status = make_weights_problem(context, domain, regions, handles, options, problem);
  EXPECT_TRUE(status.ok()) << status.message;
  return problem;
}

/// Compute bounded biharmonic weights. Expect success.
inline WeightsResult bounded(
  const WeightsProblem& problem, int order = 2, double tolerance = 1e-6, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  WeightsOptions options;
  options.order = order;
  options.tolerance = tolerance;
  WeightsResult result;
  const Status status = bounded_biharmonic_weights(context, problem, options, result);
  EXPECT_TRUE(status.ok()) << status.message;
  return result;
}

/// Return the five point handles on the unit square for which extrema and energies of weights are
/// known.
inline Handles five_points()
{
  return point_handles({ Vec3(0.2, 0.2, 0.0), Vec3(0.8, 0.2, 0.0), Vec3(0.5, 0.5, 0.0),
    Vec3(0.25, 0.8, 0.0), Vec3(0.8, 0.75, 0.0) });
}

/// A strip [0, 1] x [0, 2 / n] with n x 2 squares. Handle regions cover whole columns of vertices,
/// so weights depend only on x. The columns at the given positions x have the labels 1, 2, …
struct Bar
{
  Domain domain;
  std::vector<Index> region_ids;
  Handles handles;
  Index vertex(double x, int n) const { return static_cast<Index>(x * n + 0.5); }
};

inline Bar bar(int n, const std::vector<double>& positions)
{
  Bar result;
  result.domain = to_domain(grid(n, 2, 1.0, 2.0 / n));
  result.region_ids.assign(static_cast<std::size_t>(result.domain.points.rows()), 0);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const auto label = static_cast<Index>(i) + 1;
    result.handles.push_back(region_handle("r" + std::to_string(label), label));
    for (Index v = 0; v < result.domain.points.rows(); ++v)
    {
      if (std::abs(result.domain.points(v, 0) - positions[i]) < 1e-9)
      {
        result.region_ids[v] = label;
      }
    }
  }
  return result;
}

} // namespace bindpose::test

#endif
