// Products A X and A^T X of a large dense matrix A and a matrix X with three columns.
#include "linear/thin_product.h"

#include "base/packs.h"

namespace bindpose
{

namespace
{
BINDPOSE_ALWAYS_INLINE bool any_of_four(const double* x)
{
  return x[0] != 0.0 || x[1] != 0.0 || x[2] != 0.0 || x[3] != 0.0;
}

BINDPOSE_SIMD_CLONES void multiply(
  Index rows, Index cols, const double* a, const double* x, double* y)
{
  Index c = 0;
  for (; c + 4 <= cols; c += 4)
  {
    // Skip groups of four rows in which x is zero. Such groups are frequent: if x contains the
    // displacements that some handles prescribe, x is zero in the rows of all other handles.
    if (any_of_four(x + c) || any_of_four(x + cols + c) || any_of_four(x + 2 * cols + c))
    {
      add_columns<4>(rows, a + c * rows, x + c, cols, y);
    }
  }
  for (; c < cols; ++c)
  {
    add_columns<1>(rows, a + c * rows, x + c, cols, y);
  }
}

/// For each column j of x, compute the dot products with `count` columns of A.
template <Index count>
BINDPOSE_ALWAYS_INLINE void dot_columns(
  Index rows, const double* a, const double* x, double* y, Index y_stride)
{
  constexpr Index lanes = PackOf<double>::lanes;
  using Pack = PackOf<double>::Pack;
  Pack packs[count][3] = {};
  const Index full_pack_rows = rows / lanes * lanes;
  for (Index r = 0; r < full_pack_rows; r += lanes)
  {
    const Pack x0 = pack_at(x + r), x1 = pack_at(x + rows + r), x2 = pack_at(x + 2 * rows + r);
    for (Index c = 0; c < count; ++c)
    {
      const Pack entry = pack_at(a + c * rows + r);
      packs[c][0] += entry * x0;
      packs[c][1] += entry * x1;
      packs[c][2] += entry * x2;
    }
  }
  for (Index c = 0; c < count; ++c)
  {
    for (Index j = 0; j < 3; ++j)
    {
      double sum = sum_lanes(packs[c][j]);
      for (Index r = full_pack_rows; r < rows; ++r)
      {
        sum += a[c * rows + r] * x[j * rows + r];
      }
      y[j * y_stride + c] = sum;
    }
  }
}

BINDPOSE_SIMD_CLONES void multiply_transposed(
  Index rows, Index cols, const double* a, const double* x, double* y)
{
  Index c = 0;
  for (; c + 4 <= cols; c += 4)
  {
    dot_columns<4>(rows, a + c * rows, x, y + c, cols);
  }
  for (; c < cols; ++c)
  {
    dot_columns<1>(rows, a + c * rows, x, y + c, cols);
  }
}
} // namespace

Coordinates thin_product(const Eigen::MatrixXd& a, const Coordinates& x)
{
  Coordinates y = Coordinates::Zero(a.rows(), 3);
  multiply(a.rows(), a.cols(), a.data(), x.data(), y.data());
  return y;
}

Coordinates transposed_thin_product(const Eigen::MatrixXd& a, const Coordinates& x)
{
  Coordinates y(a.cols(), 3);
  multiply_transposed(a.rows(), a.cols(), a.data(), x.data(), y.data());
  return y;
}

} // namespace bindpose
