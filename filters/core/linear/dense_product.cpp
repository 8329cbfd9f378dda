// A blocked matrix product. c = c + a b is computed in blocks. Blocks of a and b are copied, so
// that the innermost loop reads them sequentially. The sums of the innermost loop are a tile of c
// and stay in registers. Every sum runs over the inner index in ascending order, in blocks of a
// fixed size. Therefore the result does not depend on the size of registers and tiles.
#include "linear/dense_product.h"

#include "base/packs.h"

#include <algorithm>
#include <vector>

namespace bindpose
{

namespace
{
/// Length of a block along the inner index. A block of matrix b with this length and the width of a
/// tile takes at most 32 KiB, the size of the first-level cache.
constexpr Index inner_block = 256;
/// Number of rows in a block of matrix a. With inner_block columns, the block takes 384 KiB and
/// fits into the second-level cache.
constexpr Index row_block = 192;

/// Size of a tile of the result c. The sums of a tile use 24 registers of AVX-512, or 12 of the 16
/// registers of the other instruction sets.
template <int bytes>
struct Tile
{
  static constexpr Index lanes = PackOf<double, bytes>::lanes;
  static constexpr Index rows = bytes == 64 ? 12 : bytes == 32 ? 6 : 3;
  static constexpr Index packs = bytes == 16 ? 4 : 2; ///< number of packs in a row of the tile
  static constexpr Index cols = packs * lanes;
};

/// Compute the product `sums` of `a` and `b` for one tile. `a` is T::rows x inner, stored column by
/// column. `b` is inner x T::cols, stored row by row.
template <int bytes>
BINDPOSE_ALWAYS_INLINE void multiply_tile(
  const double* a, const double* b, Index inner, double* sums)
{
  using T = Tile<bytes>;
  typename PackOf<double, bytes>::Pack packs[T::rows][T::packs] = {};
  for (Index k = 0; k < inner; ++k)
  {
    typename PackOf<double, bytes>::Pack row[T::packs];
    for (Index p = 0; p < T::packs; ++p)
    {
      row[p] = pack_at<bytes>(b + k * T::cols + p * T::lanes);
    }
    for (Index i = 0; i < T::rows; ++i)
    {
      for (Index p = 0; p < T::packs; ++p)
      {
        packs[i][p] += a[k * T::rows + i] * row[p];
      }
    }
  }
  for (Index i = 0; i < T::rows; ++i)
  {
    for (Index p = 0; p < T::packs; ++p)
    {
      pack_at<bytes>(sums + i * T::cols + p * T::lanes) = packs[i][p];
    }
  }
}

Index tiles_of(Index count, Index size)
{
  return (count + size - 1) / size;
}

/// Copy the rows [begin, end) and columns [first, first + inner) of matrix `a`, one tile after the
/// other. The last tile is padded with zeros.
template <int bytes>
BINDPOSE_ALWAYS_INLINE void pack_rows(
  const StridedMatrix& a, Index begin, Index end, Index first, Index inner, double* to)
{
  constexpr Index rows = Tile<bytes>::rows;
  for (Index offset = begin; offset < end; offset += rows)
  {
    const Index count = std::min(rows, end - offset);
    for (Index k = 0; k < inner; ++k, to += rows)
    {
      for (Index i = 0; i < rows; ++i)
      {
        to[i] = i < count ? a.data[(offset + i) * a.row + (first + k) * a.column] : 0.0;
      }
    }
  }
}

/// Copy the columns of one tile of matrix `b`, beginning at column `first_column`. If the tile
/// extends beyond the last column, it is padded with zeros.
template <int bytes>
BINDPOSE_ALWAYS_INLINE void pack_columns(
  const StridedMatrix& b, Index first_column, Index first, Index inner, double* to)
{
  constexpr Index cols = Tile<bytes>::cols;
  const Index count = std::min(cols, b.cols - first_column);
  for (Index k = 0; k < inner; ++k, to += cols)
  {
    const double* const from = b.data + (first + k) * b.row + first_column;
    if (count == cols)
    {
      for (Index p = 0; p < Tile<bytes>::packs; ++p)
      {
        const Index offset = p * Tile<bytes>::lanes;
        pack_at<bytes>(to + offset) = pack_at<bytes>(from + offset);
      }
      continue;
    }
    for (Index j = 0; j < cols; ++j)
    {
      to[j] = j < count ? from[j] : 0.0;
    }
  }
}

template <int bytes>
BINDPOSE_ALWAYS_INLINE void add_product_of(
  const StridedMatrix& a, const StridedMatrix& b, double* c, Index c_stride, bool lower)
{
  using T = Tile<bytes>;
  const Index maximum_inner = std::min(inner_block, a.cols);
  const Index row_tiles = tiles_of(std::min(row_block, a.rows), T::rows);
  std::vector<double> packed_a(static_cast<std::size_t>(row_tiles * T::rows * maximum_inner));
  std::vector<double> packed_b(static_cast<std::size_t>(T::cols * maximum_inner));
  alignas(64) double sums[T::rows * T::cols];
  for (Index first = 0; first < a.cols; first += inner_block)
  {
    const Index inner = std::min(inner_block, a.cols - first);
    for (Index begin = 0; begin < a.rows; begin += row_block)
    {
      const Index end = std::min(begin + row_block, a.rows);
      pack_rows<bytes>(a, begin, end, first, inner, packed_a.data());
      for (Index first_column = 0; first_column < b.cols && (!lower || first_column < end);
           first_column += T::cols)
      {
        const Index columns = std::min(T::cols, b.cols - first_column);
        pack_columns<bytes>(b, first_column, first, inner, packed_b.data());
        for (Index offset = begin; offset < end; offset += T::rows)
        {
          const Index rows = std::min(T::rows, end - offset);
          if (lower && first_column > offset + rows - 1)
          {
            continue;
          }
          multiply_tile<bytes>(
            packed_a.data() + (offset - begin) * inner, packed_b.data(), inner, sums);
          for (Index i = 0; i < rows; ++i)
          {
            double* const to = c + (offset + i) * c_stride + first_column;
            for (Index j = 0; j < columns; ++j)
            {
              to[j] += sums[i * T::cols + j];
            }
          }
        }
      }
    }
  }
}

#define BINDPOSE_PRODUCT(version, bytes, Scalar)                                           \
  version void add_blocks(                                                                 \
    const StridedMatrix& a, const StridedMatrix& b, Scalar* c, Index c_stride, bool lower) \
  {                                                                                        \
    add_product_of<bytes>(a, b, c, c_stride, lower);                                       \
  }
BINDPOSE_SIMD_WIDTHS(BINDPOSE_PRODUCT, double)
#undef BINDPOSE_PRODUCT
} // namespace

void add_product(
  const StridedMatrix& a, const StridedMatrix& b, double* c, Index c_stride, bool lower)
{
  add_blocks(a, b, c, c_stride, lower);
}

void add_dense_product(const Eigen::Ref<const Eigen::MatrixXd>& a,
  const Eigen::Ref<const Eigen::MatrixXd>& b, Eigen::Ref<Eigen::MatrixXd> c)
{
  // add_product() writes a row-major matrix, but c is column-major. Therefore the transposed
  // product is computed.
  add_product({ b.data(), b.cols(), b.rows(), b.outerStride(), 1 },
    { a.data(), a.cols(), a.rows(), a.outerStride(), 1 }, c.data(), c.outerStride());
}

Eigen::MatrixXd dense_product(
  const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b)
{
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  add_dense_product(a, b, c);
  return c;
}

} // namespace bindpose
