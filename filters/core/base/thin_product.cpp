#include "base/thin_product.h"

#include "base/simd.h"

namespace bindpose
{

namespace
{
constexpr Index lanes = 4;
typedef double Pack __attribute__((vector_size(lanes * sizeof(double)), aligned(8), may_alias));

/// y_j += A x_j for a few columns of A.
template <Index count>
BINDPOSE_ALWAYS_INLINE void add_columns(
  Index rows, const double* __restrict a, const double* x, Index x_stride, double* __restrict y)
{
  double factors[count][3];
  for (Index c = 0; c < count; ++c)
  {
    for (Index j = 0; j < 3; ++j)
    {
      factors[c][j] = x[j * x_stride + c];
    }
  }
  for (Index r = 0; r < rows; ++r)
  {
    double y0 = y[r], y1 = y[rows + r], y2 = y[2 * rows + r];
    for (Index c = 0; c < count; ++c)
    {
      const double entry = a[c * rows + r];
      y0 += entry * factors[c][0];
      y1 += entry * factors[c][1];
      y2 += entry * factors[c][2];
    }
    y[r] = y0;
    y[rows + r] = y1;
    y[2 * rows + r] = y2;
  }
}

BINDPOSE_SIMD_CLONES void multiply(
  Index rows, Index cols, const double* a, const double* x, double* y)
{
  Index c = 0;
  for (; c + 4 <= cols; c += 4)
  {
    add_columns<4>(rows, a + c * rows, x + c, cols, y);
  }
  for (; c < cols; ++c)
  {
    add_columns<1>(rows, a + c * rows, x + c, cols, y);
  }
}

/// y_j = A^T x_j for a few columns of A.
template <Index count>
BINDPOSE_ALWAYS_INLINE void dot_columns(
  Index rows, const double* a, const double* x, double* y, Index y_stride)
{
  Pack packs[count][3] = {};
  const Index whole = rows / lanes * lanes;
  for (Index r = 0; r < whole; r += lanes)
  {
    const Pack& x0 = *reinterpret_cast<const Pack*>(x + r);
    const Pack& x1 = *reinterpret_cast<const Pack*>(x + rows + r);
    const Pack& x2 = *reinterpret_cast<const Pack*>(x + 2 * rows + r);
    for (Index c = 0; c < count; ++c)
    {
      const Pack& entry = *reinterpret_cast<const Pack*>(a + c * rows + r);
      packs[c][0] += entry * x0;
      packs[c][1] += entry * x1;
      packs[c][2] += entry * x2;
    }
  }
  for (Index c = 0; c < count; ++c)
  {
    for (Index j = 0; j < 3; ++j)
    {
      const Pack& p = packs[c][j];
      double sum = (p[0] + p[2]) + (p[1] + p[3]);
      for (Index r = whole; r < rows; ++r)
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
