// Triangular solves with one dense supernode, compared with Eigen's solves in double precision. The
// entries that the solve must ignore are NaN.
#include "linear/supernode_solve.h"

#include "support/meshes.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <vector>

using namespace bindpose;

TEST(SupernodeSolve, SolvesAnyNumberOfRowsAndIgnoresOtherEntries)
{
  test::Random random;
  for (int n = 1; n <= 40; ++n)
  {
    Supernodes nodes;
    nodes.first_column = { 0, n };
    nodes.first_row = { 0, n };
    nodes.first_value = { 0, n * n };
    nodes.rows.resize(n);
    std::iota(nodes.rows.begin(), nodes.rows.end(), 0);
    Eigen::MatrixXf factor =
      Eigen::MatrixXf::NullaryExpr(n, n, [&] { return float(random.uniform(-0.2, 0.2)); });
    factor.diagonal().array() += 1.0F;
    const Eigen::MatrixXd lower = factor.cast<double>().triangularView<Eigen::Lower>();
    std::vector<float> values(n * n + factor_padding, std::numeric_limits<float>::quiet_NaN());
    for (int column = 0; column < n; ++column)
    {
      for (int row = column; row < n; ++row)
      {
        values[column * n + row] = factor(row, column);
      }
    }
    for (const int columns : { 1, 4, 8 })
    {
      using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      Rows x = Rows::NullaryExpr(n, columns, [&] { return float(random.uniform(-1.0, 1.0)); });
      Eigen::MatrixXd expected = x.cast<double>();
      lower.triangularView<Eigen::Lower>().solveInPlace(expected);
      lower.transpose().triangularView<Eigen::Upper>().solveInPlace(expected);
      solve_with_supernodes(nodes, values.data(), x.data(), columns);
      EXPECT_LT((x.cast<double>() - expected).norm(), 1e-5 * expected.norm())
        << n << " rows, " << columns << " columns";
    }
  }
}
