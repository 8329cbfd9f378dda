// The same as Eigen's products, also of parts of matrices and of nothing.
#include "base/blas_product.h"

#include <gtest/gtest.h>

using namespace bindpose;

TEST(BlasProduct, IsTheProduct)
{
  for (const Index inner : { 0, 1, 9, 70 })
  {
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(33, inner + 2);
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(inner + 3, 21);
    const auto left = a.middleCols(1, inner);
    const auto right = b.middleRows(2, inner);
    const Eigen::MatrixXd expected = left * right;
    EXPECT_LT((blas_product(left, right) - expected).cwiseAbs().maxCoeff(), 1e-13);
    Eigen::MatrixXd c = Eigen::MatrixXd::Ones(40, 21);
    subtract_blas_product(left, right, c.middleRows(3, 33));
    EXPECT_LT((c.middleRows(3, 33) + expected).array().maxCoeff() - 1.0, 1e-13);
    EXPECT_GT((c.middleRows(3, 33) + expected).array().minCoeff() - 1.0, -1e-13);
    EXPECT_EQ(c.topRows(3), Eigen::MatrixXd::Ones(3, 21));
    EXPECT_EQ(c.bottomRows(4), Eigen::MatrixXd::Ones(4, 21));
  }
}
