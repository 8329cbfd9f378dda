// Products of a matrix with three columns, compared with Eigen.
#include "linear/thin_product.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

using namespace bindpose;

TEST(ThinProduct, IsTheProduct)
{
  test::Random random(3);
  for (const Index rows : { 0, 1, 3, 4, 5, 17, 64 })
  {
    for (const Index cols : { 0, 1, 2, 4, 7, 33 })
    {
      Eigen::MatrixXd a(rows, cols);
      Coordinates x(cols, 3), t(rows, 3);
      for (Eigen::Ref<Eigen::MatrixXd> m : { Eigen::Ref<Eigen::MatrixXd>(a),
             Eigen::Ref<Eigen::MatrixXd>(x), Eigen::Ref<Eigen::MatrixXd>(t) })
      {
        for (double& entry : m.reshaped())
        {
          entry = static_cast<double>(random.below(17)) - 8.0; // sums of integers are exact
        }
      }
      EXPECT_EQ(thin_product(a, x), Coordinates(a * x));
      EXPECT_EQ(transposed_thin_product(a, t), Coordinates(a.transpose() * t));
    }
  }
}
