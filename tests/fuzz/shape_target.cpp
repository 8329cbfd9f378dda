#include "fuzz/shape_target.h"

#include "automatic/spread_points.h"
#include "io/off.h"
#include "skinning/skinning.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/surface_weights.h"

#include "fuzz/memory_file.h"
#include "fuzz/status_checks.h"
#include "support/handles.h"

namespace bindpose::test
{

namespace
{
constexpr Index maximum_triangles = 64;
constexpr Index lattice_resolution = 6;

Status solve(ExecutionContext& context, const TriangleMesh& mesh, const Handles& handles,
  SurfaceWeights& result)
{
  SurfaceWeightsOptions options;
  options.domain = WeightsDomain::embedding;
  options.resolution = lattice_resolution;
  options.check_resolution = false;
  const WeightsOptions weights_options;
  return surface_weights(
    context, mesh.points, mesh.triangles, {}, handles, options, weights_options,
    [&](ExecutionContext& solver_context, const WeightsProblem& problem, WeightsResult& solved)
    { return bounded_biharmonic_weights(solver_context, problem, weights_options, solved); },
    result);
}

void expect_valid_weights(const Weights& weights, Index vertices, Index handles)
{
  ASSERT_EQ(weights.rows(), vertices);
  ASSERT_EQ(weights.cols(), handles);
  ASSERT_TRUE(weights.allFinite());
  EXPECT_GE(weights.minCoeff(), 0.0);
  EXPECT_LE(weights.maxCoeff(), 1.0 + 1e-12);
}

void expect_valid_poses(ExecutionContext& context, const TriangleMesh& mesh, const Weights& weights)
{
  Skinning skinning;
  ASSERT_TRUE(skinning.bind(context, weights).ok());
  std::vector<Affine> transforms(static_cast<std::size_t>(weights.cols()), identity_affine());
  Points posed(mesh.points.rows(), 3);
  ASSERT_TRUE(skinning.linear_blend(context, mesh.points, transforms, posed).ok());
  EXPECT_EQ(posed, mesh.points);
  transforms.front().leftCols<3>() *= 0.5;
  ASSERT_TRUE(skinning.linear_blend(context, mesh.points, transforms, posed).ok());
  EXPECT_TRUE(posed.allFinite());
}
} // namespace

bool check_shape(std::string_view input)
{
  const MemoryFile file(input);
  PolygonMesh polygons;
  if (!read_off(file.path(), polygons).ok())
  {
    return false;
  }
  const TriangleMesh mesh{ polygons.points, fan_triangles(polygons) };
  if (mesh.triangles.rows() > maximum_triangles || mesh.points.rows() > 3 * maximum_triangles)
  {
    return false;
  }
  ExecutionContext context;
  context.set_threads(1);
  SpreadPointsOptions options;
  options.count = 3;
  SpreadPoints spread;
  Status status = spread_points(context, mesh.points, mesh.triangles, options, spread);
  SurfaceWeights result;
  Handles handles;
  for (Index k = 0; status.ok() && k < spread.positions.rows(); ++k)
  {
    handles.push_back(point_handle("p" + std::to_string(k), spread.positions.row(k)));
  }
  if (status.ok())
  {
    status = solve(context, mesh, handles, result);
  }
  if (!status.ok())
  {
    EXPECT_NE(status.code, StatusCode::internal_error) << status.message;
    expect_valid_messages(status);
    return false;
  }
  expect_valid_weights(result.weights, mesh.points.rows(), static_cast<Index>(handles.size()));
  expect_valid_poses(context, mesh, result.weights);
  return true;
}

} // namespace bindpose::test
