// Iterative refinement: a single-precision factor gives solutions with double precision. The
// solutions are compared with a dense factorization, and the reported residual with the true
// residual.
#include "linear/refined_solve.h"

#include "geometry/laplacian.h"
#include "support/meshes.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace bindpose;

namespace
{
class RefinedSolve : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!SparseSolver::has_cholmod())
    {
      GTEST_SKIP()
        << "this build has no CHOLMOD; install the package libsuitesparse-dev and rebuild";
    }
    const TetMesh box = test::tet_box(6, 6, 6);
    const SparseMatrix k = stiffness_matrix(box.points, box.tets);
    const Eigen::VectorXd m = lumped_mass(box.points, box.tets);
    this->a = harmonic_energy(k, m / m.maxCoeff(), 2);
    for (int i = 0; i < this->a.rows(); ++i)
    {
      this->a.coeffRef(i, i) += 1e-3;
    }
    this->a.makeCompressed();
    this->lower = this->a.triangularView<Eigen::Lower>();
    this->lower.makeCompressed();
    SparseSolver solver;
    ASSERT_TRUE(solver.analyze(this->lower).ok());
    ASSERT_TRUE(this->factor.analyze(solver, this->lower).ok());
    ASSERT_TRUE(this->factor.factor({}, this->lower, 0.0).ok());
    this->inverse_diagonal = this->a.diagonal().cwiseInverse();
    test::Random random;
    this->rhs.resize(this->a.rows(), 11);
    for (Index i = 0; i < this->rhs.size(); ++i)
    {
      this->rhs.data()[i] = random.uniform(-1.0, 1.0);
    }
    this->rhs.col(3) *= 1e200;
    this->rhs.col(4) *= 1e-150;
    this->rhs.col(5).setZero();
  }

  double solve(const RefinedSolveOptions& options, Eigen::MatrixXd& x) const
  {
    return refined_solve(
      this->factor,
      [this](const Eigen::MatrixXd& p)
      {
        EXPECT_LE(p.cols(), 10) << "the column of zeros has its solution";
        return Eigen::MatrixXd(this->a * p);
      },
      this->inverse_diagonal, this->rhs, options, x);
  }
  double residual(const Eigen::MatrixXd& x, Index column) const
  {
    const auto norm = [this](const Eigen::VectorXd& v)
    { return std::sqrt(v.cwiseAbs2().dot(this->inverse_diagonal)); };
    const double size = this->rhs.col(column).cwiseAbs().maxCoeff();
    return norm((this->rhs.col(column) - this->a * x.col(column)) / size) /
      norm(this->rhs.col(column) / size);
  }

  SparseMatrix a;
  SparseMatrix lower;
  FloatCholesky factor;
  Eigen::VectorXd inverse_diagonal;
  Eigen::MatrixXd rhs;
};
} // namespace

TEST_F(RefinedSolve, IsAsGoodAsADenseFactorization)
{
  // Scale this column down. Otherwise the squares of its entries would overflow in the norms below.
  this->rhs.col(3) *= 1e-100;
  Eigen::MatrixXd x;
  EXPECT_LE(this->solve({}, x), 1e-14);
  const Eigen::MatrixXd dense = Eigen::MatrixXd(this->a).ldlt().solve(this->rhs);
  for (Index j = 0; j < x.cols(); ++j)
  {
    EXPECT_LE((x.col(j) - dense.col(j)).norm(), 1e-10 * dense.col(j).norm()) << j;
  }
  EXPECT_EQ(x.col(5), Eigen::VectorXd::Zero(x.rows()));
}

TEST_F(RefinedSolve, TellsTheResidualThatItReaches)
{
  this->rhs.col(3) *= 1e-200;
  Eigen::MatrixXd x;
  double before = 1.0;
  for (const int steps : { 1, 2, 3 })
  {
    const double reported_residual = this->solve({ 1e-14, steps }, x);
    double worst = 0.0;
    for (const Index j : { 0, 1, 2, 3, 4, 6, 7, 8, 9, 10 })
    {
      worst = std::max(worst, this->residual(x, j));
    }
    EXPECT_NEAR(reported_residual, worst, 1e-3 * worst + 1e-13);
    EXPECT_LT(reported_residual, 0.1 * before);
    before = reported_residual;
  }
  EXPECT_LE(this->solve({ 1e-4, 20 }, x), 1e-4);
  EXPECT_GT(this->residual(x, 0), 1e-12) << "no step more than is wanted";
}

TEST_F(RefinedSolve, SaysWhatItCannotSolve)
{
  Eigen::MatrixXd x;
  EXPECT_GT(this->solve({}, x), 1.0) << "the squares of column 3 are infinite";
  for (const Index j : { 0, 4, 10 })
  {
    EXPECT_LE(this->residual(x, j), 1e-12) << "and disturb no other";
  }
  this->rhs(7, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(this->solve({}, x), 1.0);

  const ExecutionContext stopped(nullptr, [] { return true; });
  EXPECT_EQ(this->solve({ 1e-14, 20, &stopped }, x), 1.0);
}
