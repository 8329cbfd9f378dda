// Quadratic programs with bounds, solved by an interior-point method. The solutions are compared
// with projected Gauss-Seidel. The duality gap of the optimality certificate must bound the true
// gap, and the residual of the certificate must be within the tolerance. Results must not depend on
// the start, and their bits must not depend on the number of threads.
#include "qp/box_qp.h"

#include "base/memory.h"

#include "qp/split_form.h"
#include "support/sanitized.h"
#include "weights_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#ifdef __linux__
#include <malloc.h>
#endif

using namespace bindpose;

namespace
{
SparseMatrix energy(const TriangleMesh& mesh, int order)
{
  const Eigen::VectorXd mass = lumped_mass(mesh.points, mesh.triangles);
  return harmonic_energy(
    stiffness_matrix(mesh.points, mesh.triangles), mass / mass.maxCoeff(), order);
}

SparseMatrix energy(const TetMesh& mesh, int order)
{
  const Eigen::VectorXd mass = lumped_mass(mesh.points, mesh.tets);
  return harmonic_energy(stiffness_matrix(mesh.points, mesh.tets), mass / mass.maxCoeff(), order);
}

/// Return one column per fixed vertex: 1 at this vertex and 0 at the others.
std::vector<BoxQpColumn> unit_columns(Index count)
{
  std::vector<BoxQpColumn> columns(static_cast<std::size_t>(count));
  for (Index j = 0; j < count; ++j)
  {
    columns[static_cast<std::size_t>(j)].fixed_values = Eigen::VectorXd::Unit(count, j);
  }
  return columns;
}

BoxQpColumn column_of(std::initializer_list<double> values)
{
  BoxQpColumn column;
  column.fixed_values.resize(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), column.fixed_values.data());
  return column;
}

/// Compute the minimizer by Gauss-Seidel, one vertex after the other. The method is slow, simple
/// and independent of the tested code.
Eigen::VectorXd gauss_seidel(
  const SparseMatrix& q, const std::vector<Index>& fixed, const Eigen::VectorXd& values, int sweeps)
{
  Eigen::VectorXd w = Eigen::VectorXd::Constant(q.rows(), 0.5);
  std::vector<char> free(static_cast<std::size_t>(q.rows()), 1);
  for (std::size_t i = 0; i < fixed.size(); ++i)
  {
    free[fixed[i]] = 0;
    w[fixed[i]] = values[static_cast<Index>(i)];
  }
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    for (int v = 0; v < q.cols(); ++v)
    {
      if (free[v])
      {
        w[v] = std::clamp(w[v] - q.col(v).dot(w) / q.coeff(v, v), 0.0, 1.0);
      }
    }
  }
  return w;
}

const std::vector<Index> three_fixed{ 0, 30, 77 };
} // namespace

TEST(BoxQp, AgreesWithProjectedGaussSeidel)
{
  const TriangleMesh mesh = test::grid(9, 7, 1.0, 0.8);
  const SparseMatrix q = energy(mesh, 2);
  BoxQp qp(q, three_fixed, { 1e-9, 100, {} });
  ExecutionContext context;
  ASSERT_TRUE(qp.prepare(context).ok());
  double least = 0.0;
  for (const auto& values :
    { column_of({ 1, 0, 0 }), column_of({ 0, 1, 0 }), column_of({ 0, 0.5, 1 }) })
  {
    const BoxQpSolution solution = qp.solve(context, values);
    ASSERT_TRUE(solution.status.ok());
    const Eigen::VectorXd expected = gauss_seidel(q, three_fixed, values.fixed_values, 40000);
    EXPECT_LT((solution.w - expected).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_GE(solution.w.minCoeff(), 0.0);
    EXPECT_LE(solution.w.maxCoeff(), 1.0);
    least = std::min(least, qp.unconstrained(values.fixed_values).minCoeff());
  }
  EXPECT_LT(least, -1e-3) << "bounds matter here";
}

TEST(BoxQp, MinimizersWithoutBoundsHaveNoGradient)
{
  const TetMesh box = test::tet_box(14, 14, 14);
  const std::vector<Index> fixed{ 0, 14, 3374 };
  for (const int order : { 1, 2, 3 })
  {
    const SparseMatrix q = energy(box, order);
    BoxQp qp(q, fixed, {});
    ExecutionContext context;
    ASSERT_TRUE(qp.prepare(context).ok());
    const Index factorizations = qp.factorizations();
    const Eigen::MatrixXd w = qp.unconstrained(Eigen::MatrixXd::Identity(3, 3));
    EXPECT_EQ(qp.factorizations(), factorizations);
    EXPECT_LE(factorizations, 2) << "double precision where single precision will not do";
    const double size = Eigen::MatrixXd(q.cwiseAbs() * w.cwiseAbs()).maxCoeff();
    const Eigen::MatrixXd gradient = q * w;
    for (Index v = 0; v < q.rows(); ++v)
    {
      if (std::find(fixed.begin(), fixed.end(), v) == fixed.end())
      {
        ASSERT_LE(gradient.row(v).cwiseAbs().maxCoeff(), 1e-12 * size) << order;
      }
    }
    EXPECT_LE((w.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-7);
    // Multiply some columns by the block of Q for the free vertices, then by the inverse of this
    // block. The columns must not change.
    SplitForm form(q, fixed);
    Eigen::MatrixXd some = Eigen::MatrixXd::Zero(form.a.rows(), 2);
    some(5, 0) = some(100, 1) = 1.0;
    const Eigen::MatrixXd round_trip = qp.inverse(form.a * some);
    EXPECT_LE((round_trip - some).cwiseAbs().maxCoeff(), order < 3 ? 1e-8 : 1e-4);
  }
}

TEST(BoxQp, CertificateBoundsTheTrueGap)
{
  const TriangleMesh mesh = test::grid(9, 7, 1.0, 0.8);
  const SparseMatrix q = energy(mesh, 2);
  BoxQp qp(q, three_fixed, { 1e-9, 100, {} });
  ExecutionContext context;
  ASSERT_TRUE(qp.prepare(context).ok());
  const BoxQpSolution best = qp.solve(context, column_of({ 1, 0, 0 }));
  std::vector<char> free(static_cast<std::size_t>(q.rows()), 1);
  for (const Index v : three_fixed)
  {
    free[v] = 0;
  }
  test::Random random(3);
  for (const double size : { 1e-1, 1e-2, 1e-3 })
  {
    Eigen::VectorXd w = best.w;
    for (Index v = 0; v < w.size(); ++v)
    {
      w[v] = free[v] ? std::clamp(w[v] + size * random.uniform(-1.0, 1.0), 0.0, 1.0) : w[v];
    }
    const Certificate worse = certify({ q, free }, w);
    const double excess = worse.energy - best.certificate.energy;
    EXPECT_GT(excess, 0.0);
    EXPECT_GE(worse.relative_gap * worse.energy, excess);
    EXPECT_GT(worse.kkt_residual, 1e-9);
  }
}

TEST(BoxQp, OrderedPairsHoldAndTheirMultipliersProveIt)
{
  // The values on a strip must increase along x. The unconstrained minimizer overshoots, and the
  // minimizer with ordered values must not.
  const int n = 24;
  const TriangleMesh mesh = test::grid(n, 1, 1.0, 1.0 / n);
  const SparseMatrix q = energy(mesh, 2);
  BoxQpColumn column = column_of({ 0, 0, 0.5, 0.5, 0.55, 0.55 });
  const std::vector<Index> fixed{ 0, n + 1, 4, n + 5, n, 2 * n + 1 };
  for (Index row = 0; row < 2; ++row)
  {
    for (Index i = 0; i < n; ++i)
    {
      column.pairs.push_back({ row * (n + 1) + i, row * (n + 1) + i + 1 });
    }
  }
  BoxQp qp(q, fixed, { 1e-9, 100, {} });
  ExecutionContext context;
  ASSERT_TRUE(qp.prepare(context).ok());
  const BoxQpSolution ordered = qp.solve(context, column);
  ASSERT_TRUE(ordered.status.ok()) << ordered.certificate.relative_gap;
  double least = 1.0;
  for (const OrderedPair& pair : column.pairs)
  {
    least = std::min(least, ordered.w[pair.high] - ordered.w[pair.low]);
  }
  EXPECT_GE(least, 0.0) << "exactly";
  EXPECT_GE(ordered.multipliers.minCoeff(), 0.0);
  // Without the order constraints the energy is lower.
  column.pairs.clear();
  const BoxQpSolution bounded = qp.solve(context, column);
  EXPECT_GT(ordered.certificate.energy, bounded.certificate.energy * (1.0 + 1e-6));
  EXPECT_EQ(qp.analyses(), 1);
}

TEST(BoxQp, NeedsNoBoundsAndKeepsDistances)
{
  const int n = 24;
  const TriangleMesh mesh = test::grid(n, 1, 1.0, 1.0 / n);
  const SparseMatrix q = energy(mesh, 2);
  BoxQpColumn column = column_of({ 0, 0, 0.5, 0.5, 0.55, 0.55 });
  BoxQp qp(q, { 0, n + 1, 4, n + 5, n, 2 * n + 1 }, { 1e-9, 100, {} });
  ExecutionContext context;
  ASSERT_TRUE(qp.prepare(context).ok());
  BoxQpColumn unbounded = column;
  unbounded.bounds.lower = Eigen::VectorXd::Constant(q.rows(), -HUGE_VAL);
  unbounded.bounds.upper = Eigen::VectorXd::Constant(q.rows(), HUGE_VAL);
  // Without bounds the result is the unconstrained minimizer, which overshoots.
  const BoxQpSolution free = qp.solve(context, unbounded);
  ASSERT_TRUE(free.status.ok());
  EXPECT_EQ(free.iterations, 0);
  const Eigen::VectorXd minimizer = qp.unconstrained(column.fixed_values);
  EXPECT_GT(minimizer.maxCoeff(), 0.8);
  EXPECT_LT((free.w - minimizer).cwiseAbs().maxCoeff(), 1e-9);
  // Now only some of the vertices have bounds.
  BoxQpColumn some = unbounded;
  some.bounds.lower.head(n).setZero();
  some.bounds.upper.head(n).setConstant(0.8);
  const BoxQpSolution half = qp.solve(context, some);
  ASSERT_TRUE(half.status.ok());
  EXPECT_LE(half.w.head(n).maxCoeff(), 0.8);
  EXPECT_GT(half.w.maxCoeff(), 0.8);
  // Add the constraint that values increase along x. All values are then between 0 and 0.55, the
  // fixed values at the two ends, so the bounds have no effect.
  for (Index row = 0; row < 2; ++row)
  {
    for (Index i = 0; i < n; ++i)
    {
      column.pairs.push_back({ row * (n + 1) + i, row * (n + 1) + i + 1 });
    }
  }
  unbounded.pairs = column.pairs;
  const BoxQpSolution bounded = qp.solve(context, column);
  const BoxQpSolution ordered = qp.solve(context, unbounded);
  ASSERT_TRUE(bounded.status.ok());
  ASSERT_TRUE(ordered.status.ok());
  EXPECT_LT((ordered.w - bounded.w).cwiseAbs().maxCoeff(), 1e-5);
  for (OrderedPair& pair : unbounded.pairs)
  {
    pair.minimum_difference = 1e-3;
  }
  const BoxQpSolution apart = qp.solve(context, unbounded);
  ASSERT_TRUE(apart.status.ok());
  for (const OrderedPair& pair : unbounded.pairs)
  {
    EXPECT_GE(apart.w[pair.high] - apart.w[pair.low], 1e-3 - 1e-15);
  }
  EXPECT_GT(apart.certificate.energy, ordered.certificate.energy);
}

TEST(BoxQp, EveryStartEndsAtTheSameWeights)
{
  const TriangleMesh mesh = test::grid(20, 20);
  const SparseMatrix q = energy(mesh, 2);
  const std::vector<Index> fixed{ 88, 220, 352 };
  ExecutionContext context;
  for (const auto& [tolerance, same] : { std::pair{ 1e-6, 1e-6 }, std::pair{ 1e-9, 1e-8 } })
  {
    BoxQp qp(q, fixed, { tolerance, 100, {} });
    ASSERT_TRUE(qp.prepare(context).ok());
    BoxQpColumn column = column_of({ 1, 0, 0 });
    const Eigen::VectorXd usual = qp.solve(context, column).w;
    test::Random random(5);
    for (int start = 0; start < 3; ++start)
    {
      column.start = Eigen::VectorXd::NullaryExpr(
        q.rows(), [&] { return start == 2 ? random.uniform() : double(start); });
      const BoxQpSolution solution = qp.solve(context, column);
      ASSERT_TRUE(solution.status.ok());
      EXPECT_LT((solution.w - usual).cwiseAbs().maxCoeff(), same);
    }
  }
}

namespace
{
/// Return two boxes of tets with perturbed vertices.
/// @param slivers If true, the first box contains a layer of almost flat tets. The height of this
/// layer is 1e-3 of the height of the other layers.
TetMesh two_boxes(bool slivers)
{
  TetMesh first = test::tet_box(7, 6, 5);
  test::Random random(6);
  for (Index v = 0; v < first.points.rows(); ++v)
  {
    const bool inner =
      (first.points.row(v).array() > 0.01).all() && (first.points.row(v).array() < 0.99).all();
    if (inner)
    {
      first.points.row(v) += 0.02 * random.in_box(-Vec3::Ones(), Vec3::Ones()).transpose();
    }
  }
  for (Index v = 0; v < first.points.rows() && slivers; ++v)
  {
    double& z = first.points(v, 2);
    z = z > 0.9 ? 0.85 : z > 0.7 ? 0.85 - 2e-4 : z;
  }
  TetMesh second = test::tet_box(4, 4, 4, Vec3(3, 0, 0), Vec3(4, 1, 1));
  const Index shift = first.points.rows();
  TetMesh both;
  both.points.resize(shift + second.points.rows(), 3);
  both.points << first.points, second.points;
  both.tets.resize(first.tets.rows() + second.tets.rows(), 4);
  both.tets << first.tets, (second.tets.array() + shift).matrix();
  return both;
}
} // namespace

class BoxQpStarts : public testing::TestWithParam<bool>
{
};

TEST_P(BoxQpStarts, FoundTogetherEndWhereOthersEnd)
{
  const TetMesh mesh = two_boxes(GetParam());
  const SparseMatrix q = energy(mesh, 2);
  // There are more columns than the solver solves together. The last handles are in the second box.
  std::vector<Index> fixed;
  for (Index j = 0; j < 11; ++j)
  {
    fixed.push_back(j < 9 ? 5 + 37 * j : q.rows() - 100 + 40 * (j - 9));
  }
  std::vector<BoxQpColumn> columns = unit_columns(11);
  for (Index j = 0; j < 11; j += 3)
  {
    columns[j].pinned = { 50 + j, 120 + j };
    columns[j].pinned_values = Eigen::Vector2d(0.25, 1.0);
  }
  std::vector<char> free(static_cast<std::size_t>(q.rows()), 1);
  for (const Index v : fixed)
  {
    free[v] = 0;
  }
  std::vector<Eigen::VectorXd> unscaled_weights;
  for (const double scale : { 1.0, 1e6, 1e-6 })
  {
    const SparseMatrix scaled = scale * q;
    // Each column is solved twice: first without a start, then with a start, which selects the
    // interior-point method. The two solutions may differ by up to `same`, twice the error of one
    // solution. This error is up to 1.5e-6 for the tolerance 1e-6, and up to 5e-9 for the tolerance
    // 1e-9 (converged_change() in box_qp_workspace.h). For slivers and the tolerance 1e-9, `same`
    // is 1e-6, because round-off alone causes errors of 1e-7.
    for (const auto& [tolerance, same] :
      { std::pair{ 1e-6, 3e-6 }, std::pair{ 1e-9, GetParam() ? 1e-6 : 1e-8 } })
    {
      BoxQp qp(scaled, fixed, { tolerance, 100, {} });
      ExecutionContext context;
      ASSERT_TRUE(qp.prepare(context).ok());
      const std::vector<BoxQpSolution> together = qp.solve_all(context, columns);
      for (std::size_t j = 0; j < columns.size(); ++j)
      {
        ASSERT_TRUE(together[j].status.ok()) << together[j].certificate.relative_gap;
        BoxQpColumn column = columns[j];
        column.start = Eigen::VectorXd::Constant(q.rows(), 0.5);
        const BoxQpSolution alone = qp.solve(context, column);
        ASSERT_TRUE(alone.status.ok());
        EXPECT_LT((together[j].w - alone.w).cwiseAbs().maxCoeff(), same) << j;
        std::vector<char> is_column_free = free;
        for (std::size_t i = 0; i < column.pinned.size(); ++i)
        {
          is_column_free[column.pinned[i]] = 0;
          EXPECT_EQ(together[j].w[column.pinned[i]], column.pinned_values[static_cast<Index>(i)]);
        }
        const Certificate proof = certify({ scaled, is_column_free }, together[j].w);
        EXPECT_LE(proof.kkt_residual, tolerance);
        EXPECT_EQ(proof.bounds_violation, 0.0);
      }
      if (scale == 1.0)
      {
        unscaled_weights.clear();
        for (const BoxQpSolution& solution : together)
        {
          unscaled_weights.push_back(solution.w);
        }
      }
      for (std::size_t j = 0; j < columns.size() && tolerance < 1e-8; ++j)
      {
        EXPECT_LT((together[j].w - unscaled_weights[j]).cwiseAbs().maxCoeff(), same) << j;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, BoxQpStarts, testing::Bool());

TEST(BoxQp, ThreadsDoNotChangeABit)
{
  const TetMesh box = test::tet_box(6, 6, 6);
  const SparseMatrix q = energy(box, 2);
  const std::vector<Index> fixed{ 0, 6, 48, 171, 342 };
  const std::vector<BoxQpColumn> columns = unit_columns(5);
  std::vector<BoxQpSolution> reference;
  for (const int threads : { 1, 2, 4 })
  {
    ExecutionContext context;
    context.set_threads(threads);
    BoxQp qp(q, fixed, {});
    ASSERT_TRUE(qp.prepare(context).ok());
    const std::vector<BoxQpSolution> solutions = qp.solve_all(context, columns);
    EXPECT_EQ(qp.analyses(), 1);
    // Expect one factorization of Q and the factorizations that the columns report. With CHOLMOD,
    // expect one more factorization, which provides the initial values of all columns.
    Index factorizations = SparseSolver::has_cholmod() ? 2 : 1;
    for (const BoxQpSolution& solution : solutions)
    {
      factorizations += solution.factorizations;
    }
    EXPECT_EQ(qp.factorizations(), factorizations);
    if (threads == 1)
    {
      reference = solutions;
    }
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
      EXPECT_EQ(solutions[j].w, reference[j].w);
      EXPECT_EQ(solutions[j].iterations, reference[j].iterations);
    }
  }
}

#ifdef __linux__
TEST(BoxQp, TheEstimateOfItsMemoryIsThePeak)
{
  if (test::sanitized)
  {
    return; // with sanitizers, the process uses several times its usual memory
  }
  // Eigen's solver needs minutes for a box of 20 cubes.
  const int size = SparseSolver::has_cholmod() ? 20 : 15;
  const TetMesh box = test::tet_box(size, size, size);
  const Index last = box.points.rows() - 1;
  const SparseMatrix q = energy(box, 2);
  const std::vector<Index> fixed{ 0, size, last / 2, last };
  const std::vector<BoxQpColumn> columns = unit_columns(4);
  for (const int threads : { 1, 2 })
  {
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5"; // this resets the peak memory
    const double before = resident_memory();
    BoxQp qp(q, fixed, {});
    ExecutionContext context;
    context.set_threads(threads);
    ASSERT_TRUE(qp.prepare(context, columns).ok());
    ASSERT_TRUE(first_failure(qp.solve_all(context, columns)).ok());
    const double peak = peak_memory();
    ASSERT_GT(peak, before + 20 * mebibyte);
    EXPECT_GT(qp.memory_estimate() - before, 0.8 * (peak - before)) << threads;
    EXPECT_LT(qp.memory_estimate() - before, 1.3 * (peak - before)) << threads;
  }
}

TEST(BoxQp, TakesFewerThreadsOrRefusesWhereMemoryEnds)
{
  if (test::sanitized)
  {
    return; // with sanitizers, the process uses several times its usual memory
  }
  const TetMesh box = test::tet_box(16, 16, 16);
  const SparseMatrix q = energy(box, 2);
  const std::vector<Index> fixed{ 0, 16, 4912 };
  const std::vector<BoxQpColumn> columns = unit_columns(3);
  ExecutionContext context;
  BoxQpOptions options;
  // The process already uses more memory than this limit.
  options.solver.memory_limit = 1;
  BoxQp none(q, fixed, options);
  const Status refused = none.prepare(context, columns);
  EXPECT_EQ(refused.code, StatusCode::internal_error);
  EXPECT_THAT(
    refused.message, testing::StartsWith("solving for 3 columns on 4913 vertices would increase"));
  EXPECT_EQ(none.factorizations(), 0);
  EXPECT_GT(none.memory_estimate(), resident_memory());

  std::vector<BoxQpSolution> reference;
  double needed[2]; // memory for one thread and for two threads
  for (const int threads : { 2, 1 })
  {
    ExecutionContext some;
    some.set_threads(threads);
    ::malloc_trim(0);
    const double before = resident_memory();
    BoxQp qp(q, fixed, {});
    ASSERT_TRUE(qp.prepare(some, columns).ok());
    needed[threads - 1] = qp.memory_estimate() - before;
    reference = qp.solve_all(some, columns);
  }
  // The limit is in the middle between the needs of one and of two threads, because the resident
  // memory of the process can change by some megabytes on a busy machine.
  ASSERT_GT(needed[1], needed[0] + 8 * mebibyte);
  ::malloc_trim(0);
  options.solver.memory_limit =
    static_cast<Index>((resident_memory() + 0.5 * (needed[0] + needed[1])) / mebibyte);
  BoxQp narrow(q, fixed, options);
  context.set_threads(2);
  ASSERT_TRUE(narrow.prepare(context, columns).ok());
  EXPECT_LE(narrow.memory_estimate(), options.solver.memory_limit * mebibyte);
  const std::vector<BoxQpSolution> solutions = narrow.solve_all(context, columns);
  for (std::size_t j = 0; j < columns.size(); ++j)
  {
    ASSERT_TRUE(solutions[j].status.ok());
    EXPECT_EQ(solutions[j].w, reference[j].w);
  }
}
#endif

TEST(BoxQp, TooFewIterationsAreSaidAndCancelEndsIt)
{
  const TriangleMesh mesh = test::grid(20, 20);
  const SparseMatrix q = energy(mesh, 2);
  BoxQp qp(q, { 88, 220, 352 }, { 1e-9, 3, {} });
  ExecutionContext context;
  ASSERT_TRUE(qp.prepare(context).ok());
  BoxQpColumn far = column_of({ 1, 0, 0 });
  far.start = Eigen::VectorXd::Zero(q.rows());
  const BoxQpSolution early = qp.solve(context, far);
  EXPECT_EQ(early.status.code, StatusCode::not_converged);
  EXPECT_EQ(early.iterations, 3);
  EXPECT_GT(std::max(early.certificate.relative_gap, early.certificate.kkt_residual), 1e-9);
  EXPECT_GE(early.w.minCoeff(), 0.0);

  int poll_count = 0;
  bool prepared = false;
  ExecutionContext stopped(nullptr, [&] { return prepared && ++poll_count > 4; });
  stopped.set_threads(1);
  BoxQp other(q, { 88, 220, 352 }, {});
  const Status status = other.prepare(stopped);
  ASSERT_TRUE(status.ok());
  prepared = true;
  const BoxQpSolution solution = other.solve(stopped, column_of({ 1, 0, 0 }));
  EXPECT_EQ(solution.status.code, StatusCode::canceled);
  EXPECT_LT(solution.iterations, 4);
}

TEST(BoxQp, ConstantColumnsCostNothing)
{
  const TriangleMesh mesh = test::grid(10, 10);
  const SparseMatrix q = energy(mesh, 2);
  BoxQp qp(q, { 60 }, {});
  ExecutionContext context;
  ASSERT_TRUE(qp.prepare(context).ok());
  BoxQpColumn column = column_of({ 1 });
  std::vector<double> ones;
  for (Index v = 0; v < q.rows(); ++v)
  {
    column.pinned.push_back(v);
    ones.push_back(1.0);
  }
  column.pinned_values = Eigen::Map<Eigen::VectorXd>(ones.data(), q.rows());
  const BoxQpSolution solution = qp.solve(context, column);
  EXPECT_TRUE(solution.status.ok());
  EXPECT_EQ(solution.w, Eigen::VectorXd::Ones(q.rows()));
  EXPECT_EQ(solution.certificate.energy, 0.0);
  EXPECT_EQ(solution.certificate.relative_gap, 0.0);
  EXPECT_EQ(solution.iterations, 0);
}
