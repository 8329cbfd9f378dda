// Bounded biharmonic and monotone weights: closed forms in one dimension, published values on the
// square and the slotted square, and invariance under units, rotation, threads and domains.
#include "weights/bounded_biharmonic_weights.h"
#include "weights/monotone_weights.h"
#include "weights/unconstrained_weights.h"
#include "weights/weight_methods.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <map>

using namespace bindpose;
using test::bounded;
using test::problem_of;

namespace
{
WeightsResult monotone(const WeightsProblem& problem, int order = 2)
{
  ExecutionContext context;
  WeightsOptions options;
  options.order = order;
  WeightsResult result;
  const Status status = monotone_weights(context, problem, options, result);
  EXPECT_TRUE(status.ok()) << status.message;
  return result;
}

WeightsResult unconstrained(const WeightsProblem& problem, int order)
{
  ExecutionContext context;
  const WeightsKernel kernels[] = { harmonic_weights, biharmonic_weights, triharmonic_weights };
  WeightsResult result;
  const Status status = kernels[order - 1](context, problem, {}, result);
  EXPECT_TRUE(status.ok()) << status.message;
  return result;
}

/// Expect the properties of every bounded result: bounds, row sums of 1, constrained values, and a
/// certificate.
void expect_certified(
  const WeightsProblem& problem, const WeightsResult& result, double tolerance = 1e-6)
{
  EXPECT_GE(result.raw.minCoeff(), 0.0);
  EXPECT_LE(result.raw.maxCoeff(), 1.0);
  EXPECT_GE(result.weights.minCoeff(), 0.0);
  EXPECT_LE(result.weights.maxCoeff(), 1.0);
  for (Index v = 0; v < result.weights.rows(); ++v)
  {
    EXPECT_NEAR(result.weights.row(v).sum(), 1.0, 1e-12);
  }
  const HandleConstraints& constraints = problem.constraints;
  for (std::size_t i = 0; i < constraints.vertices.size(); ++i)
  {
    EXPECT_LE(
      (result.weights.row(constraints.vertices[i]) - constraints.values.row(static_cast<Index>(i)))
        .cwiseAbs()
        .maxCoeff(),
      1e-12);
  }
  for (Index j = 0; j < result.weights.cols(); ++j)
  {
    EXPECT_EQ(result.raw.col(j).maxCoeff(), 1.0);
    if (result.weights.cols() > 1)
    {
      EXPECT_EQ(result.raw.col(j).minCoeff(), 0.0);
    }
    EXPECT_LE(result.columns[j].certificate.relative_gap, tolerance);
    EXPECT_LE(result.columns[j].certificate.kkt_residual, tolerance);
  }
  EXPECT_EQ(result.analyses, 1);
}

/// Return the integral of (d^2 w / dx^2)^2 on a bar of length 1 and width 1. The energy in the
/// certificate is 1/2 w^T Q w for a bar of width 2 / n. The masses in Q are divided by the largest
/// mass.
double bar_energy(const Certificate& certificate, int n)
{
  const double width = 4.0 / n * 0.5; // two rows of squares of height 1/n
  const double largest_mass = 1.0 / (double(n) * n);
  return 2.0 * certificate.energy / largest_mass / width;
}
} // namespace

TEST(Weights, TwoEndsOfABarGiveTheSmoothstep)
{
  for (const int n : { 20, 40, 80 })
  {
    const test::Bar bar = test::bar(n, { 0.0, 1.0 });
    const WeightsProblem problem = problem_of(bar.domain, bar.handles, bar.region_ids);
    const WeightsResult result = bounded(problem);
    expect_certified(problem, result);
    const double bound = 3.1e-5 * (80.0 / n) * (80.0 / n);
    for (int i = 0; i <= n; ++i)
    {
      const double t = 1.0 - double(i) / n;
      EXPECT_NEAR(result.raw(i, 0), 3 * t * t - 2 * t * t * t, bound);
    }
    EXPECT_NEAR(result.weights(bar.vertex(0.75, n), 0), 0.15625, bound);
    EXPECT_NEAR(bar_energy(result.columns[0].certificate, n), 12.0, 12.0 * 2.0 / n / n);
  }
}

TEST(Weights, ThreePlacesOnABarShowWhatBoundsDo)
{
  const int n = 96;
  const test::Bar bar = test::bar(n, { 0.0, 0.5, 1.0 });
  const WeightsProblem problem = problem_of(bar.domain, bar.handles, bar.region_ids);
  const WeightsResult free = unconstrained(problem, 2);
  EXPECT_NEAR(free.columns[0].minimum, -1.0 / 9.0, 1e-4);
  EXPECT_NEAR(free.raw(bar.vertex(2.0 / 3.0, n), 0), -1.0 / 9.0, 1e-4);
  EXPECT_NEAR(bar_energy(free.columns[0].certificate, n), 60.0, 0.1);
  const WeightsResult result = bounded(problem, 2, 1e-9);
  expect_certified(problem, result, 1e-9);
  EXPECT_NEAR(bar_energy(result.columns[0].certificate, n), 96.0, 96.0 * 4.0 / n);
  for (int i = 0; i <= n; ++i)
  {
    const double t = 1.0 - 2.0 * i / n;
    const double exact = t > 0.0 ? 3 * t * t - 2 * t * t * t : 0.0;
    EXPECT_NEAR(result.raw(i, 0), exact, 0.0095);
    if (t < -0.05)
    {
      EXPECT_LT(result.raw(i, 0), 1e-5) << "zero on the far half";
    }
  }
  EXPECT_NEAR(unconstrained(problem, 3).columns[0].minimum, -0.1235, 1e-4);
}

TEST(Weights, TheTriharmonicBarIsAQuintic)
{
  const int n = 80;
  const test::Bar bar = test::bar(n, { 0.0, 1.0 });
  const WeightsProblem problem = problem_of(bar.domain, bar.handles, bar.region_ids);
  for (const WeightsResult& result : { unconstrained(problem, 3), bounded(problem, 3) })
  {
    for (int i = 0; i <= n; ++i)
    {
      const double s = 0.5 - double(i) / n;
      EXPECT_NEAR(result.raw(i, 0), 0.5 + 1.5625 * s - 2.5 * std::pow(s, 3) + std::pow(s, 5), 1e-4);
    }
    EXPECT_NEAR(result.raw(bar.vertex(0.75, n), 0), 0.1474609375, 1e-4);
  }
}

TEST(Weights, TriharmonicOnesAreCertifiedOnAFineSquare)
{
  // The condition number of the quadratic form grows with (1 / h)^6, where h is the edge length.
  const WeightsProblem problem =
    problem_of(test::to_domain(test::grid(60, 60)), test::five_points());
  const WeightsResult result = bounded(problem, 3);
  expect_certified(problem, result);
  for (const WeightsColumn& column : result.columns)
  {
    EXPECT_GE(column.extrema.size(), 3u) << "bounds are not enough";
    EXPECT_LE(column.extrema.size(), 13u);
  }
}

TEST(Weights, FivePointsOnASquareHaveTheKnownExtrema)
{
  const WeightsProblem problem =
    problem_of(test::to_domain(test::grid(40, 40)), test::five_points());
  EXPECT_TRUE(problem.mesh.inserted.empty());
  const WeightsResult free = unconstrained(problem, 2);
  const WeightsResult box = bounded(problem);
  const WeightsResult mono = monotone(problem);
  expect_certified(problem, box);
  expect_certified(problem, mono);
  const std::size_t known[5] = { 5, 5, 4, 5, 4 };
  double least = 0.0;
  double most = 0.0;
  for (int j = 0; j < 5; ++j)
  {
    EXPECT_EQ(free.columns[j].extrema.size(), known[j]);
    EXPECT_EQ(box.columns[j].extrema.size(), 0u);
    EXPECT_EQ(mono.columns[j].extrema.size(), 0u);
    least = std::min(least, free.columns[j].minimum);
    most = std::max(most, free.columns[j].maximum);
    const double e = free.columns[j].certificate.energy;
    EXPECT_LT(e, box.columns[j].certificate.energy);
    EXPECT_LT(box.columns[j].certificate.energy * (1.0 - 1e-6), mono.columns[j].certificate.energy);
    EXPECT_LE(mono.columns[j].certificate.order_violation, 0.0);
  }
  EXPECT_NEAR(least, -0.2674, 5e-5);
  EXPECT_NEAR(most, 1.3321, 5e-5);
  EXPECT_LT((free.raw.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-9);

  const WeightsResult third = unconstrained(problem, 3);
  EXPECT_NEAR(third.columns[2].minimum, -0.506, 5e-4);
  EXPECT_NEAR(third.columns[4].maximum, 1.456, 5e-4);
  const WeightsResult mono3 = monotone(problem, 3);
  expect_certified(problem, mono3);
  for (int j = 0; j < 5; ++j)
  {
    EXPECT_EQ(mono3.columns[j].extrema.size(), 0u);
    EXPECT_GT(bounded(problem, 3).columns[j].extrema.size(), 2u) << "bounds are not enough";
  }
}

TEST(Weights, EnergiesOnTheFineSquareAreTheKnownOnes)
{
  // Compute the weights of one of five handles on 160 x 160 cells. Energies are divided by the
  // energy of weights without bounds.
  const WeightsProblem problem =
    problem_of(test::to_domain(test::grid(160, 160)), test::five_points());
  ExecutionContext context;
  BoxQp solver(harmonic_energy(problem.stiffness, problem.mass, 2), problem.fixed, {});
  ASSERT_TRUE(solver.prepare(context).ok());
  std::vector<ColumnGroup> groups;
  ASSERT_TRUE(make_column_groups(problem, {}, false, groups).ok());
  ColumnGroup& group = groups.front();
  const double free =
    solver.solve_unbounded(context, { group.columns[2] }).at(0).certificate.energy;
  const BoxQpSolution box = solver.solve(context, group.columns[2]);
  MonotoneGuide guide;
  ASSERT_TRUE(monotone_guide(context, problem, group, {}, guide).ok());
  const BoxQpSolution mono = solver.solve(context, group.columns[2]);
  ASSERT_TRUE(box.status.ok() && mono.status.ok());
  // The test checks one handle. The energy ratios of the other handles equal the known values, too.
  // The only exception is the ratio for monotone weights of the last handle: 1.8634 instead of
  // 1.8643. The reason is the guide function that orders the vertices: it uses edge weights of at
  // least 1e-3. With cotangent weights, which are 0 on the diagonals of the grid, the ratio is
  // 1.8643.
  EXPECT_NEAR(box.certificate.energy / free, 1.2611, 2e-4);
  EXPECT_NEAR(mono.certificate.energy / free, 1.2645, 2e-4);
  EXPECT_EQ(solver.analyses(), 1) << "bounds and monotone rows share one analysis";
}

TEST(Weights, TheSlotIsGoneAroundNotAcross)
{
  // The domain is the unit square without the slot (.4, .6) x (.3, 1].
  const int n = 60;
  TriangleMesh square = test::grid(n, n);
  std::vector<Index> kept;
  for (Index t = 0; t < square.triangles.rows(); ++t)
  {
    Vec3 c = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      c += square.points.row(square.triangles(t, k)).transpose() / 3.0;
    }
    if (!(c.x() > 0.4 && c.x() < 0.6 && c.y() > 0.3))
    {
      kept.push_back(t);
    }
  }
  Triangles triangles(static_cast<Index>(kept.size()), 3);
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    triangles.row(t) = square.triangles.row(kept[t]);
  }
  square.triangles = triangles;
  const Vec3 a(0.3, 0.9, 0.0);
  const Vec3 b(0.8, 0.9, 0.0);
  const Index probe = 54 * (n + 1) + 39; // this vertex is at (.65, .9)
  const WeightsProblem problem = problem_of(test::to_domain(square), test::point_handles({ a, b }));
  EXPECT_GT(problem.status.report.number("counts.unreferenced_vertices", 0), 0);
  const WeightsResult free = unconstrained(problem, 2);
  const WeightsResult box = bounded(problem);
  const WeightsResult mono = monotone(problem);
  const double e = free.columns[0].certificate.energy;
  EXPECT_NEAR(box.columns[0].certificate.energy / e, 1.1605, 1e-4);
  EXPECT_NEAR(mono.columns[0].certificate.energy / e, 1.1640, 1e-4);
  EXPECT_NEAR(box.raw(probe, 0), 2.69e-3, 2e-5);
  EXPECT_NEAR(mono.raw(probe, 0), 2.63e-3, 2e-5);
  // Inverse-distance weights use distances across the slot, so the weight at the probe is much
  // larger.
  const double da = 1.0 / (0.35 * 0.35);
  const double db = 1.0 / (0.15 * 0.15);
  EXPECT_NEAR(da / (da + db), 0.1552, 1e-4);
}

TEST(Weights, VolumesWithHandlesAnywhereAreCertified)
{
  TetMesh box = test::tet_box(7, 5, 5, Vec3::Zero(), Vec3(1.4, 1, 1));
  test::Random random(8);
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    box.points.row(v) += 0.04 * random.in_box(-Vec3::Ones(), Vec3::Ones()).transpose();
  }
  const Handles handles{ test::point_handle("corner", Vec3(0.11, 0.13, 0.09)),
    test::bone_handle("upper", Vec3(0.3, 0.5, 0.5), Vec3(0.7, 0.52, 0.49)),
    test::bone_handle("lower", Vec3(0.7, 0.52, 0.49), Vec3(1.2, 0.4, 0.6)),
    test::point_handle("outside", Vec3(1.7, 0.9, 0.5)) };
  const WeightsProblem problem = problem_of(test::to_domain(box), handles);
  const WeightsResult result = bounded(problem);
  expect_certified(problem, result);
  EXPECT_EQ(problem.status.warnings.size(), 1u);
  const WeightsResult tight = bounded(problem, 2, 1e-9);
  expect_certified(problem, tight, 1e-9);
  EXPECT_LT((tight.raw - result.raw).cwiseAbs().maxCoeff(), 2e-5);
  const WeightsResult mono = monotone(problem);
  expect_certified(problem, mono);
  for (const WeightsColumn& column : mono.columns)
  {
    EXPECT_EQ(column.extrema.size(), 0u);
  }
  // Bounded weights are local: far away from their handle they are almost zero. Harmonic weights
  // are not local.
  const WeightsResult harmonic = unconstrained(problem, 1);
  EXPECT_GT((result.raw.array() < 1e-6).count(), 2 * (harmonic.raw.array().abs() < 1e-6).count());
  for (const int threads : { 1, 2 })
  {
    EXPECT_EQ(bounded(problem, 2, 1e-6, threads).weights, result.weights) << "bit by bit";
  }
}

TEST(Weights, UnitsAndRotationDoNotMatter)
{
  TetMesh box = test::tet_box(5, 4, 4);
  const std::vector<Vec3> positions{ Vec3(0.113, 0.217, 0.154), Vec3(0.92, 0.71, 0.83),
    Vec3(0.43, 0.88, 0.19) };
  const auto solve = [&](const Eigen::Matrix3d& map, const Vec3& shift)
  {
    TetMesh moved = box;
    moved.points = (box.points * map.transpose()).rowwise() + shift.transpose();
    std::vector<Vec3> moved_positions;
    for (const Vec3& place : positions)
    {
      moved_positions.emplace_back(map * place + shift);
    }
    return bounded(
      problem_of(test::to_domain(moved), test::point_handles(moved_positions)), 2, 1e-9)
      .weights;
  };
  const Weights rest = solve(Eigen::Matrix3d::Identity(), Vec3::Zero());
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (const double scale : { 1000.0, 1e-6, 1e6, 1.0 })
  {
    const Weights moved = solve(scale * turn, scale * Vec3(3, -2, 5));
    ASSERT_EQ(moved.rows(), rest.rows());
    EXPECT_LT((moved - rest).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(Weights, NeedlesAreStillCertified)
{
  TriangleMesh needles = test::grid(40, 40, 1.0, 0.01);
  const WeightsProblem problem = problem_of(test::to_domain(needles),
    test::point_handles({ Vec3(0.1, 0.002, 0), Vec3(0.5, 0.005, 0), Vec3(0.9, 0.007, 0) }));
  expect_certified(problem, bounded(problem));
  const WeightsResult mono = monotone(problem);
  expect_certified(problem, mono);
  for (const WeightsColumn& column : mono.columns)
  {
    EXPECT_EQ(column.extrema.size(), 0u);
  }
}

TEST(Weights, SliversOfAThousandthOfADegree)
{
  TetMesh box = test::tet_box(6, 6, 6);
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    // Move the middle layer down. Its distance from the layer below is then 1e-5 times the height
    // of a cell.
    box.points(v, 2) -= std::abs(box.points(v, 2) - 0.5) < 1e-9 ? (1.0 - 1e-5) / 6.0 : 0.0;
  }
  TriangleMesh square = test::grid(12, 12);
  for (Index v = 0; v < square.points.rows(); ++v)
  {
    square.points(v, 0) -= std::abs(square.points(v, 0) - 0.5) < 1e-9 ? (1.0 - 1e-5) / 12.0 : 0.0;
  }
  const std::vector<Vec3> positions{ Vec3(0.1, 0.2, 0), Vec3(0.7, 0.8, 0), Vec3(0.9, 0.1, 0) };
  for (const Domain& domain : { test::to_domain(box), test::to_domain(square) })
  {
    const WeightsProblem problem = problem_of(domain, test::point_handles(positions));
    expect_certified(problem, bounded(problem));
    expect_certified(problem, monotone(problem));
  }
}

TEST(Weights, TwoHundredHandles)
{
  test::Random random;
  std::vector<Vec3> positions;
  for (int i = 0; i < 200; ++i)
  {
    positions.emplace_back(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
  }
  const WeightsProblem problem =
    problem_of(test::to_domain(test::tet_box(8, 8, 8)), test::point_handles(positions));
  EXPECT_EQ(problem.fixed.size(), 200u);
  const WeightsResult result = bounded(problem);
  EXPECT_EQ(result.weights.cols(), 200);
  EXPECT_EQ(result.analyses, 1);
  expect_certified(problem, result);
}

TEST(Weights, HandlesAtEveryVertexAreTheIdentity)
{
  const TetMesh box = test::tet_box(2, 2, 2);
  std::vector<Vec3> positions;
  for (Index v = 0; v < box.points.rows(); ++v)
  {
    positions.emplace_back(box.points.row(v));
  }
  const WeightsProblem problem = problem_of(test::to_domain(box), test::point_handles(positions));
  ASSERT_EQ(problem.vertex_count(), box.points.rows()) << "none is inserted";
  for (const WeightsResult& result :
    { bounded(problem), monotone(problem), unconstrained(problem, 2) })
  {
    EXPECT_EQ(result.weights, Weights::Identity(27, 27));
    for (const WeightsColumn& column : result.columns)
    {
      EXPECT_LE(column.certificate.relative_gap, 1e-12);
      EXPECT_EQ(column.iterations, 0);
    }
  }
}

TEST(Weights, OneHandleIsOneEverywhere)
{
  const WeightsProblem problem = problem_of(
    test::to_domain(test::tet_box(3, 3, 3)), test::point_handles({ Vec3(0.3, 0.3, 0.35) }));
  for (const WeightsResult& result : { bounded(problem), monotone(problem) })
  {
    EXPECT_EQ(result.weights, Weights::Ones(problem.vertex_count(), 1));
    EXPECT_EQ(result.columns[0].certificate.energy, 0.0);
    EXPECT_EQ(result.columns[0].certificate.relative_gap, 0.0);
    EXPECT_EQ(result.columns[0].certificate.kkt_residual, 0.0);
    EXPECT_EQ(result.columns[0].extrema.size(), 0u);
  }
}

TEST(Weights, PartsAndStrayVerticesHaveDefinedRows)
{
  // The mesh has two squares with handles, one square without a handle, and an unused vertex.
  TriangleMesh mesh = test::join(test::grid(8, 8),
    test::join(test::translated(test::grid(8, 8), Vec3(2, 0, 0)),
      test::translated(test::grid(3, 3), Vec3(4, 0, 0))));
  const Index stray = mesh.points.rows();
  mesh.points.conservativeResize(stray + 1, 3);
  mesh.points.row(stray) << 50, 50, 50;
  const Handles handles =
    test::point_handles({ Vec3(0.2, 0.3, 0), Vec3(0.7, 0.8, 0), Vec3(2.4, 0.4, 0) });
  const WeightsProblem problem = problem_of(test::to_domain(mesh), handles);
  for (const WeightsResult& result :
    { bounded(problem), monotone(problem), unconstrained(problem, 2) })
  {
    EXPECT_TRUE(result.weights.allFinite());
    EXPECT_EQ(result.weights.row(stray), Eigen::RowVector3d::Zero());
    for (Index v = 81; v < stray; ++v)
    {
      EXPECT_EQ(result.weights.row(v), Eigen::RowVector3d(0, 0, 1));
    }
    EXPECT_LT(result.row_sum_error, 0.5);
  }
  EXPECT_EQ(problem.status.warnings.size(), 2u);
}

TEST(Weights, WithoutCholmodTheyAreTheSame)
{
  const WeightsProblem problem =
    problem_of(test::to_domain(test::grid(24, 24)), test::five_points());
  const WeightsResult usual = bounded(problem, 2, 1e-9);
  ExecutionContext context;
  WeightsOptions options;
  options.tolerance = 1e-9;
  options.solver.backend = SparseSolver::Backend::eigen;
  WeightsResult other;
  ASSERT_TRUE(bounded_biharmonic_weights(context, problem, options, other).ok());
  EXPECT_LT((usual.weights - other.weights).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Weights, BudgetCancelAndBadOptions)
{
  const WeightsProblem problem =
    problem_of(test::to_domain(test::grid(30, 30)), test::five_points());
  ExecutionContext context;
  WeightsOptions options;
  options.order = 3;
  options.maximum_iterations = 1;
  WeightsResult result;
  Status status = bounded_biharmonic_weights(context, problem, options, result);
  EXPECT_EQ(status.code, StatusCode::not_converged);
  EXPECT_NE(status.message.find("'p1'"), std::string::npos) << status.message;
  EXPECT_NE(status.message.find("relative gap"), std::string::npos);
  EXPECT_GT(status.report.number("relative_gap", 0.0), 1e-6);
  EXPECT_EQ(result.weights.rows(), problem.vertex_count());

  options = {};
  options.order = 4;
  EXPECT_EQ(
    bounded_biharmonic_weights(context, problem, options, result).code, StatusCode::invalid_input);
  WeightsOptions loose;
  loose.tolerance = 0.0;
  WeightsProblem other;
  EXPECT_EQ(make_weights_problem(
              context, test::to_domain(test::grid(3, 3)), {}, test::five_points(), loose, other)
              .code,
    StatusCode::invalid_input);

  // Request a cancel after `allowed_polls` checks for a cancel request. Bounded biharmonic weights
  // and monotone weights must return the status canceled.
  for (const int allowed_polls : { 0, 1, 3, 10, 40 })
  {
    int poll_count = 0;
    ExecutionContext stopped(nullptr, [&] { return ++poll_count > allowed_polls; });
    stopped.set_threads(1);
    options = {};
    EXPECT_EQ(
      bounded_biharmonic_weights(stopped, problem, options, result).code, StatusCode::canceled);
    poll_count = 0;
    ExecutionContext stopped_too(nullptr, [&] { return ++poll_count > allowed_polls; });
    stopped_too.set_threads(1);
    EXPECT_EQ(monotone_weights(stopped_too, problem, {}, result).code, StatusCode::canceled);
  }
}

TEST(Weights, AHelperJointWithoutAVertexHasNoWeights)
{
  // Two joints of a rig have the same nearest vertex. The helper joint, which is the first one, is
  // skipped.
  Handles joints{ test::point_handle("helper", Vec3(-0.2, -0.2, -0.2)),
    test::point_handle("hip", Vec3(-0.1, -0.1, -0.1)),
    test::bone_handle("spine", Vec3(0.5, 0.5, 0.1), Vec3(0.5, 0.5, 0.8)) };
  for (Handle& joint : joints)
  {
    joint.ownership = Ownership::optional;
  }
  const Handles without{ joints[1], joints[2] };
  const Domain box = test::to_domain(test::tet_box(4, 4, 4));
  const WeightsProblem problem = problem_of(box, joints);
  const WeightsProblem plain = problem_of(box, without);
  for (const bool is_monotone : { false, true })
  {
    const WeightsResult result = is_monotone ? monotone(problem) : bounded(problem);
    const WeightsResult expected = is_monotone ? monotone(plain) : bounded(plain);
    EXPECT_EQ(result.weights.col(0).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_LT((result.weights.rightCols(2) - expected.weights).cwiseAbs().maxCoeff(), 1e-5);
  }
  const WeightsResult harmonic = unconstrained(problem, 1);
  EXPECT_EQ(harmonic.weights.col(0).cwiseAbs().maxCoeff(), 0.0);

  // A handle that only controls a pose is skipped, even if there are vertices at its position. No
  // vertices are inserted for it.
  joints[0].head = joints[0].tail = Vec3(0.9, 0.1, 0.3);
  joints[0].ownership = Ownership::none;
  const WeightsProblem controlled = problem_of(box, joints);
  EXPECT_EQ(controlled.vertex_count(), plain.vertex_count());
  EXPECT_LT(
    (bounded(controlled).weights.rightCols(2) - bounded(plain).weights).cwiseAbs().maxCoeff(),
    1e-5);
}

TEST(Weights, JointsThatMoveNoVerticesAreRefused)
{
  Handles joints{ test::point_handle("root", Vec3(0.2, 0.2, 0.2)),
    test::point_handle("control", Vec3(0.7, 0.7, 0.7)) };
  for (Handle& joint : joints)
  {
    joint.ownership = Ownership::none;
  }
  WeightsProblem problem;
  ExecutionContext context;
  const Status status =
    make_weights_problem(context, test::to_domain(test::tet_box(4, 4, 4)), {}, joints, {}, problem);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_EQ(status.message,
    "no handle constrains a vertex because all handles are joints that move no vertices");
}

TEST(Weights, AVertexBelongsToOneHandleOfTheReport)
{
  const Handle bone = test::bone_handle("bone", Vec3(0.5, 0.5, 0.25), Vec3(0.5, 0.5, 0.75));
  const Domain box = test::to_domain(test::tet_box(4, 4, 4));
  const auto constrained_vertices = [&](const Handles& handles)
  {
    ExecutionContext context;
    WeightsResult result;
    const Status status = bounded_biharmonic_weights(context, problem_of(box, handles), {}, result);
    return std::get<std::vector<std::int64_t>>(
      *status.report.find("handles[].constrained_vertices"));
  };
  EXPECT_EQ(constrained_vertices({ bone }), std::vector<std::int64_t>{ 3 });
  // the point takes over the vertex in the middle of the bone
  const Handle point = test::point_handle("point", Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(constrained_vertices({ point, bone }), (std::vector<std::int64_t>{ 1, 2 }));
}

TEST(Weights, TheReportTellsWhatWasDone)
{
  const WeightsProblem problem = problem_of(test::to_domain(test::tet_box(4, 4, 4)),
    { test::point_handle("head", Vec3(0.1, 0.2, 0.9)),
      test::bone_handle("spine", Vec3(0.5, 0.5, 0.1), Vec3(0.5, 0.5, 0.8)) });
  ExecutionContext context;
  WeightsResult result;
  const Status status = bounded_biharmonic_weights(context, problem, {}, result);
  const Report& report = status.report;
  EXPECT_EQ(report.text("method"), "bounded-biharmonic");
  EXPECT_EQ(report.number("counts.vertices", 0), problem.vertex_count());
  EXPECT_GT(report.number("counts.tets", 0), 4 * 4 * 4 * 6);
  EXPECT_EQ(report.number("counts.handles", 0), 2);
  EXPECT_EQ(std::get<std::vector<std::string>>(*report.find("handles[].name")),
    (std::vector<std::string>{ "head", "spine" }));
  EXPECT_EQ(std::get<std::vector<std::string>>(*report.find("handles[].kind")),
    (std::vector<std::string>{ "point", "bone" }));
  const auto& constrained =
    std::get<std::vector<std::int64_t>>(*report.find("handles[].constrained_vertices"));
  EXPECT_EQ(constrained[0], 1);
  EXPECT_GE(constrained[1], 3);
  EXPECT_LE(report.number("relative_gap", 1.0), 1e-6);
  EXPECT_LE(report.number("kkt_residual", 1.0), 1e-6);
  EXPECT_EQ(report.number("bounds_violation", 1.0), 0.0);
  EXPECT_GT(report.number("iterations", 0.0), 2);
  EXPECT_GT(context.seconds().number("seconds.factor", 0.0), 0.0);
  EXPECT_GT(context.seconds().number("seconds.solve", 0.0), 0.0);
  EXPECT_GT(context.seconds().number("seconds.analyze", 0.0), 0.0);
}
