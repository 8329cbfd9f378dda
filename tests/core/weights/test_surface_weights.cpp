// Weights of surfaces, computed on one of two domains: tets of the enclosed volume, or an embedding
// lattice. On tets of the volume, the weights must equal those of separate calls that
// tetrahedralize, solve and transfer. On a lattice, the weights must be close to those of a fine
// tet mesh. Other tests check parts that are close but not connected, and the automatic choice of
// the domain.
#include "domain/embedded_surface.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/surface_weights.h"
#include "transfer/transfer.h"
#include "weights/unconstrained_weights.h"

#include "support/needs_mesher.h"
#include "weights_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
using SurfaceWeightsInTets = test::MesherTest;

Status bounded_method(
  ExecutionContext& context, const WeightsProblem& problem, WeightsResult& result)
{
  return bounded_biharmonic_weights(context, problem, {}, result);
}

Status solve_surface_weights(const TriangleMesh& mesh, const Handles& handles,
  const SurfaceWeightsOptions& options, SurfaceWeights& result, int threads = 0)
{
  ExecutionContext context;
  context.set_threads(threads);
  return surface_weights(
    context, mesh.points, mesh.triangles, {}, handles, options, {}, bounded_method, result);
}

SurfaceWeightsOptions options_for(WeightsDomain domain, Index resolution = 0)
{
  SurfaceWeightsOptions options;
  options.domain = domain;
  options.resolution = resolution;
  return options;
}

double rms(const Weights& a, const Weights& b)
{
  return std::sqrt((a - b).squaredNorm() / static_cast<double>(a.size()));
}

/// Return the surface of [0, 4] x [0, 1] x [0, 1] with squares of 1/8.
TriangleMesh long_box()
{
  return { test::tet_box(32, 8, 8, Vec3::Zero(), Vec3(4, 1, 1)).points,
    boundary_triangles(test::tet_box(32, 8, 8, Vec3::Zero(), Vec3(4, 1, 1)).tets) };
}

Handles three_along()
{
  return { test::point_handle("left", { 0.3, 0.5, 0.5 }),
    test::point_handle("right", { 3.7, 0.45, 0.55 }),
    test::bone_handle("middle", { 1.5, 0.5, 0.5 }, { 2.5, 0.5, 0.5 }) };
}

void expect_weights(const Weights& weights, Index rows, Index columns)
{
  ASSERT_EQ(weights.rows(), rows);
  ASSERT_EQ(weights.cols(), columns);
  EXPECT_GE(weights.minCoeff(), 0.0);
  EXPECT_LE(weights.maxCoeff(), 1.0);
  EXPECT_LT((weights.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
}
} // namespace

TEST_F(SurfaceWeightsInTets, OfTheVolumeAreTheStagesByHand)
{
  const TriangleMesh mesh = long_box();
  SurfaceWeights result;
  Status status =
    solve_surface_weights(mesh, three_along(), options_for(WeightsDomain::volume), result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("domain"), "volume");
  EXPECT_EQ(status.report.text("tetrahedralize.method"), "cdt");
  expect_weights(result.weights, mesh.points.rows(), 3);

  ExecutionContext context;
  TetrahedralizeOptions options;
  options.interior_edge = interior_edge_of_weights(
    signed_volume(mesh.points, mesh.triangles), bounding_box(mesh.points).diagonal());
  TetrahedralizeResult tets;
  ASSERT_TRUE(tetrahedralize(context, mesh.points, mesh.triangles, options, tets).ok());
  WeightsProblem problem;
  ASSERT_TRUE(
    make_weights_problem(context, test::to_domain(tets.mesh), {}, three_along(), {}, problem).ok());
  WeightsResult solved;
  ASSERT_TRUE(bounded_method(context, problem, solved).ok());
  Weights transferred;
  TransferCounts counts;
  ASSERT_TRUE(
    transfer(context, problem.mesh.domain, solved.weights, mesh.points, {}, transferred, counts)
      .ok());
  EXPECT_TRUE((transferred.array() == result.weights.array()).all());
}

TEST(SurfaceWeights, OfTheEmbeddingAreNearThoseOfAFineVolume)
{
  const TriangleMesh mesh = long_box();
  const TetMesh fine = test::tet_box(48, 12, 12, Vec3::Zero(), Vec3(4, 1, 1));
  ExecutionContext context;
  WeightsProblem problem;
  ASSERT_TRUE(
    make_weights_problem(context, test::to_domain(fine), {}, three_along(), {}, problem).ok());
  WeightsResult solved;
  ASSERT_TRUE(bounded_method(context, problem, solved).ok());
  Weights reference;
  TransferCounts counts;
  ASSERT_TRUE(
    transfer(context, problem.mesh.domain, solved.weights, mesh.points, {}, reference, counts)
      .ok());

  SurfaceWeights result;
  const Status status =
    solve_surface_weights(mesh, three_along(), options_for(WeightsDomain::embedding), result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(status.report.text("domain"), "embedding");
  expect_weights(result.weights, mesh.points.rows(), 3);
  EXPECT_LE(rms(result.weights, reference), 0.015);
  EXPECT_LE(status.report.number("guard.rms_difference", 1.0), 0.02);
  EXPECT_LT(status.report.number("guard.resolution", 0.0),
    status.report.number("embedding.resolution", 0.0));
  for (const WeightsColumn& column : result.solved.columns)
  {
    EXPECT_LE(column.certificate.relative_gap, 1e-6);
  }
}

TEST(SurfaceWeights, NoneIsAlmostZero)
{
  const TriangleMesh mesh = long_box();
  SurfaceWeights result;
  const Status status =
    solve_surface_weights(mesh, three_along(), options_for(WeightsDomain::embedding), result);
  ASSERT_TRUE(status.ok()) << status.message;
  const Index zeros = (result.weights.array() == 0.0).count();
  // Weights below 1e-12 are set to zero. Then the rows are divided by their sums, so the remaining
  // weights may be a little smaller than 1e-12.
  const Index almost_zeros = (result.weights.array() < 5e-13).count() - zeros;
  EXPECT_GT(zeros, 0);
  EXPECT_EQ(almost_zeros, 0);
}

TEST(SurfaceWeights, ProngsThatAreNearButNotConnectedDoNotShareWeights)
{
  // The shape is a fork with two prongs at a distance of 1/20. The prongs are connected only at
  // their base. A cube of the lattice has the size 1/3.
  TriangleMesh fork =
    test::join(TriangleMesh{ test::tet_box(32, 4, 4, Vec3::Zero(), Vec3(4, 0.5, 0.5)).points,
                 boundary_triangles(test::tet_box(32, 4, 4).tets) },
      TriangleMesh{ test::tet_box(32, 4, 4, Vec3(0, 0.55, 0), Vec3(4, 1.05, 0.5)).points,
        boundary_triangles(test::tet_box(32, 4, 4).tets) });
  fork = test::join(fork,
    TriangleMesh{ test::tet_box(4, 8, 4, Vec3(-0.5, -0.01, -0.01), Vec3(0.1, 1.06, 0.51)).points,
      boundary_triangles(test::tet_box(4, 8, 4).tets) });
  const Handles handles{ test::point_handle("base", { -0.3, 0.5, 0.25 }),
    test::point_handle("a", { 3.8, 0.25, 0.25 }), test::point_handle("b", { 3.8, 0.8, 0.25 }) };
  SurfaceWeights result;
  const Status status =
    solve_surface_weights(fork, handles, options_for(WeightsDomain::embedding, 13), result);
  ASSERT_TRUE(status.usable()) << status.message;
  for (Index v = 0; v < fork.points.rows(); ++v)
  {
    const Vec3 p = fork.points.row(v);
    if (p[0] > 3.0)
    {
      const bool of_a = p[1] < 0.52;
      EXPECT_GT(result.weights(v, of_a ? 1 : 2), 0.9) << p.transpose();
      EXPECT_LT(result.weights(v, of_a ? 2 : 1), 0.05) << p.transpose();
    }
  }
}

TEST(SurfaceWeights, BonesInPartsThatShareTetsFindTheirOwn)
{
  // The lattice is so coarse that two slabs are in the same tets. Each slab has its own bone.
  const TriangleMesh below{ test::tet_box(16, 16, 1, Vec3::Zero(), Vec3(4, 4, 0.1)).points,
    boundary_triangles(test::tet_box(16, 16, 1).tets) };
  const TriangleMesh slabs = test::join(below, test::translated(below, Vec3(0, 0, 0.15)));
  SurfaceWeights result;
  const Status status = solve_surface_weights(slabs,
    { test::bone_handle("low", { 0.5, 2, 0.05 }, { 3.5, 2, 0.05 }),
      test::bone_handle("high", { 0.5, 2, 0.2 }, { 3.5, 2, 0.2 }) },
    options_for(WeightsDomain::embedding, 8), result);
  ASSERT_TRUE(status.usable()) << status.message;
  const Index half = below.points.rows();
  EXPECT_GT(result.weights.col(0).head(half).minCoeff(), 1.0 - 1e-6);
  EXPECT_GT(result.weights.col(1).tail(half).minCoeff(), 1.0 - 1e-6);
}

TEST(SurfaceWeights, APartWithoutAHandleFollowsTheHandleNearestToItsSurface)
{
  // A knob is between two bars, each of which has one handle. The knob is 3 % nearer to the right
  // bar's handle. The lattices of this test are too coarse to resolve this difference.
  const auto box = [](const Vec3& lower, const Vec3& upper)
  {
    const TetMesh tets = test::tet_box(4, 4, 4, lower, upper);
    return TriangleMesh{ tets.points, boundary_triangles(tets.tets) };
  };
  const TriangleMesh bars =
    test::join(box(Vec3(-3, -1, -1), Vec3(-2, 1, 1)), box(Vec3(2, -1, -1), Vec3(3, 1, 1)));
  const Vec3 center(0.03, 0.0, 0.0);
  const Vec3 half = Vec3::Constant(0.05);
  const TriangleMesh shape = test::join(bars, box(center - half, center + half));
  const Handles handles{ test::point_handle("left", { -2.5, 0, 0 }),
    test::point_handle("right", { 2.5, 0, 0 }) };
  for (const Index resolution : { 6, 7, 9, 13, 17 })
  {
    SurfaceWeightsOptions options = options_for(WeightsDomain::embedding, resolution);
    options.check_resolution = false;
    SurfaceWeights result;
    const Status status = solve_surface_weights(shape, handles, options, result);
    ASSERT_TRUE(status.ok()) << status.message;
    for (Index v = bars.points.rows(); v < shape.points.rows(); ++v)
    {
      EXPECT_GT(result.weights(v, 1), 0.99) << resolution;
    }
  }
}

TEST(SurfaceWeights, APartWithoutAHandleFollowsWhatItTouches)
{
  // A bar has a left and a right handle. A knob is 0.004 above the bar. The handle nearest to the
  // knob is the left one. A second bar has another handle. A seat spans the gap between the two
  // bars. The knob and the seat have no handles.
  const auto box = [](int n, const Vec3& lower, const Vec3& upper)
  {
    const TetMesh tets = test::tet_box(n, 4, 4, lower, upper);
    return TriangleMesh{ tets.points, boundary_triangles(tets.tets) };
  };
  const TriangleMesh bar = box(32, Vec3(0, 0, 0), Vec3(4, 0.5, 0.5));
  TriangleMesh shape = test::join(bar, box(4, Vec3(1.4, 0.1, 0.504), Vec3(1.7, 0.4, 0.8)));
  const Index end_of_knob = shape.points.rows();
  shape = test::join(shape, box(4, Vec3(3.5, 0.3, -0.204), Vec3(3.9, 1.9, -0.004)));
  const Index end_of_seat = shape.points.rows();
  shape = test::join(shape, box(32, Vec3(0, 1.5, 0), Vec3(4, 2.0, 0.5)));
  const Handles handles{ test::point_handle("left", { 0.2, 0.25, 0.25 }),
    test::point_handle("right", { 3.0, 0.25, 0.25 }),
    test::point_handle("far", { 1, 1.75, 0.25 }) };
  for (const Index resolution : { 12, 20, 30 })
  {
    SurfaceWeightsOptions options = options_for(WeightsDomain::embedding, resolution);
    options.check_resolution = false;
    SurfaceWeights result;
    const Status status = solve_surface_weights(shape, handles, options, result);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_THAT(status.warnings, testing::Contains(HasSubstr("2 connected parts have no handle")));
    EXPECT_EQ(status.report.number("counts.linked_parts", 0.0), 2.0);
    EXPECT_EQ(status.report.number("counts.components_without_handle", 0.0), 0.0);
    expect_weights(result.weights, shape.points.rows(), 3);
    for (Index v = bar.points.rows(); v < end_of_knob; ++v)
    {
      const Vec3 p = shape.points.row(v);
      // Find the bar's vertex directly below the knob's vertex v.
      double nearest = 1e300;
      Index below = 0;
      for (Index u = 0; u < bar.points.rows(); ++u)
      {
        const double d = (bar.points.row(u).transpose() - Vec3(p[0], p[1], 0.5)).norm();
        below = d < nearest ? u : below;
        nearest = std::min(nearest, d);
      }
      EXPECT_LT((result.weights.row(v) - result.weights.row(below)).cwiseAbs().maxCoeff(), 0.15)
        << p.transpose() << " at " << resolution;
    }
    for (Index v = end_of_knob; v < end_of_seat; ++v)
    {
      const double y = shape.points(v, 1);
      if (y < 0.5 || y > 1.5) // near a bar, the seat has the weights of the bar
      {
        EXPECT_GT(result.weights(v, y < 0.5 ? 1 : 2), 0.6) << y << " at " << resolution;
      }
    }
  }
}

TEST(SurfaceWeights, PartsAreConnectedAtOpeningsThatOtherPartsCover)
{
  // A knob without a bottom stands on a plate, and a flat ridge without a bottom stands on the
  // knob. The winding number in the ridge is below 0.5, because the knob is open. The handle of the
  // ridge must still control the knob, as if all parts were closed and connected.
  const auto part = [](const Vec3& lower, const Vec3& upper, bool is_open)
  {
    const TetMesh tets = test::tet_box(8, 8, 4, lower, upper);
    TriangleMesh result{ tets.points, boundary_triangles(tets.tets) };
    Index kept = 0;
    for (Index f = 0; f < result.triangles.rows(); ++f)
    {
      const Eigen::RowVector3<Index> triangle = result.triangles.row(f);
      double highest = lower[2];
      for (int k = 0; k < 3; ++k)
      {
        highest = std::max(highest, result.points(triangle[k], 2));
      }
      if (!is_open || highest > lower[2])
      {
        result.triangles.row(kept++) = triangle;
      }
    }
    result.triangles.conservativeResize(kept, 3);
    return result;
  };
  const TriangleMesh plate = part(Vec3(-4, -4, 0), Vec3(4, 4, 0.75), false);
  const TriangleMesh knob = part(Vec3(-1.75, -1.75, 0.75), Vec3(1.75, 1.75, 1.6), true);
  const Index end_of_plate = plate.points.rows();
  const Index end_of_knob = end_of_plate + knob.points.rows();
  const TriangleMesh shape =
    test::join(test::join(plate, knob), part(Vec3(-0.3, -1.5, 1.6), Vec3(0.3, 1.5, 1.73), true));
  const Handles handles{ test::point_handle("a", { -4, -4, 0 }),
    test::point_handle("b", { 4, 4, 0 }), test::point_handle("ridge", { 0.3, 1.5, 1.73 }) };
  for (const Index resolution : { 12, 20, 30 })
  {
    SurfaceWeightsOptions options = options_for(WeightsDomain::embedding, resolution);
    options.check_resolution = false;
    SurfaceWeights result;
    const Status status = solve_surface_weights(shape, handles, options, result);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_EQ(status.report.number("counts.covered_openings", 0.0), 2.0);
    EXPECT_GT(status.report.number("counts.links", 0.0), 8.0);
    EXPECT_EQ(status.report.number("counts.tet_components", 0.0), 1.0);
    EXPECT_THAT(status.warnings, testing::Not(testing::Contains(HasSubstr("linked"))));
    expect_weights(result.weights, shape.points.rows(), 3);
    EXPECT_GT(result.weights.col(2).segment(end_of_plate, knob.points.rows()).mean(), 0.5)
      << resolution;
    EXPECT_GT(result.weights.col(2).tail(shape.points.rows() - end_of_knob).minCoeff(), 0.5)
      << resolution;
  }
}

TEST(SurfaceWeights, CarriesSmoothFunctionsBetterThanTetsDo)
{
  const TriangleMesh ball = test::sphere(4);
  ExecutionContext context;
  const WindingNumber winding(ball.points, ball.triangles);
  EmbeddingTets lattice;
  EmbeddingOptions options;
  options.resolution = 8;
  ASSERT_TRUE(embed_surface(context, ball.points, ball.triangles, winding, options, lattice).ok());
  const SimplexLocator surface(ball.points, ball.triangles);
  const EmbeddedSurface embedded(
    ball.points, ball.triangles, surface, lattice.mesh, lattice.binding);
  HandleInsertion mesh;
  ASSERT_TRUE(insert_handles(context, embedded.domain(lattice.inside_fractions),
    { test::point_handle("p", Vec3::Zero()) }, {}, mesh)
                .ok());
  const auto f = [](const Vec3& p) { return 0.5 + 0.4 * std::sin(2.0 * p[0] + p[1]); };
  Weights values(mesh.domain.points.rows(), 2);
  for (Index v = 0; v < values.rows(); ++v)
  {
    values.row(v) << f(mesh.domain.points.row(v)), 0.25;
  }
  Weights transferred;
  ASSERT_TRUE(embedded
                .transfer_values(context, mesh, { test::point_handle("p", Vec3::Zero()) }, values,
                  EmbeddedSurface::Smoothness::smoothed, transferred)
                .ok());
  double linear = 0.0, smooth = 0.0;
  for (Index i = 0; i < ball.points.rows(); ++i)
  {
    const double exact = f(ball.points.row(i));
    double by_tet = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      by_tet += lattice.binding.coordinates(i, k) *
        f(lattice.mesh.points.row(lattice.mesh.tets(lattice.binding.tets[i], k)));
    }
    linear += (by_tet - exact) * (by_tet - exact);
    smooth += (transferred(i, 0) - exact) * (transferred(i, 0) - exact);
    EXPECT_NEAR(transferred(i, 1), 0.25, 1e-9);
  }
  EXPECT_LT(smooth, 0.25 * linear) << "half the error of linear interpolation, at most";
}

TEST_F(SurfaceWeightsInTets, AutomaticallyChoosesTheDomain)
{
  const Handles handles = three_along();
  SurfaceWeights result;
  Status status = solve_surface_weights(long_box(), handles, {}, result);
  EXPECT_EQ(result.domain, WeightsDomain::volume);
  EXPECT_EQ(
    status.report.text("domain_reason"), "the surface is closed and its tets are well shaped");

  const TriangleMesh flat = test::grid(16, 4, 4.0, 1.0);
  status = solve_surface_weights(flat, { handles[0], handles[1] }, {}, result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(result.domain, WeightsDomain::surface);
  expect_weights(result.weights, flat.points.rows(), 2);

  TriangleMesh sheet = flat;
  sheet.points.col(2) = 1e-2 * sheet.points.col(0).array().square();
  status = solve_surface_weights(sheet, { handles[0], handles[1] }, {}, result);
  ASSERT_TRUE(status.usable()) << status.message;
  EXPECT_EQ(result.domain, WeightsDomain::embedding);
  EXPECT_EQ(status.report.text("domain_reason"), "the surface is not closed");
  expect_weights(result.weights, sheet.points.rows(), 2);

  status = solve_surface_weights(
    sheet, { handles[0], handles[1] }, options_for(WeightsDomain::volume), result);
  // The status may also be a failure, if the tets do not fill enough of the region where the
  // sheet's winding number is high.
  if (status.usable())
  {
    expect_weights(result.weights, sheet.points.rows(), 2);
  }

  const TriangleMesh dense = test::sphere(5, 2.0, Vec3(2, 0, 0));
  ASSERT_GT(dense.triangles.rows(), 20000);
  status = solve_surface_weights(dense, handles, {}, result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(result.domain, WeightsDomain::embedding);
  EXPECT_EQ(status.report.text("domain_reason"), "the surface has many triangles");
}

TEST_F(SurfaceWeightsInTets, TheEmbeddingTakesOverWhereTheVolumeFails)
{
  const TriangleMesh box = long_box();
  for (const Status& failure : { Status::failure(StatusCode::not_converged, "it stalled"),
         Status::invalid_input("the matrix is not positive definite") })
  {
    const WeightsMethod fails_in_volumes =
      [&](ExecutionContext& context, const WeightsProblem& problem, WeightsResult& result)
    {
      const bool lattice = problem.mesh.domain.inside_fractions.size() > 0;
      const Status status = bounded_method(context, problem, result);
      return lattice ? status : failure;
    };
    const auto run = [&](WeightsDomain domain, SurfaceWeights& result)
    {
      ExecutionContext context;
      return surface_weights(context, box.points, box.triangles, {}, three_along(),
        options_for(domain), {}, fails_in_volumes, result);
    };
    SurfaceWeights result;
    const Status status = run(WeightsDomain::automatic, result);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_EQ(result.domain, WeightsDomain::embedding);
    expect_weights(result.weights, box.points.rows(), 3);
    EXPECT_EQ(status.report.text("domain"), "embedding");
    EXPECT_EQ(status.report.text("domain_fallback.from"), "volume");
    EXPECT_EQ(status.report.text("domain_fallback.status"), to_string(failure.code));
    EXPECT_EQ(status.report.text("domain_fallback.message"), failure.message);
    ASSERT_EQ(status.warnings.size(), 1u);
    EXPECT_THAT(status.warnings.front(), HasSubstr(failure.message));
    for (const WeightsColumn& column : result.solved.columns)
    {
      EXPECT_LE(column.certificate.relative_gap, 1e-6);
    }

    // An explicitly requested domain is not replaced by another one.
    EXPECT_EQ(run(WeightsDomain::volume, result).code, failure.code);
  }
}

TEST_F(SurfaceWeightsInTets, ACoarserLatticeServesWhereTheFinerOneDoesNotConverge)
{
  const TriangleMesh box = long_box();
  ExecutionContext context;
  SurfaceWeights result;
  int calls = 0;
  const Status status = surface_weights(
    context, box.points, box.triangles, {}, three_along(), options_for(WeightsDomain::embedding),
    {},
    [&](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& weights)
    {
      Status solved = bounded_method(method_context, problem, weights);
      solved.code = ++calls == 2 ? StatusCode::not_converged : solved.code;
      return solved;
    },
    result);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(calls, 2);
  EXPECT_LT(status.report.number("embedding.resolution", 0.0),
    status.report.number("guard.resolution", 0.0));
}

TEST(SurfaceWeights, PreviewComesFirstAndItsDifferenceIsReported)
{
  const TriangleMesh mesh = long_box();
  SurfaceWeightsOptions options = options_for(WeightsDomain::embedding, 24);
  Weights preview;
  int calls = 0;
  bool solved_before = false;
  bool solved = false;
  options.preview = [&](const Weights& weights)
  {
    preview = weights;
    ++calls;
    solved_before = solved;
  };
  ExecutionContext context;
  SurfaceWeights result;
  const Status status = surface_weights(
    context, mesh.points, mesh.triangles, {}, three_along(), options, {},
    [&](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& weights)
    {
      solved = true;
      return bounded_method(method_context, problem, weights);
    },
    result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(calls, 1);
  EXPECT_FALSE(solved_before);
  expect_weights(preview, mesh.points.rows(), 3);
  EXPECT_EQ(status.report.number("preview.max_difference", -1.0),
    (preview - result.weights).cwiseAbs().maxCoeff());
  EXPECT_LT(rms(preview, result.weights), 0.05);
}

TEST(SurfaceWeights, RawOnesAreCarriedOnlyWhenAskedForAndChangeNothing)
{
  const TriangleMesh mesh = long_box();
  SurfaceWeightsOptions options = options_for(WeightsDomain::embedding);
  options.check_resolution = false;
  SurfaceWeights without, with;
  ASSERT_TRUE(solve_surface_weights(mesh, three_along(), options, without).usable());
  options.keep_raw = true;
  ASSERT_TRUE(solve_surface_weights(mesh, three_along(), options, with).usable());
  EXPECT_EQ(without.raw.cols(), 0);
  EXPECT_EQ(with.weights, without.weights);
  ASSERT_EQ(with.raw.rows(), mesh.points.rows());
  ASSERT_EQ(with.raw.cols(), 3);
  // Each column is solved separately within bounds, so rows sum to 1 only approximately.
  const Eigen::VectorXd sums = with.raw.rowwise().sum();
  EXPECT_GT((sums.array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_LT((sums.array() - 1.0).abs().maxCoeff(), 0.5);
  EXPECT_LT(rms(sums.cwiseInverse().asDiagonal() * with.raw, with.weights), 1e-3);
}

TEST(SurfaceWeights, AreTheSameBitsOnAnyNumberOfThreads)
{
  SurfaceWeights one, many;
  ASSERT_TRUE(solve_surface_weights(
    long_box(), three_along(), options_for(WeightsDomain::embedding, 16), one, 1)
                .usable());
  ASSERT_TRUE(solve_surface_weights(
    long_box(), three_along(), options_for(WeightsDomain::embedding, 16), many, 4)
                .usable());
  EXPECT_TRUE((one.weights.array() == many.weights.array()).all());
}

TEST(SurfaceWeights, PointsOfTheSurfaceThatAreHandlesHaveTheirRows)
{
  const TriangleMesh mesh = test::sphere(3);
  Handles handles;
  for (const Index v : { 0, 77, 201, 333, 512, 640 })
  {
    handles.push_back(test::point_handle("h" + std::to_string(v), mesh.points.row(v)));
  }
  SurfaceWeights result;
  ASSERT_TRUE(
    solve_surface_weights(mesh, handles, options_for(WeightsDomain::embedding, 14), result)
      .usable());
  Index j = 0;
  for (const Index v : { 0, 77, 201, 333, 512, 640 })
  {
    EXPECT_NEAR(result.weights(v, j++), 1.0, 1e-12);
    EXPECT_NEAR(result.weights.row(v).sum(), 1.0, 1e-12);
  }
}

TEST(SurfaceWeights, UnboundedMethodsAreNotClamped)
{
  ExecutionContext context;
  SurfaceWeights result;
  const TriangleMesh mesh = long_box();
  const Handles handles{ test::point_handle("left", { 0.1, 0.5, 0.5 }),
    test::point_handle("middle", { 2.0, 0.5, 0.5 }),
    test::point_handle("right", { 3.9, 0.5, 0.5 }) };
  SurfaceWeightsOptions options = options_for(WeightsDomain::embedding, 24);
  options.check_resolution = false;
  const Status status = surface_weights(
    context, mesh.points, mesh.triangles, {}, handles, options, {},
    [](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& weights)
    { return biharmonic_weights(method_context, problem, {}, weights); },
    result);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_LT(result.weights.col(0).minCoeff(), -0.05) << "-1/9 on a thin bar";
  EXPECT_EQ(status.report.find("guard.resolution"), nullptr);
}

TEST(SurfaceWeights, RefusesWhatItCannotUse)
{
  SurfaceWeights result;
  const TriangleMesh mesh = test::sphere(2);
  const Handles handles{ test::point_handle("p", { 0, 0, 0.5 }) };
  EXPECT_THAT(
    solve_surface_weights(mesh, handles, options_for(WeightsDomain::embedding, 3), result).message,
    HasSubstr("between 6 and 1000"));
  EXPECT_EQ(solve_surface_weights(mesh, {}, {}, result).code, StatusCode::invalid_input);
  ExecutionContext context;
  const std::vector<Index> regions(static_cast<std::size_t>(mesh.points.rows()), 1);
  Status status =
    surface_weights(context, mesh.points, mesh.triangles, regions, { test::region_handle("r", 1) },
      options_for(WeightsDomain::embedding), {}, bounded_method, result);
  EXPECT_THAT(status.message, HasSubstr("regions need tets"));
  status = surface_weights(
    context, mesh.points, mesh.triangles, { 1, 2 }, handles, {}, {}, bounded_method, result);
  EXPECT_THAT(status.message, HasSubstr("2 region labels"));
  SurfaceWeightsOptions canceled = options_for(WeightsDomain::embedding);
  ExecutionContext stopped;
  stopped.request_cancel();
  EXPECT_EQ(surface_weights(stopped, mesh.points, mesh.triangles, {}, handles, canceled, {},
              bounded_method, result)
              .code,
    StatusCode::canceled);
}
