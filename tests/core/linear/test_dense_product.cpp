// Dense matrix products, compared with Eigen for many sizes and strides.
#include "linear/dense_product.h"

#include <gtest/gtest.h>

using namespace bindpose;

namespace
{
Weights random_rows(Index rows, Index cols, unsigned seed)
{
  std::srand(seed);
  return Weights::Random(rows, cols);
}
} // namespace

TEST(DenseProduct, IsEigensAtAllSizes)
{
  for (const Index rows : { 1, 5, 6, 7, 96, 131 })
  {
    for (const Index cols : { 1, 7, 8, 9, 50 })
    {
      for (const Index inner : { 0, 1, 3, 256, 300 })
      {
        const Weights a = random_rows(rows, inner, 1), b = random_rows(inner, cols, 2);
        Weights c = random_rows(rows, cols, 3);
        const Weights expected = c + a * b;
        add_product(
          { a.data(), rows, inner, inner, 1 }, { b.data(), inner, cols, cols, 1 }, c.data(), cols);
        EXPECT_LT((c - expected).cwiseAbs().maxCoeff(), 1e-13 * static_cast<double>(inner + 1))
          << rows << " " << cols << " " << inner;
      }
    }
  }
}

TEST(DenseProduct, TakesTransposedAndWholeNumbersExactly)
{
  // Sums of integers have no round-off.
  Weights a = (random_rows(300, 37, 4) * 10.0).array().round();
  Weights b = (random_rows(300, 41, 5) * 10.0).array().round();
  Weights c = Weights::Zero(37, 50);
  add_product({ a.data(), 37, 300, 1, 37 }, { b.data(), 300, 41, 41, 1 }, c.data(), 50);
  EXPECT_EQ(Weights(c.leftCols(41)), Weights(a.transpose() * b));
  // The columns that are not part of the product are unchanged.
  EXPECT_TRUE(c.rightCols(9).isZero(0.0));
}

TEST(DenseProduct, LowerHasTheLowerTriangle)
{
  const Weights a = (random_rows(290, 61, 6) * 10.0).array().round();
  Weights c = Weights::Zero(61, 61);
  add_product({ a.data(), 61, 290, 1, 61 }, { a.data(), 290, 61, 61, 1 }, c.data(), 61, true);
  const Weights expected = a.transpose() * a;
  EXPECT_EQ(
    Weights(c.triangularView<Eigen::Lower>()), Weights(expected.triangularView<Eigen::Lower>()));
}

TEST(DenseProduct, OfMatricesIsTheSumOfProductsAtOddSizes)
{
  // Multiply two blocks of larger matrices. Then copy the blocks to separate matrices and multiply
  // these.
  for (const Index rows : { 1, 5, 7, 13, 97 })
  {
    for (const Index cols : { 1, 3, 9, 17 })
    {
      for (const Index inner : { 0, 1, 11, 257 })
      {
        const Eigen::MatrixXd a = (random_rows(rows + 3, inner + 2, 7) * 10.0).array().round();
        const Eigen::MatrixXd b = (random_rows(inner + 5, cols + 1, 8) * 10.0).array().round();
        Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(rows, cols);
        for (Index i = 0; i < rows; ++i)
        {
          for (Index j = 0; j < cols; ++j)
          {
            for (Index k = 0; k < inner; ++k)
            {
              expected(i, j) += a(i + 2, k + 1) * b(k + 4, j);
            }
          }
        }
        const auto a_block = a.block(2, 1, rows, inner), b_block = b.block(4, 0, inner, cols);
        EXPECT_EQ(dense_product(a_block, b_block), expected) << rows << " " << cols << " " << inner;
        EXPECT_EQ(dense_product(Eigen::MatrixXd(a_block), Eigen::MatrixXd(b_block)), expected)
          << rows << " " << cols << " " << inner;
      }
    }
  }
}

TEST(DenseProduct, IsAddedToPartsOfMatrices)
{
  for (const Index inner : { 0, 1, 9, 70, 300 })
  {
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(33, inner + 2);
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(inner + 3, 21);
    const auto left = a.middleCols(1, inner);
    const auto right = b.middleRows(2, inner);
    const Eigen::MatrixXd expected = left * right;
    EXPECT_LT((dense_product(left, right) - expected).cwiseAbs().maxCoeff(), 1e-13);
    Eigen::MatrixXd c = Eigen::MatrixXd::Ones(40, 21);
    add_dense_product(left, right, c.middleRows(3, 33));
    EXPECT_LT((c.middleRows(3, 33) - expected).array().maxCoeff() - 1.0, 1e-13);
    EXPECT_GT((c.middleRows(3, 33) - expected).array().minCoeff() - 1.0, -1e-13);
    EXPECT_EQ(c.topRows(3), Eigen::MatrixXd::Ones(3, 21));
    EXPECT_EQ(c.bottomRows(4), Eigen::MatrixXd::Ones(4, 21));
  }
}
