// The usual blocked product: pieces of a and b are copied so that the innermost loop reads them
// front to back, and its sums, six rows of eight columns, stay in registers. Every sum runs over
// the inner index in order, in blocks of a fixed size, whatever the instruction set.
#include "base/dense_product.h"

#include "base/packs.h"

#include <algorithm>
#include <vector>

namespace bindpose
{

namespace
{
constexpr Index tile_rows = 6;
constexpr Index tile_cols = 8;
constexpr Index inner_block = 256; ///< with tile_cols: 16 KiB, the first cache
constexpr Index row_block = 96; ///< times inner_block: 192 KiB, the second cache

/// Half a row of a tile: AVX2 has registers for twelve of them and what they are made from.
using Pack = PackOf<double>::Pack;

/// sums = a b for tile_rows x inner packed column by column and inner x tile_cols row by row.
BINDPOSE_SIMD_CLONES void multiply_tile(const double* a, const double* b, Index inner, double* sums)
{
  Pack packs[tile_rows][2] = {};
  for (Index k = 0; k < inner; ++k)
  {
    const Pack left = pack_at(b + k * tile_cols);
    const Pack right = pack_at(b + k * tile_cols + tile_cols / 2);
    for (Index i = 0; i < tile_rows; ++i)
    {
      packs[i][0] += a[k * tile_rows + i] * left;
      packs[i][1] += a[k * tile_rows + i] * right;
    }
  }
  for (Index i = 0; i < tile_rows; ++i)
  {
    pack_at(sums + i * tile_cols) = packs[i][0];
    pack_at(sums + i * tile_cols + tile_cols / 2) = packs[i][1];
  }
}

Index tiles_of(Index count, Index size)
{
  return (count + size - 1) / size;
}
} // namespace

void add_product(
  const StridedMatrix& a, const StridedMatrix& b, double* c, Index c_stride, bool lower)
{
  const Index column_tiles = tiles_of(b.cols, tile_cols);
  const Index deepest = std::min(inner_block, a.cols);
  const Index row_tiles = tiles_of(std::min(row_block, a.rows), tile_rows);
  std::vector<double> packed_b(static_cast<std::size_t>(column_tiles * tile_cols * deepest));
  std::vector<double> packed_a(static_cast<std::size_t>(row_tiles * tile_rows * deepest));
  alignas(64) double sums[tile_rows * tile_cols];
  for (Index first = 0; first < a.cols; first += inner_block)
  {
    const Index inner = std::min(inner_block, a.cols - first);
    for (Index tile = 0; tile < column_tiles; ++tile)
    {
      const Index at = tile * tile_cols, count = std::min(tile_cols, b.cols - at);
      double* to = packed_b.data() + at * inner;
      for (Index k = 0; k < inner; ++k, to += tile_cols)
      {
        std::copy_n(b.data + (first + k) * b.row + at, count, to);
        std::fill(to + count, to + tile_cols, 0.0);
      }
    }
    for (Index begin = 0; begin < a.rows; begin += row_block)
    {
      const Index end = std::min(begin + row_block, a.rows);
      for (Index at = begin; at < end; at += tile_rows)
      {
        const Index count = std::min(tile_rows, end - at);
        double* to = packed_a.data() + (at - begin) * inner;
        for (Index k = 0; k < inner; ++k, to += tile_rows)
        {
          for (Index i = 0; i < tile_rows; ++i)
          {
            to[i] = i < count ? a.data[(at + i) * a.row + (first + k) * a.column] : 0.0;
          }
        }
      }
      for (Index tile = 0; tile < column_tiles; ++tile)
      {
        const Index left = tile * tile_cols, columns = std::min(tile_cols, b.cols - left);
        for (Index at = begin; at < end; at += tile_rows)
        {
          const Index rows = std::min(tile_rows, end - at);
          if (lower && left > at + rows - 1)
          {
            continue;
          }
          multiply_tile(
            packed_a.data() + (at - begin) * inner, packed_b.data() + left * inner, inner, sums);
          for (Index i = 0; i < rows; ++i)
          {
            double* to = c + (at + i) * c_stride + left;
            for (Index j = 0; j < columns; ++j)
            {
              to[j] += sums[i * tile_cols + j];
            }
          }
        }
      }
    }
  }
}

Eigen::MatrixXd dense_product(
  const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b)
{
  // Columns lie one after the other: it is the transposed product that goes row by row.
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  add_product({ b.data(), b.cols(), b.rows(), b.outerStride(), 1 },
    { a.data(), a.cols(), a.rows(), a.outerStride(), 1 }, c.data(), c.rows());
  return c;
}

} // namespace bindpose
