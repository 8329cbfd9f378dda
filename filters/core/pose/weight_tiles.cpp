// Loops over tiles, a vertex a lane. Each is compiled for several instruction sets and twice, for
// floats and for doubles; no operation mixes lanes, so all of them agree to the bit.
#include "pose/weight_tiles.h"

#include "base/simd.h"

#include <cmath>

namespace bindpose
{

namespace
{
typedef float FloatPack __attribute__((vector_size(64), aligned(4), may_alias));
typedef double DoublePack __attribute__((vector_size(64), aligned(8), may_alias));
typedef std::int32_t FloatBits __attribute__((vector_size(64), may_alias));
typedef std::int64_t DoubleBits __attribute__((vector_size(64), may_alias));
template <typename Scalar>
struct PackOf;
template <>
struct PackOf<float>
{
  using type = FloatPack;
  using Bits = FloatBits;
};
template <>
struct PackOf<double>
{
  using type = DoublePack;
  using Bits = DoubleBits;
};
template <typename Scalar>
using Pack = typename PackOf<Scalar>::type;
template <typename Scalar>
using Bit = typename BlendValues<Scalar, 8>::Bits;

/// The references of a tile, each once, and which lanes have it.
template <typename Scalar>
struct TileReferences
{
  using Lanes = typename PackOf<Scalar>::Bits;
  static constexpr Index lanes = WeightTiles<Scalar>::lanes;
  Lanes where[lanes]; // all bits where a lane has the reference
  std::int32_t handles[lanes];
  int count = 0;

  BINDPOSE_ALWAYS_INLINE explicit TileReferences(const std::int32_t* references)
  {
    bool done[lanes] = {};
    for (Index i = 0; i < lanes; ++i)
    {
      if (done[i])
      {
        continue;
      }
      Lanes same = {};
      for (Index k = i; k < lanes; ++k)
      {
        const bool equal = references[k] == references[i];
        done[k] = done[k] || equal;
        same[k] = equal ? -1 : 0;
      }
      this->where[this->count] = same;
      this->handles[this->count++] = references[i];
    }
  }
};

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE const Pack<Scalar>& pack(const Scalar* at)
{
  return *reinterpret_cast<const Pack<Scalar>*>(at);
}
template <typename Scalar>
BINDPOSE_ALWAYS_INLINE Pack<Scalar>& pack(Scalar* at)
{
  return *reinterpret_cast<Pack<Scalar>*>(at);
}

template <int entries, typename Scalar>
BINDPOSE_ALWAYS_INLINE void blend_any(const std::int32_t* columns, const Scalar* weights,
  Index count, const Scalar* values, const Bit<Scalar>* signs, Index handles,
  const TileReferences<Scalar>* references, Scalar* blended)
{
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  using Bits = typename PackOf<Scalar>::Bits;
  // Unrolled, so that the sums stay in registers.
  Pack<Scalar> sums[entries];
#pragma GCC unroll 12
  for (int e = 0; e < entries; ++e)
  {
    sums[e] = Pack<Scalar>{};
  }
  for (Index k = 0; k < count; ++k)
  {
    Pack<Scalar> w = pack(weights + k * lanes);
    if (signs)
    {
      const Bit<Scalar>* of_column = signs + columns[k] * handles;
      Bits flips = {};
      for (int r = 0; r < references->count; ++r)
      {
        flips |= references->where[r] & of_column[references->handles[r]];
      }
      w = reinterpret_cast<Pack<Scalar>>(reinterpret_cast<Bits>(w) ^ flips);
    }
    const Scalar* v = values + static_cast<Index>(columns[k]) * entries;
#pragma GCC unroll 12
    for (int e = 0; e < entries; ++e)
    {
      sums[e] += w * v[e];
    }
  }
#pragma GCC unroll 12
  for (int e = 0; e < entries; ++e)
  {
    pack(blended + e * lanes) = sums[e];
  }
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void load_any(
  const double* rest, Index count, const double* centre, Scalar* points)
{
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  if (count == lanes)
  {
    for (Index i = 0; i < lanes; ++i)
    {
      points[i] = static_cast<Scalar>(rest[3 * i] - centre[0]);
      points[lanes + i] = static_cast<Scalar>(rest[3 * i + 1] - centre[1]);
      points[2 * lanes + i] = static_cast<Scalar>(rest[3 * i + 2] - centre[2]);
    }
    return;
  }
  for (Index i = 0; i < lanes; ++i)
  {
    const double* p = rest + 3 * (i < count ? i : 0);
    for (int c = 0; c < 3; ++c)
    {
      points[c * lanes + i] = static_cast<Scalar>(p[c] - centre[c]);
    }
  }
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void affine_any(const Scalar* blended, const Scalar* points, Scalar* moves)
{
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  const Pack<Scalar> x = pack(points), y = pack(points + lanes), z = pack(points + 2 * lanes);
  for (int r = 0; r < 3; ++r)
  {
    const Scalar* a = blended + 4 * r * lanes;
    pack(moves + r * lanes) =
      pack(a) * x + pack(a + lanes) * y + pack(a + 2 * lanes) * z + pack(a + 3 * lanes);
  }
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void dual_any(
  const Scalar* blended, const Scalar* points, Scalar smallest, Scalar* moves)
{
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  using Lanes = Pack<Scalar>;
  Lanes q[8];
  for (int e = 0; e < 8; ++e)
  {
    q[e] = pack(blended + e * lanes);
  }
  const Lanes square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  Lanes inverse;
  for (Index i = 0; i < lanes; ++i)
  {
    const Scalar length = std::sqrt(square[i]);
    inverse[i] = length > smallest ? Scalar(1) / length : Scalar(0);
  }
  for (int e = 0; e < 8; ++e)
  {
    q[e] *= inverse;
  }
  // With d the real and e the dual part: 2 d x (d x p + w p) + 2 (w e - e_w d + d x e).
  const Lanes x = pack(points), y = pack(points + lanes), z = pack(points + 2 * lanes);
  const Lanes u = q[1] * z - q[2] * y + q[3] * x + q[4];
  const Lanes v = q[2] * x - q[0] * z + q[3] * y + q[5];
  const Lanes t = q[0] * y - q[1] * x + q[3] * z + q[6];
  const Scalar two = 2;
  pack(moves) = two * (q[1] * t - q[2] * v + q[3] * q[4] - q[7] * q[0]);
  pack(moves + lanes) = two * (q[2] * u - q[0] * t + q[3] * q[5] - q[7] * q[1]);
  pack(moves + 2 * lanes) = two * (q[0] * v - q[1] * u + q[3] * q[6] - q[7] * q[2]);
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void store_any(
  const double* rest, Index count, const Scalar* moves, double* posed)
{
  constexpr Index lanes = WeightTiles<Scalar>::lanes;
  if (count == lanes)
  {
    // First into the order of memory, then all numbers alike.
    alignas(64) Scalar line[3 * lanes];
#pragma GCC unroll 16
    for (Index i = 0; i < lanes; ++i)
    {
      line[3 * i] = moves[i];
      line[3 * i + 1] = moves[lanes + i];
      line[3 * i + 2] = moves[2 * lanes + i];
    }
    for (Index i = 0; i < 3 * lanes; ++i)
    {
      posed[i] = rest[i] + static_cast<double>(line[i]);
    }
    return;
  }
  for (Index i = 0; i < count; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      posed[3 * i + c] = rest[3 * i + c] + static_cast<double>(moves[c * lanes + i]);
    }
  }
}

// What follows is what is compiled for several instruction sets: templates cannot be.
#define BINDPOSE_OF_SCALAR(Scalar)                                                               \
  BINDPOSE_SIMD_CLONES void blend_12(const std::int32_t* columns, const Scalar* weights,         \
    Index count, const Scalar* values, Scalar* blended)                                          \
  {                                                                                              \
    blend_any<12, Scalar>(columns, weights, count, values, nullptr, 0, nullptr, blended);        \
  }                                                                                              \
  BINDPOSE_SIMD_CLONES void blend_8(const std::int32_t* columns, const Scalar* weights,          \
    Index count, const Scalar* values, Scalar* blended)                                          \
  {                                                                                              \
    blend_any<8, Scalar>(columns, weights, count, values, nullptr, 0, nullptr, blended);         \
  }                                                                                              \
  BINDPOSE_SIMD_CLONES void blend_signed_8(const std::int32_t* columns, const Scalar* weights,   \
    Index count, const Scalar* values, const Bit<Scalar>* signs, Index handles,                  \
    const std::int32_t* references, Scalar* blended)                                             \
  {                                                                                              \
    const TileReferences<Scalar> of_tile(references);                                            \
    blend_any<8, Scalar>(columns, weights, count, values, signs, handles, &of_tile, blended);    \
  }                                                                                              \
  BINDPOSE_SIMD_CLONES void load(                                                                \
    const double* rest, Index count, const double* centre, Scalar* points)                       \
  {                                                                                              \
    load_any(rest, count, centre, points);                                                       \
  }                                                                                              \
  BINDPOSE_SIMD_CLONES void affine(const Scalar* blended, const Scalar* points, Scalar* moves)   \
  {                                                                                              \
    affine_any(blended, points, moves);                                                          \
  }                                                                                              \
  BINDPOSE_SIMD_CLONES void dual(                                                                \
    const Scalar* blended, const Scalar* points, Scalar smallest, Scalar* moves)                 \
  {                                                                                              \
    dual_any(blended, points, smallest, moves);                                                  \
  }                                                                                              \
  BINDPOSE_SIMD_CLONES void store(                                                               \
    const double* rest, Index count, const Scalar* moves, double* posed)                         \
  {                                                                                              \
    store_any(rest, count, moves, posed);                                                        \
  }                                                                                              \
  BINDPOSE_SIMD_CLONES void blend_points(const std::int32_t* columns, const Scalar* weights,     \
    Index count, const Scalar* values, const double* centre, const double* rest, Index vertices, \
    double* posed)                                                                               \
  {                                                                                              \
    constexpr Index lanes = WeightTiles<Scalar>::lanes;                                          \
    alignas(64) Scalar blended[12 * lanes], points[3 * lanes], moves[3 * lanes];                 \
    blend_any<12, Scalar>(columns, weights, count, values, nullptr, 0, nullptr, blended);        \
    load_any(rest, vertices, centre, points);                                                    \
    affine_any<Scalar>(blended, points, moves);                                                  \
    store_any(rest, vertices, moves, posed);                                                     \
  }

BINDPOSE_OF_SCALAR(float)
BINDPOSE_OF_SCALAR(double)
#undef BINDPOSE_OF_SCALAR

BINDPOSE_SIMD_CLONES void pose_floats(const std::int32_t* columns, const float* weights,
  Index count, const float* values, const float* points, const float* rest, Index vertices,
  float* posed)
{
  constexpr Index lanes = WeightTiles<float>::lanes;
  alignas(64) float blended[12 * lanes], moves[3 * lanes];
  blend_any<12, float>(columns, weights, count, values, nullptr, 0, nullptr, blended);
  affine_any<float>(blended, points, moves);
  for (Index c = 0; c < 3; ++c)
  {
    pack(moves + c * lanes) += pack(rest + c * lanes);
  }
  if (vertices == lanes)
  {
#pragma GCC unroll 16
    for (Index i = 0; i < lanes; ++i)
    {
      posed[3 * i] = moves[i];
      posed[3 * i + 1] = moves[lanes + i];
      posed[3 * i + 2] = moves[2 * lanes + i];
    }
    return;
  }
  for (Index i = 0; i < vertices; ++i)
  {
    for (Index c = 0; c < 3; ++c)
    {
      posed[3 * i + c] = moves[c * lanes + i];
    }
  }
}

/// A sum of quaternions that is no longer than this has no direction.
constexpr float no_length(float)
{
  return 1e-30f;
}
constexpr double no_length(double)
{
  return 1e-300;
}
} // namespace

template <typename Scalar, int entries>
void blend_tile(const WeightTiles<Scalar>& weights, Index tile,
  const BlendValues<Scalar, entries>& values, const std::int32_t* references,
  BlendedTile<Scalar, entries>& blended)
{
  const Index begin = weights.start[static_cast<std::size_t>(tile)];
  const Index count = weights.start[static_cast<std::size_t>(tile) + 1] - begin;
  const std::int32_t* columns = weights.columns.data() + begin;
  const Scalar* of_tile = weights.weights.data() + begin * WeightTiles<Scalar>::lanes;
  if constexpr (entries == 12)
  {
    blend_12(columns, of_tile, count, values.values.data(), &blended.sums[0][0]);
  }
  else if (values.signs.empty())
  {
    blend_8(columns, of_tile, count, values.values.data(), &blended.sums[0][0]);
  }
  else
  {
    const auto handles = static_cast<Index>(values.values.size()) / entries;
    blend_signed_8(columns, of_tile, count, values.values.data(), values.signs.data(), handles,
      references, &blended.sums[0][0]);
  }
}

template <typename Scalar>
void load_points(const double* rest, Index count, const Vec3& centre, TilePoints<Scalar>& points)
{
  load(rest, count, centre.data(), &points.at[0][0]);
}

template <typename Scalar>
void affine_moves(const BlendedTile<Scalar, 12>& blended, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves)
{
  affine(&blended.sums[0][0], &points.at[0][0], &moves.at[0][0]);
}

template <typename Scalar>
void dual_quaternion_moves(const BlendedTile<Scalar, 8>& blended, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves)
{
  dual(&blended.sums[0][0], &points.at[0][0], no_length(Scalar()), &moves.at[0][0]);
}

template <typename Scalar>
void store_moved(const double* rest, Index count, const TilePoints<Scalar>& moves, double* posed)
{
  store(rest, count, &moves.at[0][0], posed);
}

template <typename Scalar>
void blend_points_of_tile(const WeightTiles<Scalar>& weights, Index tile,
  const BlendValues<Scalar, 12>& values, const Vec3& centre, const double* rest, Index count,
  double* posed)
{
  const Index begin = weights.start[static_cast<std::size_t>(tile)];
  const Index columns = weights.start[static_cast<std::size_t>(tile) + 1] - begin;
  blend_points(weights.columns.data() + begin,
    weights.weights.data() + begin * WeightTiles<Scalar>::lanes, columns, values.values.data(),
    centre.data(), rest, count, posed);
}

void pose_tile(const WeightTiles<float>& weights, Index tile, const BlendValues<float, 12>& values,
  const TilePoints<float>& points, const TilePoints<float>& rest, Index count, float* posed)
{
  const Index begin = weights.start[static_cast<std::size_t>(tile)];
  const Index columns = weights.start[static_cast<std::size_t>(tile) + 1] - begin;
  pose_floats(weights.columns.data() + begin,
    weights.weights.data() + begin * WeightTiles<float>::lanes, columns, values.values.data(),
    &points.at[0][0], &rest.at[0][0], count, posed);
}

#define BINDPOSE_INSTANTIATE(Scalar)                                                          \
  template void blend_tile(const WeightTiles<Scalar>&, Index, const BlendValues<Scalar, 12>&, \
    const std::int32_t*, BlendedTile<Scalar, 12>&);                                           \
  template void blend_tile(const WeightTiles<Scalar>&, Index, const BlendValues<Scalar, 8>&,  \
    const std::int32_t*, BlendedTile<Scalar, 8>&);                                            \
  template void load_points(const double*, Index, const Vec3&, TilePoints<Scalar>&);          \
  template void affine_moves(                                                                 \
    const BlendedTile<Scalar, 12>&, const TilePoints<Scalar>&, TilePoints<Scalar>&);          \
  template void dual_quaternion_moves(                                                        \
    const BlendedTile<Scalar, 8>&, const TilePoints<Scalar>&, TilePoints<Scalar>&);           \
  template void store_moved(const double*, Index, const TilePoints<Scalar>&, double*);        \
  template void blend_points_of_tile(const WeightTiles<Scalar>&, Index,                       \
    const BlendValues<Scalar, 12>&, const Vec3&, const double*, Index, double*);
BINDPOSE_INSTANTIATE(float)
BINDPOSE_INSTANTIATE(double)
#undef BINDPOSE_INSTANTIATE

} // namespace bindpose
