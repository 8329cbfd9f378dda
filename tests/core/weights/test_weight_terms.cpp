// Additional terms of bounded and monotone weights: bounds and pins, rigidity, rigid sets, mirror
// symmetry, few influences, and columns that sum to 1. The tests compare the weights with those of
// dense solvers that are not interior-point methods. They also check exact equalities and
// convergence rates, and recompute certificates from the quadratic form and the weights.
#include "weights/bounded_biharmonic_weights.h"
#include "weights/monotone_weights.h"
#include "weights/unconstrained_weights.h"
#include "weights/weight_methods.h"

#include "weights_shapes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>

using namespace bindpose;

namespace
{
struct SolvedWeights
{
  WeightsProblem problem;
  WeightsResult result;
  Status status;
  double energy() const
  {
    double sum = 0.0;
    const SparseMatrix q = this->problem.energy(2);
    for (Index j = 0; j < this->result.raw.cols(); ++j)
    {
      const Eigen::VectorXd w = this->result.raw.col(j);
      sum += 0.5 * w.dot(q * w);
    }
    return sum;
  }
};

SolvedWeights solve_with_terms(const Domain& domain, const Handles& handles,
  const WeightsOptions& options, const std::vector<Index>& regions = {},
  WeightsKernel kernel = bounded_biharmonic_weights)
{
  SolvedWeights solved;
  ExecutionContext context;
  solved.status = make_weights_problem(context, domain, regions, handles, options, solved.problem);
  if (solved.status.ok())
  {
    solved.status = kernel(context, solved.problem, options, solved.result);
  }
  return solved;
}

Handles three_points()
{
  return test::point_handles(
    { Vec3(0.25, 0.25, 0.0), Vec3(0.75, 0.25, 0.0), Vec3(0.5, 0.75, 0.0) });
}

Eigen::MatrixXd no_values(const Domain& domain, const Handles& handles)
{
  return Eigen::MatrixXd::Constant(
    domain.points.rows(), static_cast<Index>(handles.size()), std::nan(""));
}

/// Minimize 1/2 w'Qw within bounds by coordinate descent, which converges to the minimizer. A given
/// value is expressed by lower = upper.
Eigen::VectorXd coordinate_descent(const Eigen::MatrixXd& q, const Eigen::VectorXd& lower,
  const Eigen::VectorXd& upper, Eigen::VectorXd w)
{
  w = w.cwiseMax(lower).cwiseMin(upper);
  Eigen::VectorXd g = q * w;
  for (int sweep = 0; sweep < 200000; ++sweep)
  {
    double moved = 0.0;
    for (Index i = 0; i < w.size(); ++i)
    {
      const double next = std::clamp(w[i] - g[i] / q(i, i), lower[i], upper[i]);
      if (next != w[i])
      {
        g += (next - w[i]) * q.col(i);
        moved = std::max(moved, std::abs(next - w[i]));
        w[i] = next;
      }
    }
    if (moved < 1e-14)
    {
      break;
    }
  }
  return w;
}

/// Return the relative duality gap of one column, from its gradient, values and bounds. A given
/// value is expressed by lower = upper.
double relative_gap(const SparseMatrix& q, const Eigen::VectorXd& w, const Eigen::VectorXd& lower,
  const Eigen::VectorXd& upper)
{
  const Eigen::VectorXd g = q * w;
  double gap = 0.0;
  for (Index v = 0; v < w.size(); ++v)
  {
    gap +=
      lower[v] < upper[v] ? std::max(g[v] * (w[v] - lower[v]), -g[v] * (upper[v] - w[v])) : 0.0;
  }
  return gap / (0.5 * w.dot(g));
}

void fix_handles(
  const WeightsProblem& problem, Index j, Eigen::VectorXd& lower, Eigen::VectorXd& upper)
{
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
  {
    lower[problem.fixed[i]] = upper[problem.fixed[i]] =
      problem.fixed_values(static_cast<Index>(i), j);
  }
}

void expect_error(const Status& status, const std::vector<std::string>& words)
{
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  for (const std::string& word : words)
  {
    EXPECT_NE(status.message.find(word), std::string::npos) << status.message;
  }
}

/// Return the mirror image of each vertex of a square grid, with left and right exchanged. The
/// diagonals of the grid's cells are not symmetric.
std::vector<Index> mirrored(int n)
{
  std::vector<Index> mirror;
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i <= n; ++i)
    {
      mirror.push_back(j * (n + 1) + n - i);
    }
  }
  return mirror;
}
} // namespace

TEST(WeightTerms, BoundsAndPinsAreTheDenseMinimizer)
{
  const int n = 8;
  const Domain domain = test::to_domain(test::grid(n, n));
  const Handles handles = three_points();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  WeightsOptions options;
  options.tolerance = 1e-9;
  options.terms.lower = no_values(domain, handles);
  options.terms.upper = no_values(domain, handles);
  options.terms.pinned = no_values(domain, handles);
  const WeightsProblem plain = solve_with_terms(domain, handles, WeightsOptions()).problem;
  for (Index v = 0; v < domain.points.rows(); ++v)
  {
    if (plain.constraints.roles[v] != VertexRole::solved)
    {
      continue;
    }
    for (Index j = 0; j < 3; ++j)
    {
      const double kind = uniform(random);
      options.terms.lower(v, j) = kind < 0.2 ? -0.1 : kind < 0.3 ? 0.1 : std::nan("");
      options.terms.upper(v, j) = kind > 0.6 ? 0.2 + 0.5 * uniform(random) : std::nan("");
      options.terms.pinned(v, j) =
        kind > 0.55 && kind < 0.6 ? 0.25 * uniform(random) : std::nan("");
    }
  }
  const SolvedWeights solved = solve_with_terms(domain, handles, options);
  ASSERT_TRUE(solved.status.ok()) << solved.status.message;
  const Eigen::MatrixXd q = Eigen::MatrixXd(solved.problem.energy(2));
  for (Index j = 0; j < 3; ++j)
  {
    Eigen::VectorXd lower = Eigen::VectorXd::Zero(domain.points.rows());
    Eigen::VectorXd upper = Eigen::VectorXd::Ones(domain.points.rows());
    for (Index v = 0; v < domain.points.rows(); ++v)
    {
      const WeightTerms& terms = options.terms;
      lower[v] = std::isnan(terms.lower(v, j)) ? 0.0 : terms.lower(v, j);
      upper[v] = std::isnan(terms.upper(v, j)) ? 1.0 : terms.upper(v, j);
      if (!std::isnan(terms.pinned(v, j)))
      {
        lower[v] = upper[v] = terms.pinned(v, j);
        EXPECT_EQ(solved.result.raw(v, j), terms.pinned(v, j));
        EXPECT_EQ(solved.result.weights(v, j), terms.pinned(v, j)) << "scaling keeps pins";
      }
    }
    fix_handles(solved.problem, j, lower, upper);
    const Eigen::VectorXd w = solved.result.raw.col(j);
    EXPECT_LE((lower - w).maxCoeff(), 0.0);
    EXPECT_LE((w - upper).maxCoeff(), 0.0);
    const Eigen::VectorXd expected =
      coordinate_descent(q, lower, upper, Eigen::VectorXd::Constant(w.size(), 0.3));
    EXPECT_LE((w - expected).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_NEAR(
      0.5 * w.dot(q * w), 0.5 * expected.dot(q * expected), 1e-8 * expected.dot(q * expected));
    EXPECT_LE(relative_gap(solved.problem.energy(2), w, lower, upper), 2e-9);
    EXPECT_LE(solved.result.columns[j].certificate.relative_gap, 1e-9);
    EXPECT_LE(solved.result.columns[j].certificate.kkt_residual, 1e-9);
    EXPECT_LE(solved.result.columns[j].iterations, 40);
  }
  for (Index v = 0; v < domain.points.rows(); ++v)
  {
    EXPECT_NEAR(solved.result.weights.row(v).sum(), 1.0, 1e-12);
  }
}

TEST(WeightTerms, BoundsOfHandlesWidenTheBox)
{
  // Bounds that are wide enough have no effect.
  const Domain domain = test::to_domain(test::grid(20, 20));
  const Handles handles = test::five_points();
  WeightsOptions options;
  options.tolerance = 1e-9;
  options.terms.handle_bounds.resize(5, 2);
  options.terms.handle_bounds.col(0).setConstant(-3.0);
  options.terms.handle_bounds.col(1).setConstant(4.0);
  const SolvedWeights wide = solve_with_terms(domain, handles, options);
  ASSERT_TRUE(wide.status.ok()) << wide.status.message;
  ExecutionContext context;
  WeightsResult free;
  WeightsProblem plain = wide.problem;
  plain.terms = {};
  ASSERT_TRUE(biharmonic_weights(context, plain, WeightsOptions(), free).ok());
  EXPECT_LT(free.raw.minCoeff(), -0.01);
  EXPECT_LE((wide.result.raw - free.raw).cwiseAbs().maxCoeff(), 1e-6);
  // The weight of a single handle is 1 everywhere if no bound or pin prevents it.
  const Handles one(handles.begin(), handles.begin() + 1);
  WeightsOptions pinned;
  pinned.terms.pinned = no_values(domain, one);
  pinned.terms.pinned(400, 0) = 1.0;
  EXPECT_EQ(solve_with_terms(domain, one, pinned).result.raw.minCoeff(), 1.0);
}

TEST(WeightTerms, WhatContradictsIsNamed)
{
  const Domain domain = test::to_domain(test::grid(8, 8));
  const Handles handles = three_points(); // vertices 20, 24 and 58
  const auto with = [&](const auto& change)
  {
    WeightsOptions options;
    options.terms.lower = options.terms.upper = options.terms.pinned = no_values(domain, handles);
    change(options.terms);
    return solve_with_terms(domain, handles, options).status;
  };
  expect_error(with(
                 [](WeightTerms& terms)
                 {
                   terms.lower(31, 1) = 0.6;
                   terms.upper(31, 1) = 0.4;
                 }),
    { "'p2'", "vertex 31" });
  expect_error(with([](WeightTerms& terms) { terms.upper(20, 0) = 0.4; }), { "'p1'", "vertex 20" });
  expect_error(
    with([](WeightTerms& terms) { terms.pinned(24, 0) = 0.5; }), { "'p1'", "vertex 24", "'p2'" });
  expect_error(with(
                 [](WeightTerms& terms)
                 {
                   terms.pinned(31, 1) = 0.6;
                   terms.upper(31, 1) = 0.4;
                 }),
    { "'p2'", "vertex 31" });
  expect_error(with([](WeightTerms& terms) { terms.pinned.row(31) << 0.6, 0.6, std::nan(""); }),
    { "vertex 31", "more than 1" });
  expect_error(
    with([](WeightTerms& terms) { terms.pinned.row(31) << 0.2, 0.3, 0.4; }), { "vertex 31" });
  expect_error(
    with([](WeightTerms& terms) { terms.pinned(31, 0) = 1.0 / 0.0; }), { "'p1'", "vertex 31" });
  expect_error(with([](WeightTerms& terms) { terms.rigidity = Eigen::VectorXd::Constant(81, -1); }),
    { "rigidity", "vertex 0" });
  expect_error(with([](WeightTerms& terms) { terms.rigid_sets.assign(80, 1); }), { "80", "81" });
  expect_error(with(
                 [](WeightTerms& terms)
                 {
                   terms.rigid_sets.assign(81, 0);
                   terms.rigid_sets[20] = terms.rigid_sets[58] = 7;
                 }),
    { "rigid set 7", "'p1'", "'p3'" });
  expect_error(with(
                 [](WeightTerms& terms)
                 {
                   terms.mirror.assign(81, -1);
                   terms.mirror[3] = 5;
                 }),
    { "vertex 3", "vertex 5" });
  ExecutionContext context;
  WeightsResult result;
  WeightsOptions painted;
  painted.terms.rigidity = Eigen::VectorXd::Ones(81);
  const WeightsProblem problem = solve_with_terms(domain, handles, painted).problem;
  expect_error(biharmonic_weights(context, problem, {}, result), { "bounded and monotone" });
}

TEST(WeightTerms, GradientsFallWithRigidity)
{
  const int n = 60;
  const test::Bar bar = test::bar(n, { 0.0, 1.0 });
  std::vector<double> steepest;
  std::vector<double> painted = { 0.0, 0.1, 10.0, 100.0, 1000.0 };
  for (const double paint : painted)
  {
    WeightsOptions options;
    options.terms.rigidity = Eigen::VectorXd::Zero(bar.domain.points.rows());
    for (Index v = 0; v < bar.domain.points.rows(); ++v)
    {
      const double x = bar.domain.points(v, 0);
      options.terms.rigidity[v] = x > 0.45 && x < 0.75 ? paint : 0.0;
    }
    options.tolerance = 1e-9;
    const SolvedWeights solved = solve_with_terms(bar.domain, bar.handles, options, bar.region_ids);
    ASSERT_TRUE(solved.status.ok()) << solved.status.message;
    steepest.push_back(0.0);
    for (int i = 0; i < n; ++i)
    {
      if (i / double(n) > 0.5 && (i + 1) / double(n) < 0.7)
      {
        steepest.back() = std::max(
          steepest.back(), n * std::abs(solved.result.raw(i + 1, 0) - solved.result.raw(i, 0)));
      }
    }
  }
  EXPECT_NEAR(steepest[0], 1.5, 0.01) << "smoothstep";
  EXPECT_LT(steepest[1], 0.3) << "a tenth is felt";
  EXPECT_NEAR(steepest[2] / steepest[3], 10.0, 1.0);
  EXPECT_NEAR(steepest[3] / steepest[4], 10.0, 0.2);
}

TEST(WeightTerms, RigidityHasNoUnitAndHardlyDependsOnTheMesh)
{
  const auto weight_at_center = [](int n, double scale)
  {
    TriangleMesh mesh = test::grid(n, n);
    mesh.points *= scale;
    Handles handles = three_points();
    for (Handle& handle : handles)
    {
      handle.head *= scale;
      handle.tail *= scale;
    }
    WeightsOptions options;
    options.terms.rigidity.resize(mesh.points.rows());
    for (Index v = 0; v < mesh.points.rows(); ++v)
    {
      options.terms.rigidity[v] = (mesh.points.row(v) / scale).norm() > 0.7;
    }
    return solve_with_terms(test::to_domain(mesh), handles, options)
      .result.raw((n / 2) * (n + 1) + n / 2, 0);
  };
  EXPECT_NEAR(weight_at_center(20, 1.0), weight_at_center(20, 1000.0), 1e-7);
  EXPECT_NEAR(weight_at_center(20, 1.0), weight_at_center(40, 1.0), 0.03);
}

TEST(WeightTerms, RigidSetsAreOneUnknown)
{
  const int n = 20;
  const Domain domain = test::to_domain(test::grid(n, n));
  const Handles handles = test::five_points();
  WeightsOptions options;
  options.tolerance = 1e-9;
  const SolvedWeights free = solve_with_terms(domain, handles, options);
  options.terms.rigid_sets.assign(static_cast<std::size_t>(domain.points.rows()), 0);
  const Vec3 p4 = handles[3].head;
  for (Index v = 0; v < domain.points.rows(); ++v)
  {
    const Vec3 p = domain.points.row(v);
    options.terms.rigid_sets[v] = (p - Vec3(0.5, 0.2, 0)).norm() < 0.12 ? 3
      : (p - p4).norm() < 0.12                                          ? 8
                                                                        : 0;
  }
  const SolvedWeights solved = solve_with_terms(domain, handles, options);
  ASSERT_TRUE(solved.status.ok()) << solved.status.message;
  EXPECT_EQ(solved.result.analyses, 1);
  EXPECT_GT(solved.energy(), 1.01 * free.energy());
  const SparseMatrix q = solved.problem.energy(2);
  const std::vector<Index>& sets = solved.problem.terms.rigid_sets;
  for (Index j = 0; j < 5; ++j)
  {
    const Eigen::VectorXd w = solved.result.raw.col(j);
    const Eigen::VectorXd g = q * w;
    double total = 0.0; // gradient with respect to the common value of the rigid set
    double value = -1.0;
    double gap = 0.0;
    for (Index v = 0; v < w.size(); ++v)
    {
      if (sets[v] == 8)
      {
        EXPECT_EQ(w[v], j == 3 ? 1.0 : 0.0) << "the handle's own row";
      }
      else if (sets[v] == 3)
      {
        value = value < 0.0 ? w[v] : value;
        EXPECT_EQ(w[v], value);
        total += g[v];
      }
      else if (solved.problem.constraints.roles[v] == VertexRole::solved)
      {
        gap += std::max(g[v] * w[v], -g[v] * (1.0 - w[v]));
      }
    }
    gap += std::max(total * value, -total * (1.0 - value));
    // The certificate uses the smaller of two gaps (certificate.h). The test computes only the
    // first gap, which may exceed the tolerance 1e-9.
    EXPECT_LE(gap / (0.5 * w.dot(g)), 5e-8);
  }
  // A rigid set may contain vertices of a part that has no handle. The set then connects this part
  // to a part with handles.
  TriangleMesh two = test::grid(4, 4);
  const Index count = two.points.rows();
  Points points(2 * count, 3);
  points << two.points, two.points.rowwise() + Eigen::RowVector3d(0, 0, 1);
  Triangles triangles(2 * two.triangles.rows(), 3);
  triangles << two.triangles, two.triangles.array() + count;
  Domain parts;
  parts.points = points;
  parts.triangles = triangles;
  WeightsOptions joined;
  joined.terms.rigid_sets.assign(static_cast<std::size_t>(2 * count), 0);
  joined.terms.rigid_sets[12] = joined.terms.rigid_sets[12 + count] = 1;
  const SolvedWeights both = solve_with_terms(
    parts, test::point_handles({ Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 0, 0) }), joined);
  ASSERT_TRUE(both.status.ok()) << both.status.message;
  EXPECT_TRUE(both.status.warnings.empty());
  for (Index v = count; v < 2 * count; ++v)
  {
    EXPECT_LE(
      (both.result.weights.row(v) - both.result.weights.row(12)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(WeightTerms, MonotoneWeightsTakeThem)
{
  const Domain domain = test::to_domain(test::grid(20, 20));
  const Handles handles = test::five_points();
  WeightsOptions options;
  options.terms.rigid_sets.assign(static_cast<std::size_t>(domain.points.rows()), 0);
  options.terms.pinned = no_values(domain, handles);
  options.terms.upper = no_values(domain, handles);
  options.terms.rigidity = Eigen::VectorXd::Zero(domain.points.rows());
  for (Index v = 0; v < domain.points.rows(); ++v)
  {
    const Vec3 p = domain.points.row(v);
    options.terms.rigid_sets[v] = (p - Vec3(0.5, 0.2, 0)).norm() < 0.12;
    options.terms.rigidity[v] = p.y() > 0.8 ? 1.0 : 0.0;
  }
  const Index pin = 10 * 21 + 5;
  options.terms.pinned(pin, 0) = 0.3;
  options.terms.upper(3 * 21 + 9, 0) = 0.45;
  const SolvedWeights solved = solve_with_terms(domain, handles, options, {}, monotone_weights);
  ASSERT_TRUE(solved.status.ok()) << solved.status.message;
  EXPECT_EQ(solved.result.raw(pin, 0), 0.3);
  EXPECT_LE(solved.result.raw(3 * 21 + 9, 0), 0.45);
  for (Index j = 0; j < 5; ++j)
  {
    EXPECT_LE(solved.result.columns[j].certificate.relative_gap, 1e-6);
    EXPECT_LE(solved.result.columns[j].extrema.size(), j == 0 ? 1U : 0U) << "a pin can be one";
  }
  options.terms.upper(3 * 21 + 9, 0) = std::nan("");
  options.terms.lower = no_values(domain, handles);
  // Monotone weights increase along a path from vertex 0 to the handle. The lower bound 0.999 of
  // vertex 0 exceeds the upper bound 0.99 of the other vertices on this path.
  options.terms.lower(0, 0) = 0.999;
  options.terms.upper.col(0).setConstant(0.99);
  options.terms.upper(0, 0) = std::nan("");
  for (const Index v : solved.problem.fixed)
  {
    options.terms.upper(v, 0) = std::nan("");
  }
  expect_error(solve_with_terms(domain, handles, options, {}, monotone_weights).status,
    { "'p1'", "vertex", "monotone" });
}

TEST(WeightTerms, MirroredHandlesHaveMirroredWeights)
{
  const int n = 16;
  const Domain domain = test::to_domain(test::grid(n, n));
  Handles handles = test::point_handles(
    { Vec3(0.25, 0.25, 0), Vec3(0.75, 0.25, 0), Vec3(0.5, 0.75, 0), Vec3(0.125, 0.875, 0) });
  WeightsOptions options;
  options.tolerance = 1e-9;
  const SolvedWeights free = solve_with_terms(domain, handles, options);
  options.terms.mirror = mirrored(n);
  const SolvedWeights solved = solve_with_terms(domain, handles, options);
  ASSERT_TRUE(solved.status.ok()) << solved.status.message;
  double free_difference = 0.0;
  for (Index v = 0; v < domain.points.rows(); ++v)
  {
    const Index other = options.terms.mirror[v];
    EXPECT_EQ(solved.result.raw(v, 0), solved.result.raw(other, 1));
    EXPECT_EQ(solved.result.raw(v, 2), solved.result.raw(other, 2));
    free_difference =
      std::max(free_difference, std::abs(free.result.raw(v, 0) - free.result.raw(other, 1)));
    // The fourth handle has no mirror image, so its weights do not change.
    EXPECT_NEAR(solved.result.raw(v, 3), free.result.raw(v, 3), 1e-5);
  }
  EXPECT_GT(free_difference, 1e-3) << "the fourth handle and the diagonals are not symmetric";
  // The symmetry constraint cannot lower the minimum energy.
  const SparseMatrix q = solved.problem.energy(2);
  const auto energy = [&](const Eigen::VectorXd& a) { return 0.5 * a.dot(q * a); };
  const double pair = energy(solved.result.raw.col(0)) + energy(solved.result.raw.col(1));
  EXPECT_GE(pair, energy(free.result.raw.col(0)) + energy(free.result.raw.col(1)) - 1e-12);
  EXPECT_LE(solved.result.columns[0].certificate.relative_gap, 1e-9);
  EXPECT_NEAR(solved.result.columns[0].certificate.energy, pair, 1e-9 * pair);

  // A mirror plane must give the same result as the list of mirror images.
  WeightsOptions plane;
  plane.tolerance = 1e-9;
  plane.terms.mirror_origin = Vec3(0.5, 0, 0);
  plane.terms.mirror_normal = Vec3(2, 0, 0);
  const SolvedWeights by_plane = solve_with_terms(domain, handles, plane);
  EXPECT_EQ(by_plane.problem.terms.mirror, options.terms.mirror);
  EXPECT_EQ((by_plane.result.raw - solved.result.raw).cwiseAbs().maxCoeff(), 0.0);
}

TEST(WeightTerms, FewInfluences)
{
  const Domain domain = test::to_domain(test::grid(20, 20));
  const Handles handles = test::five_points();
  double last = 0.0;
  for (const int most : { 5, 4, 3, 2, 1 })
  {
    WeightsOptions options;
    options.maximum_influences = most;
    const SolvedWeights solved = solve_with_terms(domain, handles, options);
    ASSERT_TRUE(solved.status.ok()) << solved.status.message;
    for (Index v = 0; v < domain.points.rows(); ++v)
    {
      EXPECT_LE((solved.result.weights.row(v).array() > 0.0).count(), most);
      EXPECT_NEAR(solved.result.weights.row(v).sum(), 1.0, 1e-12);
    }
    EXPECT_GE(solved.energy(), (1.0 - 2e-6) * last) << "a smaller choice is a part of a larger one";
    last = solved.energy();
    EXPECT_EQ(solved.result.analyses, 1) << "the same analysis serves both rounds";
    const double capped = solved.status.report.number("counts.capped_vertices", 0.0);
    EXPECT_EQ(capped > 0.0, most < 5);
    EXPECT_EQ(solved.status.report.number("influences.largest_difference", 0.0) > 0.0, most < 5);
  }
}

TEST(WeightTerms, CoupledColumnsAreTheDenseMinimizer)
{
  const int n = 6;
  const Domain domain = test::to_domain(test::grid(n, n));
  const Handles handles =
    test::point_handles({ Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0), Vec3(0.5, 0.5, 0) });
  WeightsOptions options;
  options.tolerance = 1e-8;
  options.partition = PartitionOfUnity::coupled;
  const SolvedWeights solved = solve_with_terms(domain, handles, options);
  ASSERT_TRUE(solved.status.ok()) << solved.status.message;
  // Compute the reference by coordinate descent. A step moves weight from one column to another at
  // one vertex. Each sweep visits all vertices and all pairs of columns.
  const Eigen::MatrixXd q = Eigen::MatrixXd(solved.problem.energy(2));
  const Index count = domain.points.rows();
  Eigen::MatrixXd w = Eigen::MatrixXd::Constant(count, 4, 0.25);
  for (std::size_t i = 0; i < solved.problem.fixed.size(); ++i)
  {
    w.row(solved.problem.fixed[i]) = solved.problem.fixed_values.row(static_cast<Index>(i));
  }
  Eigen::MatrixXd g = q * w;
  for (int sweep = 0; sweep < 40000; ++sweep)
  {
    double moved = 0.0;
    for (Index v = 0; v < count; ++v)
    {
      if (solved.problem.constraints.roles[v] != VertexRole::solved)
      {
        continue;
      }
      for (Index a = 0; a < 4; ++a)
      {
        for (Index b = a + 1; b < 4; ++b)
        {
          const double step = std::clamp(-(g(v, a) - g(v, b)) / (2.0 * q(v, v)), -w(v, a), w(v, b));
          if (step != 0.0)
          {
            w(v, a) += step;
            w(v, b) -= step;
            g.col(a) += step * q.col(v);
            g.col(b) -= step * q.col(v);
            moved = std::max(moved, std::abs(step));
          }
        }
      }
    }
    if (moved < 1e-14)
    {
      break;
    }
  }
  const double energy = 0.5 * w.cwiseProduct(q * w).sum();
  EXPECT_NEAR(solved.energy(), energy, 1e-7 * energy);
  EXPECT_LE((solved.result.raw - w).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(WeightTerms, CoupledColumnsSumToOne)
{
  const Domain domain = test::to_domain(test::grid(30, 30));
  const Handles handles = test::five_points();
  WeightsOptions options;
  const SolvedWeights separate = solve_with_terms(domain, handles, options);
  options.partition = PartitionOfUnity::coupled;
  const SolvedWeights solved = solve_with_terms(domain, handles, options);
  ASSERT_TRUE(solved.status.ok()) << solved.status.message;
  const SparseMatrix q = solved.problem.energy(2);
  const Weights& w = solved.result.raw;
  EXPECT_GE(w.minCoeff(), 0.0);
  EXPECT_LE(solved.result.row_sum_error, 1e-12);
  EXPECT_GT(separate.result.row_sum_error, 0.01);
  EXPECT_LE((w - solved.result.weights).cwiseAbs().maxCoeff(), 1e-12);
  // Compute the second bound of the certificate (certificate.h) from w and the gradients g = Q w.
  // The constraint that a row of w sums to 1 has a multiplier. The bound is valid for any
  // multipliers; this test uses -(dot product of the row of w and the row of g). Let d be g plus
  // the multipliers, and let A be the block of Q for the free vertices. An entry of r equals the
  // entry of d if the Newton step w - d / diag(A) is between 0 and 1; otherwise it is 0. The
  // nonzero entries of r contribute 1/2 r' A^-1 r. Every other entry contributes its term of the
  // first bound.
  const Eigen::MatrixXd g = q * w;
  std::vector<Index> free;
  for (Index v = 0; v < w.rows(); ++v)
  {
    if (solved.problem.constraints.roles[v] == VertexRole::solved)
    {
      free.push_back(v);
    }
  }
  const auto count = static_cast<Index>(free.size());
  Eigen::MatrixXd a(count, count);
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(count, w.cols());
  double gap = 0.0;
  for (Index i = 0; i < count; ++i)
  {
    const double multiplier = -g.row(free[i]).dot(w.row(free[i]));
    for (Index k = 0; k < count; ++k)
    {
      a(i, k) = q.coeff(free[i], free[k]);
    }
    for (Index j = 0; j < w.cols(); ++j)
    {
      const double value = w(free[i], j);
      const double own = g(free[i], j) + multiplier;
      const double newton = value - own / a(i, i);
      r(i, j) = newton > 0.0 && newton < 1.0 ? own : 0.0;
      gap += r(i, j) != 0.0 ? 0.0 : std::max(own * value, -own * (1.0 - value));
    }
  }
  gap += 0.5 * r.cwiseProduct(a.llt().solve(r)).sum();
  const double normalized =
    0.5 * separate.result.weights.cwiseProduct(q * separate.result.weights).sum();
  EXPECT_LE(gap, 2e-6 * solved.energy());
  EXPECT_LE(solved.energy(), (1.0 + 1e-6) * normalized);
  EXPECT_GE(solved.energy(), (1.0 - 1e-6) * separate.energy()) << "one constraint more";
  const double largest = (solved.result.weights - separate.result.weights).cwiseAbs().maxCoeff();
  EXPECT_NEAR(solved.status.report.number("partition.largest_difference", 0.0), largest, 1e-12);
  EXPECT_GT(largest, 1e-3);
}

TEST(WeightTerms, CoupledIsTheSameForOneAndTwoHandles)
{
  const Domain domain = test::to_domain(test::grid(16, 16));
  for (const std::size_t count : { 1, 2 })
  {
    Handles handles = three_points();
    handles.resize(count);
    WeightsOptions options;
    options.tolerance = 1e-9;
    const SolvedWeights separate = solve_with_terms(domain, handles, options);
    options.partition = PartitionOfUnity::coupled;
    const SolvedWeights coupled = solve_with_terms(domain, handles, options);
    ASSERT_TRUE(coupled.status.ok()) << coupled.status.message;
    EXPECT_LE((coupled.result.weights - separate.result.weights).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(WeightTerms, CoupledKeepsPinsBoundsSetsAndInfluences)
{
  const Domain domain = test::to_domain(test::grid(16, 16));
  const Handles handles = test::five_points();
  WeightsOptions options;
  options.partition = PartitionOfUnity::coupled;
  options.maximum_influences = 3;
  options.terms.pinned = options.terms.upper = no_values(domain, handles);
  options.terms.rigid_sets.assign(static_cast<std::size_t>(domain.points.rows()), 0);
  options.terms.pinned(100, 1) = 0.4;
  options.terms.upper(8 * 17 + 4, 0) = 0.2;
  options.terms.rigid_sets[5] = options.terms.rigid_sets[6] = options.terms.rigid_sets[7] = 1;
  const SolvedWeights solved = solve_with_terms(domain, handles, options);
  ASSERT_TRUE(solved.status.ok()) << solved.status.message;
  EXPECT_EQ(solved.result.weights(100, 1), 0.4);
  EXPECT_LE(solved.result.weights(8 * 17 + 4, 0), 0.2 + 1e-15);
  EXPECT_LE(solved.result.row_sum_error, 1e-12);
  EXPECT_EQ((solved.result.raw.row(5) - solved.result.raw.row(7)).cwiseAbs().maxCoeff(), 0.0);
  for (Index v = 0; v < domain.points.rows(); ++v)
  {
    EXPECT_LE((solved.result.weights.row(v).array() > 0.0).count(), 3);
  }
  options.terms.upper.row(100).setConstant(0.1);
  options.terms.pinned(100, 1) = std::nan("");
  options.maximum_influences = 0;
  expect_error(solve_with_terms(domain, handles, options).status, { "vertex 100", "sum to one" });
  WeightsOptions monotone;
  monotone.partition = PartitionOfUnity::coupled;
  expect_error(
    solve_with_terms(domain, handles, monotone, {}, monotone_weights).status, { "coupled" });
}

TEST(WeightTerms, CoupledIsTheSameForAnyThreadsAndStopsWhenTold)
{
  const Domain domain = test::to_domain(test::grid(16, 16));
  const Handles handles = test::five_points();
  WeightsOptions options;
  options.partition = PartitionOfUnity::coupled;
  const WeightsProblem problem = solve_with_terms(domain, handles, options).problem;
  Weights first;
  for (const int threads : { 1, 2, 3 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    WeightsResult result;
    ASSERT_TRUE(bounded_biharmonic_weights(context, problem, options, result).ok());
    first = threads == 1 ? result.weights : first;
    EXPECT_EQ((result.weights - first).cwiseAbs().maxCoeff(), 0.0);
  }
  // If the iterations end too early, the result contains the best rows of weights so far. The rows
  // sum to 1, and the report contains the duality gap of these weights.
  options.maximum_iterations = 3;
  ExecutionContext context;
  WeightsResult result;
  const Status late = bounded_biharmonic_weights(context, problem, options, result);
  EXPECT_EQ(late.code, StatusCode::not_converged);
  EXPECT_NE(late.message.find("not certified"), std::string::npos) << late.message;
  EXPECT_LE(result.row_sum_error, 1e-12);
  EXPECT_GT(late.report.number("relative_gap", 0.0), 1e-6);
  // Cancel while the coupled columns are solved.
  options.maximum_iterations = 100;
  std::atomic<bool> stop{ false };
  ExecutionContext canceled([&](double, const std::string& phase)
    { stop = stop || phase == "coupled"; },
    [&] { return stop.load(); });
  EXPECT_EQ(
    bounded_biharmonic_weights(canceled, problem, options, result).code, StatusCode::canceled);
}
