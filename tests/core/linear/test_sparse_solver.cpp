// Both backends of the sparse solver, compared with a dense factorization. Clones that run
// concurrently give equal bits. One analysis is used for many factorizations. If a pivot is not
// positive, the error message contains the index of its unknown.
#include "linear/sparse_solver.h"

#include "core/linear/definite_matrix.h"
#include "support/meshes.h"

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

using namespace bindpose;
using test::definite_matrix;

namespace bindpose
{
/// Print the name of a backend. GoogleTest and CTest show it as the parameter of a test.
void PrintTo(const SparseSolver::Backend& backend, std::ostream* out)
{
  *out << (backend == SparseSolver::Backend::eigen ? "eigen" : "cholmod");
}
} // namespace bindpose

namespace
{
class SparseSolverTest : public testing::TestWithParam<SparseSolver::Backend>
{
protected:
  void SetUp() override
  {
    if (GetParam() == SparseSolver::Backend::cholmod && !SparseSolver::has_cholmod())
    {
      SparseSolver solver({ GetParam(), SparseSolver::Ordering::automatic });
      EXPECT_EQ(solver.analyze(definite_matrix(2, 1.0)).code, StatusCode::unavailable);
      GTEST_SKIP()
        << "this build has no CHOLMOD; install the package libsuitesparse-dev and rebuild";
    }
  }
};
} // namespace

TEST_P(SparseSolverTest, WhatHasNoRoomIsRefusedBeforeItIsFactored)
{
  const SparseMatrix a = definite_matrix(8, 0.1);
  SparseSolver::Options options;
  options.backend = GetParam();
  options.memory_limit = 1;
  SparseSolver solver(options);
  ASSERT_TRUE(solver.analyze(a).ok());
  EXPECT_GE(solver.factor_bytes(), 8.0 * solver.factor_nonzeros());
  EXPECT_LT(solver.factor_bytes(), 16.0 * solver.factor_nonzeros() + 1e5);
  if (GetParam() == SparseSolver::Backend::cholmod)
  {
    const Status status = solver.factor(a);
    EXPECT_EQ(status.code, StatusCode::internal_error);
    EXPECT_THAT(status.message, testing::StartsWith("the factor of 729 unknowns would increase"));
    EXPECT_EQ(solver.clone().factor(a).code, StatusCode::internal_error);
    EXPECT_EQ(solver.factorizations(), 0);
  }
}

TEST_P(SparseSolverTest, SolvesAsADenseFactorizationDoes)
{
  const SparseMatrix a = definite_matrix(3, 0.1);
  test::Random random;
  const Eigen::MatrixXd rhs =
    Eigen::MatrixXd::NullaryExpr(a.rows(), 3, [&] { return random.uniform(-1.0, 1.0); });
  const Eigen::MatrixXd expected = Eigen::MatrixXd(a).ldlt().solve(rhs);
  for (const auto ordering : { SparseSolver::Ordering::amd, SparseSolver::Ordering::metis })
  {
    SparseSolver solver({ GetParam(), ordering });
    ASSERT_TRUE(solver.analyze(a).ok());
    ASSERT_TRUE(solver.factor(a).ok());
    EXPECT_LT((solver.solve(rhs) - expected).cwiseAbs().maxCoeff(), 1e-11);
    Eigen::VectorXd x;
    solver.solve(Eigen::VectorXd(rhs.col(1)), x);
    EXPECT_LT((x - expected.col(1)).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_GE(solver.factor_nonzeros(), static_cast<double>(a.rows()));
    EXPECT_GT(solver.factor_operations(), 0.0);
  }
}

TEST_P(SparseSolverTest, ReadsOnlyTheLowerTriangle)
{
  const SparseMatrix a = definite_matrix(3, 0.1);
  const SparseMatrix lower = a.triangularView<Eigen::Lower>();
  SparseSolver solver({ GetParam(), SparseSolver::Ordering::automatic });
  ASSERT_TRUE(solver.analyze(lower).ok());
  ASSERT_TRUE(solver.factor(lower).ok());
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(a.rows(), -1.0, 1.0);
  EXPECT_LT((solver.solve(a * x) - x).cwiseAbs().maxCoeff(), 1e-10);
}

TEST_P(SparseSolverTest, OneAnalysisServesManyFactorizationsAndThreads)
{
  constexpr int count = 4;
  SparseSolver solver({ GetParam(), SparseSolver::Ordering::automatic });
  std::vector<SparseMatrix> matrices;
  for (int i = 0; i < count; ++i)
  {
    matrices.push_back(definite_matrix(9, 0.01 * (i + 1)));
  }
  ASSERT_TRUE(solver.analyze(matrices[0]).ok());
  const Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(matrices[0].rows(), 0.0, 1.0);
  std::vector<Eigen::VectorXd> serial_solutions(count);
  for (int i = 0; i < count; ++i)
  {
    ASSERT_TRUE(solver.factor(matrices[i]).ok());
    solver.solve(rhs, serial_solutions[i]);
    EXPECT_LT((matrices[i] * serial_solutions[i] - rhs).norm(), 1e-8 * rhs.norm());
  }
  std::vector<Eigen::VectorXd> concurrent_solutions(count);
  std::vector<SparseSolver> clones;
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i)
  {
    clones.push_back(solver.clone());
  }
  for (int i = 0; i < count; ++i)
  {
    threads.emplace_back(
      [&, i]
      {
        for (int again = 0; again < 3; ++again)
        {
          clones[i].factor(matrices[i]);
          clones[i].solve(rhs, concurrent_solutions[i]);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (int i = 0; i < count; ++i)
  {
    EXPECT_EQ(serial_solutions[i], concurrent_solutions[i]) << "the same bits on any thread";
  }
  EXPECT_EQ(solver.analyses(), 1);
  EXPECT_EQ(solver.factorizations(), count + 3 * count);
}

TEST_P(SparseSolverTest, NamesThePivotThatIsNotPositive)
{
  SparseMatrix a = definite_matrix(3, 0.1);
  SparseSolver solver({ GetParam(), SparseSolver::Ordering::automatic });
  ASSERT_TRUE(solver.analyze(a).ok());
  // A large negative diagonal entry makes the pivot of the same row fail, wherever the row is in
  // the elimination order.
  a.coeffRef(17, 17) = -1e6;
  const Status status = solver.factor(a);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_NE(status.message.find("unknown 17 "), std::string::npos) << status.message;
  a.coeffRef(17, 17) = std::nan("");
  EXPECT_FALSE(solver.factor(a).ok());
  // After these failures, the solver can factor another matrix with the same pattern.
  EXPECT_TRUE(solver.factor(definite_matrix(3, 1.0)).ok());
}

TEST_P(SparseSolverTest, RefusesWhatItHasNotAnalyzed)
{
  SparseSolver solver({ GetParam(), SparseSolver::Ordering::automatic });
  EXPECT_FALSE(solver.factor(definite_matrix(2, 1.0)).ok());
  ASSERT_TRUE(solver.analyze(definite_matrix(2, 1.0)).ok());
  EXPECT_FALSE(solver.factor(definite_matrix(3, 1.0)).ok());
  EXPECT_EQ(solver.analyze(SparseMatrix(3, 4)).code, StatusCode::invalid_input);
}

INSTANTIATE_TEST_SUITE_P(Backends, SparseSolverTest,
  testing::Values(SparseSolver::Backend::eigen, SparseSolver::Backend::cholmod));
