// Sparse Cholesky factorization in single precision, compared with a dense factorization and with
// one in double precision. A pivot that fails is reported. Clones give the same bits on any number
// of threads.
#include "linear/float_cholesky.h"

#include "core/linear/definite_matrix.h"
#include "support/meshes.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

using namespace bindpose;

namespace
{
/// Return the lower triangle of definite_matrix().
SparseMatrix lower_triangle(int n, double shift)
{
  SparseMatrix lower = test::definite_matrix(n, shift).triangularView<Eigen::Lower>();
  lower.makeCompressed();
  return lower;
}

class FloatCholeskyTest : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!SparseSolver::has_cholmod())
    {
      GTEST_SKIP()
        << "this build has no CHOLMOD; install the package libsuitesparse-dev and rebuild";
    }
  }

  /// Analyze the matrix with `solver`, which is in double precision. Return a single-precision
  /// solver that reuses this analysis.
  FloatCholesky analyzed(const SparseMatrix& matrix, SparseSolver& solver)
  {
    FloatCholesky single;
    EXPECT_TRUE(solver.analyze(matrix).ok());
    EXPECT_TRUE(single.analyze(solver, matrix).ok());
    return single;
  }

  ExecutionContext context_;
};
} // namespace

TEST_F(FloatCholeskyTest, SolvesAsADenseFactorizationDoes)
{
  test::Random random;
  for (const int n : { 1, 2, 3, 5 })
  {
    for (const auto ordering : { SparseSolver::Ordering::amd, SparseSolver::Ordering::metis })
    {
      const SparseMatrix a = lower_triangle(n, 0.1);
      const Eigen::MatrixXd rhs =
        Eigen::MatrixXd::NullaryExpr(a.rows(), 3, [&] { return random.uniform(-1.0, 1.0); });
      const Eigen::MatrixXd dense =
        Eigen::MatrixXd(Eigen::MatrixXd(a).selfadjointView<Eigen::Lower>());
      const Eigen::MatrixXd expected = dense.ldlt().solve(rhs);
      SparseSolver solver({ SparseSolver::Backend::cholmod, ordering });
      FloatCholesky single = analyzed(a, solver);
      ASSERT_TRUE(single.factor(context_, a, 0.0).ok());
      Eigen::MatrixXd x;
      single.solve(rhs, x);
      EXPECT_LT((x - expected).norm(), 1e-4 * expected.norm());
      Eigen::VectorXd one;
      single.solve(Eigen::VectorXd(rhs.col(1)), one);
      EXPECT_LT((one - expected.col(1)).norm(), 1e-4 * expected.col(1).norm());
      // Factor the matrix plus 0.5 times its diagonal.
      ASSERT_TRUE(single.factor(context_, a, 0.5).ok());
      single.solve(rhs, x);
      Eigen::MatrixXd shifted = dense;
      shifted.diagonal() *= 1.5;
      const Eigen::MatrixXd expected_shifted = shifted.ldlt().solve(rhs);
      EXPECT_LT((x - expected_shifted).norm(), 1e-5 * expected_shifted.norm());
    }
  }
}

TEST_F(FloatCholeskyTest, FactorsTheBlockOfAnyUnknowns)
{
  test::Random random(3);
  for (const int n : { 1, 3, 6, 9 })
  {
    const SparseMatrix a = lower_triangle(n, 0.1);
    const Eigen::MatrixXd dense =
      Eigen::MatrixXd(Eigen::MatrixXd(a).selfadjointView<Eigen::Lower>());
    SparseSolver solver;
    FloatCholesky single = analyzed(a, solver);
    for (const double fraction : { 0.0, 0.05, 0.3, 0.6, 0.9, 0.97, 1.0 })
    {
      std::vector<char> excluded;
      std::vector<int> block;
      for (int i = 0; i < a.rows(); ++i)
      {
        excluded.push_back(random.uniform(0.0, 1.0) < fraction ? 1 : 0);
        if (!excluded.back())
        {
          block.push_back(i);
        }
      }
      ASSERT_TRUE(single.factor_block(context_, a, excluded).ok());
      const Eigen::MatrixXd rhs =
        Eigen::MatrixXd::NullaryExpr(a.rows(), 3, [&] { return random.uniform(-1.0, 1.0); });
      Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(a.rows(), 3);
      if (!block.empty())
      {
        const Eigen::MatrixXd inner = dense(block, block);
        const Eigen::MatrixXd inner_rhs = rhs(block, Eigen::all);
        expected(block, Eigen::all) = Eigen::MatrixXd(inner.ldlt().solve(inner_rhs));
      }
      Eigen::MatrixXd x;
      single.solve(rhs, x);
      EXPECT_LE((x - expected).norm(), 1e-4 * expected.norm()) << n << " " << fraction;
      for (int i = 0; i < a.rows(); ++i)
      {
        EXPECT_TRUE(!excluded[i] || x.row(i).isZero(0.0));
      }
    }
    // Factoring a block must not affect the next factorization of the whole matrix. Compare with a
    // clone that has not factored a block.
    FloatCholesky fresh = single.clone();
    ASSERT_TRUE(single.factor(context_, a, 0.0).ok());
    ASSERT_TRUE(fresh.factor(context_, a, 0.0).ok());
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(a.rows());
    Eigen::VectorXd x, y;
    single.solve(ones, x);
    fresh.solve(ones, y);
    EXPECT_EQ(x, y);
  }
}

TEST_F(FloatCholeskyTest, ABlockIgnoresWhatIsExcludedAndNamesItsPivot)
{
  SparseMatrix a = lower_triangle(6, 0.1);
  SparseSolver solver;
  FloatCholesky single = analyzed(a, solver);
  // The first half of the unknowns is excluded. A negative pivot in this half makes factor() fail,
  // but not factor_block().
  std::vector<char> excluded(static_cast<std::size_t>(a.rows()), 0);
  std::fill(excluded.begin(), excluded.begin() + a.rows() / 2, 1);
  a.coeffRef(3, 3) = -1.0;
  EXPECT_EQ(single.factor(context_, a, 0.0).code, StatusCode::invalid_input);
  EXPECT_TRUE(single.factor_block(context_, a, excluded).ok());
  const int bad = static_cast<int>(a.rows()) - 2;
  a.coeffRef(bad, bad) = -1.0;
  EXPECT_NE(single.factor_block(context_, a, excluded)
              .message.find("the pivot of unknown " + std::to_string(bad) + " "),
    std::string::npos);
  EXPECT_EQ(single.factorizations(), 3);
  EXPECT_EQ(
    single.factor_block(context_, a, { 1, 0 }).code, StatusCode::internal_error); // wrong size
  ExecutionContext stopped;
  stopped.request_cancel();
  EXPECT_EQ(single.factor_block(stopped, a, excluded).code, StatusCode::canceled);
}

TEST_F(FloatCholeskyTest, SolvesAnyNumberOfColumnsAsItSolvesOne)
{
  test::Random random(2);
  const SparseMatrix a = lower_triangle(9, 0.1);
  SparseSolver solver;
  FloatCholesky single = analyzed(a, solver);
  ASSERT_TRUE(single.factor(context_, a, 0.0).ok());
  for (const int columns : { 1, 2, 4, 5, 8, 9, 10, 13, 16 })
  {
    Eigen::MatrixXd rhs =
      Eigen::MatrixXd::NullaryExpr(a.rows(), columns, [&] { return random.uniform(-1.0, 1.0); });
    rhs.col(columns / 2) *= 1e40; // each right-hand side has its own scale
    Eigen::MatrixXd x;
    single.solve(rhs, x);
    for (int c = 0; c < columns; ++c)
    {
      Eigen::VectorXd one;
      single.solve(Eigen::VectorXd(rhs.col(c)), one);
      EXPECT_LT((x.col(c) - one).norm(), 1e-5 * one.norm()) << c << " of " << columns;
    }
  }
}

TEST_F(FloatCholeskyTest, ResidualsAreThoseOfSinglePrecisionAtAnyScale)
{
  const SparseMatrix a = lower_triangle(11, 0.01);
  SparseSolver solver;
  FloatCholesky single = analyzed(a, solver);
  ASSERT_TRUE(solver.factor(a).ok());
  test::Random random(4);
  const Eigen::VectorXd rhs =
    Eigen::VectorXd::NullaryExpr(a.rows(), [&] { return random.uniform(-1.0, 1.0); });
  Eigen::VectorXd expected;
  solver.solve(rhs, expected);
  for (const double scale : { 1.0, 1e-60, 1e60 })
  {
    // Scale the rows and columns of the matrix by very different factors. The factors exceed the
    // range of float.
    Eigen::VectorXd rows(a.rows());
    for (Index i = 0; i < rows.size(); ++i)
    {
      rows[i] = std::sqrt(scale) * std::pow(10.0, static_cast<double>(i % 13) - 6.0);
    }
    const SparseMatrix scaled = rows.asDiagonal() * a * rows.asDiagonal();
    ASSERT_TRUE(single.factor(context_, scaled, 0.0).ok());
    Eigen::VectorXd x;
    single.solve(Eigen::VectorXd(rows.cwiseProduct(rhs)), x);
    const Eigen::VectorXd back = rows.cwiseProduct(x);
    EXPECT_LT((back - expected).norm(), 1e-3 * expected.norm());
    const Eigen::VectorXd product = a.selfadjointView<Eigen::Lower>() * back;
    EXPECT_LT((rhs - product).norm(), 1e-3 * rhs.norm());
  }
  Eigen::VectorXd x;
  single.solve(Eigen::VectorXd(Eigen::VectorXd::Zero(a.rows())), x);
  EXPECT_EQ(x, Eigen::VectorXd::Zero(a.rows()));
}

TEST_F(FloatCholeskyTest, NamesThePivotThatIsNotPositive)
{
  SparseMatrix a = lower_triangle(4, 0.1);
  SparseSolver solver;
  FloatCholesky single = analyzed(a, solver);
  for (const double bad : { -1e6, 0.0, std::nan("") })
  {
    SparseMatrix b = a;
    b.coeffRef(17, 17) = bad;
    const Status status = single.factor(context_, b, 0.0);
    EXPECT_EQ(status.code, StatusCode::invalid_input) << bad;
    if (bad < 0.0)
    {
      EXPECT_NE(status.message.find("unknown 17 "), std::string::npos) << status.message;
    }
  }
  EXPECT_TRUE(single.factor(context_, a, 0.0).ok()) << "still good for another matrix";
  EXPECT_EQ(single.factorizations(), 4);
}

TEST_F(FloatCholeskyTest, ClonesAndThreadsGiveTheSameBits)
{
  constexpr int count = 4;
  const SparseMatrix a = lower_triangle(9, 0.01);
  SparseSolver solver;
  FloatCholesky single = analyzed(a, solver);
  ASSERT_TRUE(single.factor(context_, a, 0.0).ok());
  const Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(a.rows(), -1.0, 1.0);
  Eigen::VectorXd serial_solution;
  single.solve(rhs, serial_solution);
  std::vector<FloatCholesky> clones;
  std::vector<Eigen::VectorXd> concurrent_solutions(count);
  std::vector<Eigen::VectorXd> shared(count);
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i)
  {
    clones.push_back(single.clone());
  }
  for (int i = 0; i < count; ++i)
  {
    threads.emplace_back(
      [&, i]
      {
        ExecutionContext context;
        for (int again = 0; again < 3; ++again)
        {
          clones[i].factor(context, a, 0.0);
          clones[i].solve(rhs, concurrent_solutions[i]);
          single.solve(rhs, shared[i]);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (int i = 0; i < count; ++i)
  {
    EXPECT_EQ(concurrent_solutions[i], serial_solution);
    EXPECT_EQ(shared[i], serial_solution);
  }
  EXPECT_EQ(solver.analyses(), 1);
  EXPECT_EQ(single.factorizations(), 1 + 3 * count);
}

TEST_F(FloatCholeskyTest, CancelEndsItAndOtherPatternsAreRefused)
{
  const SparseMatrix a = lower_triangle(4, 0.1);
  SparseSolver solver;
  FloatCholesky single = analyzed(a, solver);
  int asked = 0;
  const ExecutionContext stopped(nullptr, [&] { return ++asked > 3; });
  EXPECT_EQ(single.factor(stopped, a, 0.0).code, StatusCode::canceled);
  EXPECT_FALSE(single.factor(context_, lower_triangle(3, 0.1), 0.0).ok());
  EXPECT_FALSE(FloatCholesky().factor(context_, a, 0.0).ok());
  EXPECT_FALSE(FloatCholesky().analyze(solver, lower_triangle(3, 0.1)).ok());
}

TEST(FloatCholesky, IsUnavailableWithoutSupernodes)
{
  const SparseMatrix a = lower_triangle(3, 0.1);
  SparseSolver solver({ SparseSolver::Backend::eigen, SparseSolver::Ordering::automatic });
  ASSERT_TRUE(solver.analyze(a).ok());
  FloatCholesky single;
  EXPECT_EQ(single.analyze(solver, a).code, StatusCode::unavailable);
  EXPECT_FALSE(single.is_analyzed());
}
