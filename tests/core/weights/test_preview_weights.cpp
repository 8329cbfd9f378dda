// Preview weights: clamped biharmonic weights, which are shown while better weights are computed.
// The tests compare preview weights with clamped biharmonic weights from a separate factorization,
// and check the certificate of preview weights.
#include "weights/bounded_biharmonic_weights.h"
#include "weights/preview_weights.h"
#include "weights/unconstrained_weights.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

using namespace bindpose;
using test::problem_of;

namespace
{
WeightsResult preview(const WeightsProblem& problem)
{
  ExecutionContext context;
  WeightsResult result;
  const Status status = preview_weights(context, problem, {}, result);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("stage"), "preview");
  for (Index v = 0; v < result.weights.rows(); ++v)
  {
    if (problem.constraints.roles[v] != VertexRole::unreferenced)
    {
      EXPECT_NEAR(result.weights.row(v).sum(), 1.0, 1e-12);
    }
  }
  EXPECT_GE(result.raw.minCoeff(), 0.0);
  EXPECT_LE(result.raw.maxCoeff(), 1.0);
  return result;
}

/// Compute clamped biharmonic weights with a factorization of the energy.
Weights clamped_biharmonic(const WeightsProblem& problem)
{
  ExecutionContext context;
  WeightsResult result;
  EXPECT_TRUE(biharmonic_weights(context, problem, {}, result).ok());
  return result.raw.cwiseMax(0.0).cwiseMin(1.0);
}

Handles corners_and_a_bone()
{
  return { test::point_handle("a", { 0.1, 0.15, 0.2 }), test::point_handle("b", { 0.9, 0.8, 0.7 }),
    test::bone_handle("c", { 0.5, 0.1, 0.9 }, { 0.55, 0.8, 0.85 }) };
}
} // namespace

TEST(PreviewWeights, AreBiharmonicWeightsWithoutTheirFactorization)
{
  for (const Domain& domain :
    { test::to_domain(test::tet_box(9, 8, 7)), test::to_domain(test::sphere(3)) })
  {
    const WeightsProblem problem = problem_of(domain, corners_and_a_bone());
    EXPECT_LT((preview(problem).raw - clamped_biharmonic(problem)).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(PreviewWeights, OfLargeRegionsAreNearThemByConjugateGradients)
{
  const TetMesh box = test::tet_box(14, 10, 10);
  std::vector<Index> regions;
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    const double x = box.points(v, 0);
    regions.push_back(x < 0.2 ? 1 : x > 0.8 ? 2 : 0);
  }
  const WeightsProblem problem = problem_of(test::to_domain(box),
    { test::region_handle("left", 1), test::region_handle("right", 2),
      test::point_handle("middle", { 0.5, 0.5, 0.5 }) },
    regions);
  ASSERT_GT(problem.fixed.size(), 16u * 3u);
  EXPECT_LT((preview(problem).raw - clamped_biharmonic(problem)).cwiseAbs().maxCoeff(), 5e-3);
}

TEST(PreviewWeights, CertificateBoundsTheDistanceFromBoundedWeights)
{
  const WeightsProblem problem =
    problem_of(test::to_domain(test::grid(24, 24)), test::five_points());
  const WeightsResult preview_result = preview(problem);
  ExecutionContext context;
  WeightsResult exact;
  ASSERT_TRUE(bounded_biharmonic_weights(context, problem, {}, exact).ok());
  for (std::size_t j = 0; j < preview_result.columns.size(); ++j)
  {
    const Certificate& preview_certificate = preview_result.columns[j].certificate;
    EXPECT_GE(preview_certificate.energy - exact.columns[j].certificate.energy, -1e-9);
    EXPECT_LE(preview_certificate.energy - exact.columns[j].certificate.energy,
      preview_certificate.relative_gap * preview_certificate.energy * (1.0 + 1e-9));
    EXPECT_GT(preview_certificate.relative_gap, 1e-6) << "clamping alone is no solution";
  }
}

TEST(PreviewWeights, OfPartsAndOfVerticesThatAreAllFixed)
{
  // A second box has no handle, so it gets the weights of the nearest handle. If all vertices
  // belong to handles, the weights equal the given values.
  TetMesh two = test::tet_box(3, 3, 3);
  const TetMesh other = test::tet_box(2, 2, 2, Vec3(3, 0, 0), Vec3(4, 1, 1));
  const Index n = two.points.rows(), t = two.tets.rows();
  two.points.conservativeResize(n + other.points.rows(), 3);
  two.points.bottomRows(other.points.rows()) = other.points;
  two.tets.conservativeResize(t + other.tets.rows(), 4);
  two.tets.bottomRows(other.tets.rows()) = other.tets.array() + n;
  const WeightsProblem problem = problem_of(test::to_domain(two),
    { test::point_handle("a", { 0, 0, 0 }), test::point_handle("b", { 1, 1, 1 }) });
  const WeightsResult result = preview(problem);
  EXPECT_TRUE((result.weights.bottomRows(other.points.rows()).col(1).array() == 1.0).all());

  const TetMesh small = test::tet_box(1, 1, 1);
  Handles all;
  for (Index v = 0; v < small.points.rows(); ++v)
  {
    all.push_back(test::point_handle("h" + std::to_string(v), small.points.row(v)));
  }
  const WeightsResult given = preview(problem_of(test::to_domain(small), all));
  EXPECT_TRUE(given.weights.isApprox(Weights::Identity(8, 8)));
}

TEST(PreviewWeights, StopWhenCanceled)
{
  const WeightsProblem problem =
    problem_of(test::to_domain(test::tet_box(6, 6, 6)), corners_and_a_bone());
  ExecutionContext context;
  context.request_cancel();
  WeightsResult result;
  EXPECT_EQ(preview_weights(context, problem, {}, result).code, StatusCode::canceled);
}
