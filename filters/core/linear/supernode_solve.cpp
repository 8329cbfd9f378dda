// Triangular solves with a supernodal Cholesky factor in single precision. The solve processes one
// supernode after the other. The entries of the supernode's own unknowns and of the rows below are
// copied to a small contiguous array, so that products with the columns of the block use contiguous
// memory. Four columns are processed per pass, so that the small array is read and written four
// times less often.
#include "linear/supernode_solve.h"

#include "base/packs.h"
#include "base/simd.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace bindpose
{

namespace
{
constexpr int group = 4; // number of columns of a block that are processed together

/// Entries of one row for four or eight right-hand sides.
typedef float Row4 __attribute__((vector_size(16)));
typedef float Row8 __attribute__((vector_size(32)));
/// For a single right-hand side, the partial sums of a dot product are stored in two packs of 32
/// bytes. One pack of 64 bytes would be slow: without AVX-512, GCC 12 stores it in memory.
using Half = PackOf<float>::Pack;
constexpr int rows_per_half = PackOf<float>::lanes;
constexpr int rows_per_pass = 2 * rows_per_half;
static_assert(factor_padding == rows_per_pass - 1, "A pass can begin at the last row.");

/// Masks of the rows of a pass. The mask that keeps the first n rows consists of the
/// `rows_per_pass` entries from kept_rows[rows_per_pass - n] on.
alignas(64) constexpr std::int32_t kept_rows[2 * rows_per_pass] = { -1, -1, -1, -1, -1, -1, -1, -1,
  -1, -1, -1, -1, -1, -1, -1, -1 };

/// Read a pack and set its rows to 0 where the mask is 0.
BINDPOSE_ALWAYS_INLINE Half read_masked(const float* from, const std::int32_t* mask)
{
  return reinterpret_cast<Half>(
    pack_at(reinterpret_cast<const std::int32_t*>(from)) & pack_at(mask));
}

/// Forward substitution with one block, by groups of columns. The triangle at the top of a group
/// gives the solution x for the group's columns. Then the products of the block's lower rows with x
/// are subtracted from the same rows of `entries`.
template <typename Row>
BINDPOSE_ALWAYS_INLINE void forward(const float* block, int rows, int width, float* entries)
{
  Row* __restrict t = reinterpret_cast<Row*>(entries);
  int j = 0;
  for (; j + group <= width; j += group)
  {
    const float* __restrict a0 = block + static_cast<std::size_t>(j) * rows;
    const float* __restrict a1 = a0 + rows;
    const float* __restrict a2 = a1 + rows;
    const float* __restrict a3 = a2 + rows;
    const Row x0 = t[j] / a0[j];
    const Row x1 = (t[j + 1] - a0[j + 1] * x0) / a1[j + 1];
    const Row x2 = (t[j + 2] - a0[j + 2] * x0 - a1[j + 2] * x1) / a2[j + 2];
    const Row x3 = (t[j + 3] - a0[j + 3] * x0 - a1[j + 3] * x1 - a2[j + 3] * x2) / a3[j + 3];
    t[j] = x0;
    t[j + 1] = x1;
    t[j + 2] = x2;
    t[j + 3] = x3;
    for (int r = j + group; r < rows; ++r)
    {
      t[r] -= (a0[r] * x0 + a1[r] * x1) + (a2[r] * x2 + a3[r] * x3);
    }
  }
  for (; j < width; ++j)
  {
    const float* __restrict a = block + static_cast<std::size_t>(j) * rows;
    const Row x = t[j] / a[j];
    t[j] = x;
    for (int r = j + 1; r < rows; ++r)
    {
      t[r] -= a[r] * x;
    }
  }
}

/// Compute the dot products of `count` columns of `a` with `t`, from row `first` on. The sums are
/// independent of each other, so the processor computes them in parallel.
template <int count, typename Row>
BINDPOSE_ALWAYS_INLINE void dots(const float* a, const Row* t, int first, int rows, Row* sums)
{
  Row sum[count] = {};
  for (int r = first; r < rows; ++r)
  {
    for (int i = 0; i < count; ++i)
    {
      sum[i] += a[static_cast<std::size_t>(i) * rows + r] * t[r];
    }
  }
  for (int i = 0; i < count; ++i)
  {
    sums[i] = sum[i];
  }
}

/// Compute the dot products for a single right-hand side. The last pass also reads memory beyond
/// the last row; a mask replaces these values by 0.
template <int count>
BINDPOSE_ALWAYS_INLINE void dots(const float* a, const float* t, int first, int rows, float* sums)
{
  Half low[count] = {}, high[count] = {};
  int r = first;
  for (; r + rows_per_pass <= rows; r += rows_per_pass)
  {
    const Half t_low = pack_at(t + r), t_high = pack_at(t + r + rows_per_half);
#pragma GCC unroll 4
    for (int i = 0; i < count; ++i)
    {
      const float* from = a + static_cast<std::size_t>(i) * rows + r;
      low[i] += pack_at(from) * t_low;
      high[i] += pack_at(from + rows_per_half) * t_high;
    }
  }
  if (r < rows)
  {
    const std::int32_t* mask = kept_rows + rows_per_pass - (rows - r);
    const Half t_low = read_masked(t + r, mask);
    const Half t_high = read_masked(t + r + rows_per_half, mask + rows_per_half);
#pragma GCC unroll 4
    for (int i = 0; i < count; ++i)
    {
      const float* from = a + static_cast<std::size_t>(i) * rows + r;
      low[i] += read_masked(from, mask) * t_low;
      high[i] += read_masked(from + rows_per_half, mask + rows_per_half) * t_high;
    }
  }
#pragma GCC unroll 4
  for (int i = 0; i < count; ++i)
  {
    sums[i] = sum_lanes(low[i] + high[i]);
  }
}

/// Backward substitution with the transpose of one block: replace the entries of the supernode's
/// own rows by the solution. The entries of the rows below are already solved and remain unchanged.
template <typename Row>
BINDPOSE_ALWAYS_INLINE void backward(const float* block, int rows, int width, float* entries)
{
  Row* __restrict t = reinterpret_cast<Row*>(entries);
  Row sums[group];
  int j = width;
  for (; j >= group; j -= group)
  {
    const int i = j - group;
    const float* a0 = block + static_cast<std::size_t>(i) * rows;
    const float* a1 = a0 + rows;
    const float* a2 = a1 + rows;
    const float* a3 = a2 + rows;
    dots<group>(a0, t, j, rows, sums);
    const Row x3 = (t[i + 3] - sums[3]) / a3[i + 3];
    const Row x2 = (t[i + 2] - sums[2] - a2[i + 3] * x3) / a2[i + 2];
    const Row x1 = (t[i + 1] - sums[1] - a1[i + 3] * x3 - a1[i + 2] * x2) / a1[i + 1];
    t[i] = (t[i] - sums[0] - a0[i + 3] * x3 - a0[i + 2] * x2 - a0[i + 1] * x1) / a0[i];
    t[i + 1] = x1;
    t[i + 2] = x2;
    t[i + 3] = x3;
  }
  for (; j-- > 0;)
  {
    const float* a = block + static_cast<std::size_t>(j) * rows;
    dots<1>(a, t, j + 1, rows, sums);
    t[j] = (t[j] - sums[0]) / a[j];
  }
}

using BlockSolve = void (*)(const float*, int, int, float*);

BINDPOSE_SIMD_CLONES void forward_1(const float* block, int rows, int width, float* t)
{
  forward<float>(block, rows, width, t);
}
BINDPOSE_SIMD_CLONES void forward_4(const float* block, int rows, int width, float* t)
{
  forward<Row4>(block, rows, width, t);
}
BINDPOSE_SIMD_CLONES void forward_8(const float* block, int rows, int width, float* t)
{
  forward<Row8>(block, rows, width, t);
}
BINDPOSE_SIMD_CLONES void backward_1(const float* block, int rows, int width, float* t)
{
  backward<float>(block, rows, width, t);
}
BINDPOSE_SIMD_CLONES void backward_4(const float* block, int rows, int width, float* t)
{
  backward<Row4>(block, rows, width, t);
}
BINDPOSE_SIMD_CLONES void backward_8(const float* block, int rows, int width, float* t)
{
  backward<Row8>(block, rows, width, t);
}
} // namespace

void solve_with_supernodes(const Supernodes& nodes, const float* values, float* x, int columns)
{
  const BlockSolve forward_block = columns == 1 ? forward_1 : columns == 4 ? forward_4 : forward_8;
  const BlockSolve backward_block = columns == 1 ? backward_1
    : columns == 4                               ? backward_4
                                                 : backward_8;
  const auto count = static_cast<int>(nodes.first_column.size()) - 1;
  int most_rows = 0;
  for (int s = 0; s < count; ++s)
  {
    most_rows = std::max(most_rows, nodes.first_row[s + 1] - nodes.first_row[s]);
  }
  const auto k = static_cast<std::size_t>(columns);
  constexpr std::size_t alignment = 32;
  std::vector<float> workspace(
    static_cast<std::size_t>(most_rows) * k + alignment + factor_padding);
  void* aligned = workspace.data();
  std::size_t space = workspace.size() * sizeof(float);
  auto* t = static_cast<float*>(
    std::align(alignment, static_cast<std::size_t>(most_rows) * k * sizeof(float), aligned, space));
  for (int s = 0; s < count; ++s)
  {
    const int width = nodes.first_column[s + 1] - nodes.first_column[s];
    const int rows = nodes.first_row[s + 1] - nodes.first_row[s];
    const int* row = nodes.rows.data() + nodes.first_row[s];
    float* columns_of_node = x + static_cast<std::size_t>(nodes.first_column[s]) * k;
    std::copy(columns_of_node, columns_of_node + static_cast<std::size_t>(width) * k, t);
    std::fill(
      t + static_cast<std::size_t>(width) * k, t + static_cast<std::size_t>(rows) * k, 0.0F);
    forward_block(values + nodes.first_value[s], rows, width, t);
    std::copy(t, t + static_cast<std::size_t>(width) * k, columns_of_node);
    for (int i = width; i < rows; ++i)
    {
      for (std::size_t c = 0; c < k; ++c)
      {
        x[static_cast<std::size_t>(row[i]) * k + c] += t[static_cast<std::size_t>(i) * k + c];
      }
    }
  }
  for (int s = count; s-- > 0;)
  {
    const int width = nodes.first_column[s + 1] - nodes.first_column[s];
    const int rows = nodes.first_row[s + 1] - nodes.first_row[s];
    const int* row = nodes.rows.data() + nodes.first_row[s];
    float* columns_of_node = x + static_cast<std::size_t>(nodes.first_column[s]) * k;
    std::copy(columns_of_node, columns_of_node + static_cast<std::size_t>(width) * k, t);
    for (int i = width; i < rows; ++i)
    {
      for (std::size_t c = 0; c < k; ++c)
      {
        t[static_cast<std::size_t>(i) * k + c] = x[static_cast<std::size_t>(row[i]) * k + c];
      }
    }
    backward_block(values + nodes.first_value[s], rows, width, t);
    std::copy(t, t + static_cast<std::size_t>(width) * k, columns_of_node);
  }
}

} // namespace bindpose
