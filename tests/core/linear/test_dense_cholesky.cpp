// Dense Cholesky factorization A = L L^T. The tests check that the columns of L^-T are orthonormal
// in the inner product of A, and that the reciprocal condition number is exact for a diagonal
// matrix.
#include "linear/dense_cholesky.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
Eigen::MatrixXd random_matrix(Index rows, Index cols, unsigned seed)
{
  test::Random random(seed);
  Eigen::MatrixXd m(rows, cols);
  for (double& entry : m.reshaped())
  {
    entry = random.uniform(-1, 1);
  }
  return m;
}
} // namespace

TEST(DenseCholesky, ColumnsBecomeOrthonormalInTheMatrix)
{
  for (const Index size : { 1, 2, 7, 40, 130 })
  {
    const Eigen::MatrixXd root = random_matrix(size + 5, size, 3);
    const Eigen::MatrixXd a = root.transpose() * root;
    DenseCholesky cholesky;
    ASSERT_TRUE(cholesky.factor(a));
    Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(size, size);
    cholesky.solve_right(basis); // B = L^-T
    EXPECT_LT(
      (basis.transpose() * a * basis - Eigen::MatrixXd::Identity(size, size)).cwiseAbs().maxCoeff(),
      1e-12 / cholesky.reciprocal_condition());
  }
}

TEST(DenseCholesky, KnowsItsCondition)
{
  const Eigen::VectorXd entries = Eigen::Vector4d(1.0, 10.0, 1e-3, 5.0);
  DenseCholesky cholesky;
  ASSERT_TRUE(cholesky.factor(entries.asDiagonal().toDenseMatrix()));
  EXPECT_NEAR(cholesky.reciprocal_condition(), 1e-4, 1e-16);
}

TEST(DenseCholesky, RefusesWhatIsNotPositive)
{
  DenseCholesky cholesky;
  EXPECT_FALSE(cholesky.factor(Eigen::Vector3d(1.0, -1.0, 1.0).asDiagonal().toDenseMatrix()));
  EXPECT_FALSE(cholesky.factor(Eigen::MatrixXd::Zero(3, 3)));
  EXPECT_FALSE(cholesky.factor(Eigen::MatrixXd::Constant(3, 3, std::nan(""))));
}
