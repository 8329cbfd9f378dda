// Quadratic programs with order constraints on pairs of vertices, solved by the augmented
// Lagrangian method. The interior-point method, which is used if single precision is unavailable,
// must give the same weights in double precision. The multipliers and the certificate must prove
// that each result is optimal.
#include "qp/augmented_lagrangian.h"

#include "geometry/laplacian.h"
#include "qp/box_qp.h"
#include "qp/split_form.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;

namespace
{
/// Columns with order constraints, on a box of tets. The constraints are a random 30 % of the
/// vertex pairs with an entry in Q. The vertex nearer to the column's fixed vertex must have at
/// least the value of the other vertex.
class AugmentedLagrangian : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!SparseSolver::has_cholmod())
    {
      GTEST_SKIP()
        << "this build has no CHOLMOD; install the package libsuitesparse-dev and rebuild";
    }
    const TetMesh box = test::tet_box(9, 8, 7);
    const Eigen::VectorXd mass = lumped_mass(box.points, box.tets);
    this->q = harmonic_energy(stiffness_matrix(box.points, box.tets), mass / mass.maxCoeff(), 2);
    test::Random random(11);
    for (std::size_t j = 0; j < this->fixed.size(); ++j)
    {
      BoxQpColumn column;
      column.fixed_values =
        Eigen::VectorXd::Unit(static_cast<Index>(this->fixed.size()), static_cast<Index>(j));
      const auto center = box.points.row(this->fixed[j]);
      for (Index v = 0; v < this->q.cols(); ++v)
      {
        for (SparseMatrix::InnerIterator entry(this->q, static_cast<int>(v)); entry; ++entry)
        {
          const double own = (box.points.row(v) - center).squaredNorm();
          const double other = (box.points.row(entry.row()) - center).squaredNorm();
          if (own > other && random.uniform() < 0.3)
          {
            column.pairs.push_back({ v, entry.row(), 0.0 });
          }
        }
      }
      this->columns.push_back(std::move(column));
    }
  }

  BoxQpOptions options(double tolerance, SparseSolver::Backend backend) const
  {
    BoxQpOptions result;
    result.tolerance = tolerance;
    result.solver.backend = backend;
    return result;
  }

  /// Remove the pairs of column j whose `high` vertex is the fixed vertex of another column. Such a
  /// vertex has the smallest value of column j, so the `low` vertex must have the same value. The
  /// pair cannot be satisfied if a test raises the lower bound or requires a minimum difference.
  void remove_pairs_below_minima(std::size_t j)
  {
    std::vector<OrderedPair>& pairs = this->columns[j].pairs;
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                  [&](const OrderedPair& pair)
                  {
                    return pair.high != this->fixed[j] &&
                      std::count(this->fixed.begin(), this->fixed.end(), pair.high) > 0;
                  }),
      pairs.end());
  }

  SparseMatrix q;
  const std::vector<Index> fixed{ 0, 125, 311, 499, 719 };
  std::vector<BoxQpColumn> columns;
};
} // namespace

TEST_F(AugmentedLagrangian, AgreesWithTheInteriorPointMethod)
{
  columns[1].pinned = { 40, 333 };
  columns[1].pinned_values = Eigen::Vector2d(0.2, 0.05);
  columns[1].pairs.clear();
  columns[1].pairs.push_back({ 333, 334, 0.0 });
  columns[2].bounds.lower = Eigen::VectorXd::Constant(q.rows(), -HUGE_VAL);
  columns[2].bounds.upper = Eigen::VectorXd::Constant(q.rows(), HUGE_VAL);
  columns[3].start = Eigen::VectorXd::Constant(q.rows(), 0.5);
  this->remove_pairs_below_minima(4);
  columns[4].bounds.lower = Eigen::VectorXd::Constant(q.rows(), 0.01);
  columns[4].bounds.upper = Eigen::VectorXd::Constant(q.rows(), 0.6);
  // The interior-point method stops improving at a gap of 2e-11; its weights are accurate to 2e-6.
  constexpr double same = 3e-6;
  for (const double tolerance : { 1e-6, 1e-9 })
  {
    BoxQp fast(q, fixed, this->options(tolerance, SparseSolver::Backend::automatic));
    BoxQp twin(q, fixed, this->options(1e-9, SparseSolver::Backend::eigen));
    ExecutionContext context;
    ASSERT_TRUE(fast.prepare(context, columns).ok());
    ASSERT_TRUE(twin.prepare(context, columns).ok());
    const std::vector<BoxQpSolution> solutions = fast.solve_all(context, columns);
    const std::vector<BoxQpSolution> expected = twin.solve_all(context, columns);
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
      const BoxQpSolution& solution = solutions[j];
      ASSERT_TRUE(solution.status.ok()) << j;
      ASSERT_TRUE(expected[j].status.ok()) << j;
      EXPECT_LT((solution.w - expected[j].w).cwiseAbs().maxCoeff(), same) << j;
      for (const OrderedPair& pair : columns[j].pairs)
      {
        ASSERT_LE(solution.w[pair.low], solution.w[pair.high]) << j;
      }
      ASSERT_EQ(static_cast<std::size_t>(solution.multipliers.size()), columns[j].pairs.size());
      EXPECT_GE(solution.multipliers.minCoeff(), 0.0) << j;
      std::vector<char> is_free(static_cast<std::size_t>(q.rows()), 1);
      for (const Index v : fixed)
      {
        is_free[v] = 0;
      }
      for (const Index v : columns[j].pinned)
      {
        is_free[v] = 0;
      }
      const Certificate proof = certify({ q, is_free, columns[j].bounds }, solution.w,
        columns[j].pairs, solution.multipliers,
        [&](const Eigen::VectorXd& r) -> Eigen::VectorXd
        {
          const SplitForm form(q, fixed);
          return form.extend_to_all(twin.inverse(form.free_rows(r)),
            Eigen::MatrixXd::Zero(static_cast<Index>(fixed.size()), 1));
        });
      EXPECT_LE(proof.relative_gap, tolerance) << j;
      EXPECT_LE(proof.kkt_residual, tolerance) << j;
      EXPECT_EQ(proof.bounds_violation, 0.0) << j;
      EXPECT_EQ(proof.order_violation, 0.0) << j;
    }
    const Index active_count = (solutions[0].multipliers.array() > 0.0).count();
    EXPECT_GT(active_count, 10) << "expected more than 10 active pairs";
  }
}

TEST_F(AugmentedLagrangian, KeepsMinimumDifferences)
{
  this->remove_pairs_below_minima(0);
  for (OrderedPair& pair : columns[0].pairs)
  {
    pair.minimum_difference = 1e-3;
  }
  BoxQpColumn& column = columns[0];
  column.bounds.lower = Eigen::VectorXd::Constant(q.rows(), -1.0);
  column.bounds.upper = Eigen::VectorXd::Constant(q.rows(), 1.0);
  for (Index i = 1; i < column.fixed_values.size(); ++i)
  {
    column.fixed_values[i] = -1.0;
  }
  BoxQp qp(q, fixed, {});
  ExecutionContext context;
  ASSERT_TRUE(qp.prepare(context, { column }).ok());
  const BoxQpSolution solution = qp.solve(context, column);
  ASSERT_TRUE(solution.status.ok()) << solution.status.message;
  for (const OrderedPair& pair : column.pairs)
  {
    EXPECT_GE(solution.w[pair.high] - solution.w[pair.low], 1e-3 - 1e-15);
  }
}

TEST_F(AugmentedLagrangian, TooFewIterationsAreSaidAndCancelEndsIt)
{
  BoxQpOptions few;
  few.tolerance = 1e-9;
  few.maximum_iterations = 2;
  BoxQp qp(q, fixed, few);
  ExecutionContext context;
  ASSERT_TRUE(qp.prepare(context, columns).ok());
  for (const BoxQpSolution& early : qp.solve_all(context, columns))
  {
    EXPECT_EQ(early.status.code, StatusCode::not_converged);
    EXPECT_EQ(early.iterations, 2);
    EXPECT_GT(std::max(early.certificate.relative_gap, early.certificate.kkt_residual), 1e-9);
    EXPECT_GE(early.w.minCoeff(), 0.0);
    EXPECT_LE(early.w.maxCoeff(), 1.0);
    EXPECT_EQ(early.certificate.order_violation, 0.0);
  }

  int poll_count = 0;
  bool prepared = false;
  ExecutionContext stopped(nullptr, [&] { return prepared && ++poll_count > 100; });
  stopped.set_threads(1);
  BoxQp other(q, fixed, {});
  ASSERT_TRUE(other.prepare(stopped, columns).ok());
  prepared = true;
  const std::vector<BoxQpSolution> solutions = other.solve_all(stopped, columns);
  EXPECT_EQ(solutions.back().status.code, StatusCode::canceled);
}

TEST_F(AugmentedLagrangian, PairsWithoutAnEntryAndCyclesAreInternalErrors)
{
  BoxQp qp(q, fixed, {});
  ExecutionContext context;
  ASSERT_TRUE(qp.prepare(context, columns).ok());
  BoxQpColumn cycle = columns[0];
  cycle.pairs = { { 300, 301, 0.0 }, { 301, 300, 0.0 } };
  EXPECT_EQ(qp.solve(context, cycle).status.code, StatusCode::internal_error);
  BoxQpColumn far = columns[0];
  far.pairs = { { 1, 700, 0.0 } };
  EXPECT_EQ(qp.solve(context, far).status.code, StatusCode::internal_error);
}

TEST_F(AugmentedLagrangian, ThreadsDoNotChangeABit)
{
  std::vector<BoxQpSolution> first;
  for (const int threads : { 1, 4 })
  {
    BoxQp qp(q, fixed, {});
    ExecutionContext context;
    context.set_threads(threads);
    ASSERT_TRUE(qp.prepare(context, columns).ok());
    std::vector<BoxQpSolution> solutions = qp.solve_all(context, columns);
    if (first.empty())
    {
      first = std::move(solutions);
      continue;
    }
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
      EXPECT_EQ(first[j].w, solutions[j].w);
      EXPECT_EQ(first[j].multipliers, solutions[j].multipliers);
    }
  }
}
