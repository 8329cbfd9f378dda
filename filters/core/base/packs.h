#ifndef bindpose_base_packs_h
#define bindpose_base_packs_h

#include "base/mesh_types.h"
#include "base/simd.h"

// Disable GCC's warning that the calling convention of functions that return vectors depends on the
// instruction set. The functions of this file are always inlined, so the calling convention does
// not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace bindpose
{

/// A pack: numbers that one instruction processes in parallel. A pack of 32 bytes (8 floats or 4
/// doubles) fills one AVX2 register and is used with BINDPOSE_SIMD_CLONES. A pack of 64 bytes fills
/// one AVX-512 register. Packs of 64 bytes are slow on AVX2, where GCC stores them in memory.
/// Therefore they are used only in functions that are compiled for each register size
/// (BINDPOSE_SIMD_WIDTHS).
template <typename Scalar, int bytes = 32>
struct PackOf
{
  static constexpr Index lanes = bytes / sizeof(Scalar);
  typedef Scalar Pack __attribute__((vector_size(bytes), aligned(alignof(Scalar)), may_alias));
};

template <int bytes = 32, typename Scalar>
BINDPOSE_ALWAYS_INLINE auto pack_at(const Scalar* from)
{
  typename PackOf<Scalar, bytes>::Pack pack;
  __builtin_memcpy(&pack, from, sizeof(pack));
  return pack;
}

/// A pack in memory, which need not be aligned. Reads and writes copy the bytes. A `Pack&` would
/// not work: Clang ignores the reduced alignment of the type Pack in references and would use
/// instructions that require aligned memory.
template <typename Scalar, int bytes>
class PackInMemory
{
public:
  using Pack = typename PackOf<Scalar, bytes>::Pack;
  BINDPOSE_ALWAYS_INLINE explicit PackInMemory(Scalar* at) : at_(at) {}
  BINDPOSE_ALWAYS_INLINE operator Pack() const
  {
    return pack_at<bytes>(static_cast<const Scalar*>(this->at_));
  }
  BINDPOSE_ALWAYS_INLINE void operator=(Pack pack)
  {
    __builtin_memcpy(this->at_, &pack, sizeof(pack));
  }
  BINDPOSE_ALWAYS_INLINE void operator=(const PackInMemory& other)
  {
    *this = static_cast<Pack>(other);
  }
  BINDPOSE_ALWAYS_INLINE void operator+=(Pack pack) { *this = static_cast<Pack>(*this) + pack; }

private:
  Scalar* at_;
};

template <int bytes = 32, typename Scalar>
BINDPOSE_ALWAYS_INLINE auto pack_at(Scalar* from)
{
  return PackInMemory<Scalar, bytes>(from);
}

BINDPOSE_ALWAYS_INLINE float sum_lanes(const PackOf<float>::Pack& p)
{
  typedef float Four __attribute__((vector_size(16), aligned(4), may_alias));
  const Four* const halves = reinterpret_cast<const Four*>(&p);
  const Four sum = halves[0] + halves[1];
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

BINDPOSE_ALWAYS_INLINE double sum_lanes(const PackOf<double>::Pack& p)
{
  return (p[0] + p[2]) + (p[1] + p[3]);
}

/// Add A x_j to y_j for j = 0, 1, 2. A has `count` columns, which are processed in ascending order.
/// @param x_stride number of entries from the start of x_j to the start of x_j+1. The vectors y_0,
/// y_1 and y_2 are contiguous in memory, with `rows` entries each.
template <Index count, int bytes = 32, typename Scalar>
BINDPOSE_ALWAYS_INLINE void add_columns(
  Index rows, const Scalar* a, const Scalar* x, Index x_stride, Scalar* y)
{
  constexpr Index lanes = PackOf<Scalar, bytes>::lanes;
  using Pack = typename PackOf<Scalar, bytes>::Pack;
  Scalar factors[count][3];
  for (Index c = 0; c < count; ++c)
  {
    for (Index j = 0; j < 3; ++j)
    {
      factors[c][j] = x[j * x_stride + c];
    }
  }
  const Index full_pack_rows = rows / lanes * lanes;
  for (Index r = 0; r < full_pack_rows; r += lanes)
  {
    Pack y0 = pack_at<bytes>(y + r), y1 = pack_at<bytes>(y + rows + r),
         y2 = pack_at<bytes>(y + 2 * rows + r);
    for (Index c = 0; c < count; ++c)
    {
      const Pack entry = pack_at<bytes>(a + c * rows + r);
      y0 += entry * factors[c][0];
      y1 += entry * factors[c][1];
      y2 += entry * factors[c][2];
    }
    pack_at<bytes>(y + r) = y0;
    pack_at<bytes>(y + rows + r) = y1;
    pack_at<bytes>(y + 2 * rows + r) = y2;
  }
  for (Index r = full_pack_rows; r < rows; ++r)
  {
    for (Index c = 0; c < count; ++c)
    {
      for (Index j = 0; j < 3; ++j)
      {
        y[j * rows + r] += a[c * rows + r] * factors[c][j];
      }
    }
  }
}

} // namespace bindpose

#endif
