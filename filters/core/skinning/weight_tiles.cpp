// Loops over the vertices of a tile, with one vertex per lane. Each loop is written for packs of
// one register (base/packs.h). A tile consists of one or several parts of this size. The loops are
// compiled for several instruction sets, for floats and for doubles. No operation mixes lanes, so
// all instruction sets with fused multiply-add operations give the same bits.
#include "skinning/weight_tiles.h"

#include "base/packs.h"

#include <cmath>
#include <utility>

namespace bindpose
{

namespace
{
/// A pack of integers whose size is that of Scalar.
template <typename Scalar, int bytes>
struct BitsOf
{
  typedef typename BlendValues<Scalar, 8>::Bits type __attribute__((vector_size(bytes), may_alias));
};
template <typename Scalar, int bytes>
using Pack = typename PackOf<Scalar, bytes>::Pack;
template <typename Scalar, int bytes>
using Bits = typename BitsOf<Scalar, bytes>::type;
template <typename Scalar>
using Bit = typename BlendValues<Scalar, 8>::Bits;

template <typename Scalar>
constexpr Index tile_lanes = WeightTiles<Scalar>::lanes;
/// Number of lanes in a part of a tile.
template <typename Scalar, int bytes>
constexpr int part_lanes = PackOf<Scalar, bytes>::lanes;

/// The distinct reference handles of the vertices in a part of a tile. For each of these handles, a
/// mask selects the lanes of the vertices with this reference handle.
template <typename Scalar, int bytes>
struct PartReferences
{
  static constexpr int lanes = part_lanes<Scalar, bytes>;
  // One mask per reference handle. All bits are set in the lanes of vertices with this handle, no
  // bits in other lanes.
  Bits<Scalar, bytes> lane_mask[lanes];
  std::int32_t handles[lanes];
  int count = 0;

  BINDPOSE_ALWAYS_INLINE explicit PartReferences(const std::int32_t* references)
  {
    bool done[lanes] = {};
    for (int i = 0; i < lanes; ++i)
    {
      if (done[i])
      {
        continue;
      }
      Bits<Scalar, bytes> lanes_of_handle = {};
      for (int k = i; k < lanes; ++k)
      {
        const bool equal = references[k] == references[i];
        done[k] = done[k] || equal;
        lanes_of_handle[k] = equal ? -1 : 0;
      }
      this->lane_mask[this->count] = lanes_of_handle;
      this->handles[this->count++] = references[i];
    }
  }
};

/// Compute the blended sums of a part of a tile. `weights` and `blended` point to the part's first
/// lane.
template <int entries, int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void blend_part(const std::int32_t* columns, const Scalar* weights,
  Index count, const Scalar* values, const Bit<Scalar>* signs, Index handles,
  const PartReferences<Scalar, bytes>* references, Scalar* blended)
{
  // The loops over entries are unrolled, so that the sums stay in registers.
  Pack<Scalar, bytes> sums[entries];
#pragma GCC unroll 12
  for (int e = 0; e < entries; ++e)
  {
    sums[e] = Pack<Scalar, bytes>{};
  }
  for (Index k = 0; k < count; ++k)
  {
    Pack<Scalar, bytes> w = pack_at<bytes>(weights + k * tile_lanes<Scalar>);
    if (signs)
    {
      const Bit<Scalar>* column_signs = signs + columns[k] * handles;
      Bits<Scalar, bytes> flips = {};
      for (int r = 0; r < references->count; ++r)
      {
        flips |= references->lane_mask[r] & column_signs[references->handles[r]];
      }
      w = reinterpret_cast<Pack<Scalar, bytes>>(reinterpret_cast<Bits<Scalar, bytes>>(w) ^ flips);
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
    pack_at<bytes>(blended + e * tile_lanes<Scalar>) = sums[e];
  }
}

/// Combine lanes of `a`, `b` and `c` in one pack, by two shuffles. A shuffle takes lanes from two
/// packs (p, q): lane indices below the pack size select lanes of p, higher indices select lanes of
/// q. Lane i of the first result is lane Lanes::first(i) of (a, b). Lane i of the returned pack is
/// lane Lanes::second(i) of (first result, c).
template <typename Lanes, typename Pack, int... i>
BINDPOSE_ALWAYS_INLINE Pack shuffle(
  Pack a, Pack b, Pack c, std::integer_sequence<int, i...> /*lanes*/)
{
  const Pack first = __builtin_shufflevector(a, b, Lanes::first(i)...);
  return __builtin_shufflevector(first, c, Lanes::second(i)...);
}

/// Lane indices for shuffle() that select one coordinate of all points of a part. The three input
/// packs contain the coordinates in the order x y z x y z ….
template <int lanes, int coordinate>
struct LanesOfRow
{
  static constexpr int first(int i) { return is_in_first(i) ? 3 * i + coordinate : 0; }
  static constexpr int second(int i) { return is_in_first(i) ? i : 3 * i + coordinate - lanes; }

private:
  static constexpr bool is_in_first(int i) { return 3 * i + coordinate < 2 * lanes; }
};

/// Lane indices for the inverse of LanesOfRow. The first input pack contains the x coordinates of a
/// part's points, the second the y coordinates, and the third the z coordinates. The three output
/// packs contain the coordinates in the order x y z x y z …. With these indices, shuffle() computes
/// output pack number `third` (0, 1 or 2).
template <int lanes, int third>
struct LanesOfPoints
{
  static constexpr int first(int i) { return coordinate(i) == 1 ? lanes + point(i) : point(i); }
  static constexpr int second(int i) { return coordinate(i) == 2 ? lanes + point(i) : i; }

private:
  static constexpr int point(int i) { return (third * lanes + i) / 3; }
  static constexpr int coordinate(int i) { return (third * lanes + i) % 3; }
};

/// Transpose the points of a part: from the order x y z x y z … to one row per coordinate.
template <int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void deinterleave(const Scalar* line, Scalar* points)
{
  constexpr int lanes = part_lanes<Scalar, bytes>;
  constexpr std::make_integer_sequence<int, lanes> all;
  const Pack<Scalar, bytes> a = pack_at<bytes>(line), b = pack_at<bytes>(line + lanes),
                            c = pack_at<bytes>(line + 2 * lanes);
  pack_at<bytes>(points) = shuffle<LanesOfRow<lanes, 0>>(a, b, c, all);
  pack_at<bytes>(points + tile_lanes<Scalar>) = shuffle<LanesOfRow<lanes, 1>>(a, b, c, all);
  pack_at<bytes>(points + 2 * tile_lanes<Scalar>) = shuffle<LanesOfRow<lanes, 2>>(a, b, c, all);
}

/// Transpose the points of a part: from one row per coordinate to the order x y z x y z ….
template <int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void interleave(const Scalar* points, Scalar* line)
{
  constexpr int lanes = part_lanes<Scalar, bytes>;
  constexpr std::make_integer_sequence<int, lanes> all;
  const Pack<Scalar, bytes> x = pack_at<bytes>(points),
                            y = pack_at<bytes>(points + tile_lanes<Scalar>),
                            z = pack_at<bytes>(points + 2 * tile_lanes<Scalar>);
  pack_at<bytes>(line) = shuffle<LanesOfPoints<lanes, 0>>(x, y, z, all);
  pack_at<bytes>(line + lanes) = shuffle<LanesOfPoints<lanes, 1>>(x, y, z, all);
  pack_at<bytes>(line + 2 * lanes) = shuffle<LanesOfPoints<lanes, 2>>(x, y, z, all);
}

template <int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void load_tile(
  const double* rest, Index count, const double* center, Scalar* points)
{
  constexpr Index lanes = tile_lanes<Scalar>, part = part_lanes<Scalar, bytes>;
  if (count == lanes)
  {
    alignas(64) Scalar line[3 * lanes];
    for (Index i = 0; i < lanes; ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        line[3 * i + c] = static_cast<Scalar>(rest[3 * i + c] - center[c]);
      }
    }
    for (Index p = 0; p < lanes; p += part)
    {
      deinterleave<bytes>(line + 3 * p, points + p);
    }
    return;
  }
  for (Index i = 0; i < lanes; ++i)
  {
    const double* from = rest + 3 * (i < count ? i : 0);
    for (int c = 0; c < 3; ++c)
    {
      points[c * lanes + i] = static_cast<Scalar>(from[c] - center[c]);
    }
  }
}

template <int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void affine_part(const Scalar* blended, const Scalar* points, Scalar* moves)
{
  constexpr Index lanes = tile_lanes<Scalar>;
  const Pack<Scalar, bytes> x = pack_at<bytes>(points), y = pack_at<bytes>(points + lanes),
                            z = pack_at<bytes>(points + 2 * lanes);
  for (int r = 0; r < 3; ++r)
  {
    const Scalar* a = blended + 4 * r * lanes;
    pack_at<bytes>(moves + r * lanes) = pack_at<bytes>(a) * x + pack_at<bytes>(a + lanes) * y +
      pack_at<bytes>(a + 2 * lanes) * z + pack_at<bytes>(a + 3 * lanes);
  }
}

template <int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void dual_part(
  const Scalar* blended, const Scalar* points, Scalar smallest, Scalar* moves)
{
  constexpr Index lanes = tile_lanes<Scalar>;
  using Lanes = Pack<Scalar, bytes>;
  Lanes q[8];
  for (int e = 0; e < 8; ++e)
  {
    q[e] = pack_at<bytes>(blended + e * lanes);
  }
  const Lanes square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  alignas(64) Scalar inverses[part_lanes<Scalar, bytes>];
  pack_at<bytes>(inverses) = square;
#pragma GCC unroll 1 // prevents unrolling, so that the compiler vectorizes the loop
  for (int i = 0; i < part_lanes<Scalar, bytes>; ++i)
  {
    const Scalar length = std::sqrt(inverses[i]);
    inverses[i] = length > smallest ? Scalar(1) / length : Scalar(0);
  }
  const Lanes inverse = pack_at<bytes>(inverses);
  for (int e = 0; e < 8; ++e)
  {
    q[e] *= inverse;
  }
  // The displacement is 2 d x (d x p + w p) + 2 (w e - e_w d + d x e), where (d, w) is the real
  // part and (e, e_w) is the dual part.
  const Lanes x = pack_at<bytes>(points), y = pack_at<bytes>(points + lanes),
              z = pack_at<bytes>(points + 2 * lanes);
  const Lanes u = q[1] * z - q[2] * y + q[3] * x + q[4];
  const Lanes v = q[2] * x - q[0] * z + q[3] * y + q[5];
  const Lanes t = q[0] * y - q[1] * x + q[3] * z + q[6];
  const Scalar two = 2;
  pack_at<bytes>(moves) = two * (q[1] * t - q[2] * v + q[3] * q[4] - q[7] * q[0]);
  pack_at<bytes>(moves + lanes) = two * (q[2] * u - q[0] * t + q[3] * q[5] - q[7] * q[1]);
  pack_at<bytes>(moves + 2 * lanes) = two * (q[0] * v - q[1] * u + q[3] * q[6] - q[7] * q[2]);
}

template <int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void store_tile(
  const double* rest, Index count, const Scalar* moves, double* posed)
{
  constexpr Index lanes = tile_lanes<Scalar>, part = part_lanes<Scalar, bytes>;
  if (count == lanes)
  {
    // Transpose the displacements first; then one loop adds all coordinates.
    alignas(64) Scalar line[3 * lanes];
    for (Index p = 0; p < lanes; p += part)
    {
      interleave<bytes>(moves + p, line + 3 * p);
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

/// Compute the blended sums of a tile without changing the signs of values.
template <int entries, int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void blend_parts(const std::int32_t* columns, const Scalar* weights,
  Index count, const Scalar* values, Scalar* blended)
{
  for (Index p = 0; p < tile_lanes<Scalar>; p += part_lanes<Scalar, bytes>)
  {
    blend_part<entries, bytes, Scalar>(
      columns, weights + p, count, values, nullptr, 0, nullptr, blended + p);
  }
}

template <int bytes, typename Scalar>
BINDPOSE_ALWAYS_INLINE void affine_parts(const Scalar* blended, const Scalar* points, Scalar* moves)
{
  for (Index p = 0; p < tile_lanes<Scalar>; p += part_lanes<Scalar, bytes>)
  {
    affine_part<bytes>(blended + p, points + p, moves + p);
  }
}

// The following functions are generated by a macro for several instruction sets, because templates
// cannot be compiled for several instruction sets.
#define BINDPOSE_OF_SCALAR(version, bytes, Scalar)                                                 \
  version void blend_12(const std::int32_t* columns, const Scalar* weights, Index count,           \
    const Scalar* values, Scalar* blended)                                                         \
  {                                                                                                \
    blend_parts<12, bytes>(columns, weights, count, values, blended);                              \
  }                                                                                                \
  version void blend_8(const std::int32_t* columns, const Scalar* weights, Index count,            \
    const Scalar* values, Scalar* blended)                                                         \
  {                                                                                                \
    blend_parts<8, bytes>(columns, weights, count, values, blended);                               \
  }                                                                                                \
  version void blend_signed_8(const std::int32_t* columns, const Scalar* weights, Index count,     \
    const Scalar* values, const Bit<Scalar>* signs, Index handles, const std::int32_t* references, \
    Scalar* blended)                                                                               \
  {                                                                                                \
    for (Index p = 0; p < tile_lanes<Scalar>; p += part_lanes<Scalar, bytes>)                      \
    {                                                                                              \
      const PartReferences<Scalar, bytes> part_references(references + p);                         \
      blend_part<8, bytes, Scalar>(                                                                \
        columns, weights + p, count, values, signs, handles, &part_references, blended + p);       \
    }                                                                                              \
  }                                                                                                \
  version void load(const double* rest, Index count, const double* center, Scalar* points)         \
  {                                                                                                \
    load_tile<bytes>(rest, count, center, points);                                                 \
  }                                                                                                \
  version void affine(const Scalar* blended, const Scalar* points, Scalar* moves)                  \
  {                                                                                                \
    affine_parts<bytes>(blended, points, moves);                                                   \
  }                                                                                                \
  version void dual(const Scalar* blended, const Scalar* points, Scalar smallest, Scalar* moves)   \
  {                                                                                                \
    for (Index p = 0; p < tile_lanes<Scalar>; p += part_lanes<Scalar, bytes>)                      \
    {                                                                                              \
      dual_part<bytes>(blended + p, points + p, smallest, moves + p);                              \
    }                                                                                              \
  }                                                                                                \
  version void store(const double* rest, Index count, const Scalar* moves, double* posed)          \
  {                                                                                                \
    store_tile<bytes>(rest, count, moves, posed);                                                  \
  }                                                                                                \
  version void blend_points(const std::int32_t* columns, const Scalar* weights, Index count,       \
    const Scalar* values, const double* center, const double* rest, Index vertices, double* posed) \
  {                                                                                                \
    constexpr Index lanes = tile_lanes<Scalar>;                                                    \
    alignas(64) Scalar blended[12 * lanes], points[3 * lanes], moves[3 * lanes];                   \
    blend_parts<12, bytes>(columns, weights, count, values, blended);                              \
    load_tile<bytes>(rest, vertices, center, points);                                              \
    affine_parts<bytes>(blended, points, moves);                                                   \
    store_tile<bytes>(rest, vertices, moves, posed);                                               \
  }
BINDPOSE_SIMD_WIDTHS(BINDPOSE_OF_SCALAR, float)
BINDPOSE_SIMD_WIDTHS(BINDPOSE_OF_SCALAR, double)
#undef BINDPOSE_OF_SCALAR

template <int bytes>
BINDPOSE_ALWAYS_INLINE void pose_parts(const std::int32_t* columns, const float* weights,
  Index count, const float* values, const float* points, const float* rest, Index vertices,
  float* posed)
{
  constexpr Index lanes = tile_lanes<float>, part = part_lanes<float, bytes>;
  alignas(64) float blended[12 * lanes], moves[3 * lanes];
  blend_parts<12, bytes>(columns, weights, count, values, blended);
  affine_parts<bytes>(blended, points, moves);
  for (Index i = 0; i < 3 * lanes; i += part)
  {
    pack_at<bytes>(moves + i) += pack_at<bytes>(rest + i);
  }
  if (vertices == lanes)
  {
    for (Index p = 0; p < lanes; p += part)
    {
      interleave<bytes>(moves + p, posed + 3 * p);
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

#define BINDPOSE_POSE_FLOATS(version, bytes, Scalar)                                               \
  version void pose_floats(const std::int32_t* columns, const Scalar* weights, Index count,        \
    const Scalar* values, const Scalar* points, const Scalar* rest, Index vertices, Scalar* posed) \
  {                                                                                                \
    pose_parts<bytes>(columns, weights, count, values, points, rest, vertices, posed);             \
  }
BINDPOSE_SIMD_WIDTHS(BINDPOSE_POSE_FLOATS, float)
#undef BINDPOSE_POSE_FLOATS

/// Length below which a sum of quaternions is treated as zero.
constexpr float minimum_length(float)
{
  return 1e-30f;
}
constexpr double minimum_length(double)
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
  const Scalar* tile_weights = weights.weights.data() + begin * WeightTiles<Scalar>::lanes;
  if constexpr (entries == 12)
  {
    blend_12(columns, tile_weights, count, values.values.data(), &blended.sums[0][0]);
  }
  else if (values.signs.empty())
  {
    blend_8(columns, tile_weights, count, values.values.data(), &blended.sums[0][0]);
  }
  else
  {
    const auto handles = static_cast<Index>(values.values.size()) / entries;
    blend_signed_8(columns, tile_weights, count, values.values.data(), values.signs.data(), handles,
      references, &blended.sums[0][0]);
  }
}

template <typename Scalar>
void load_points(const double* rest, Index count, const Vec3& center, TilePoints<Scalar>& points)
{
  load(rest, count, center.data(), &points.at[0][0]);
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
  dual(&blended.sums[0][0], &points.at[0][0], minimum_length(Scalar()), &moves.at[0][0]);
}

template <typename Scalar>
void store_moved(const double* rest, Index count, const TilePoints<Scalar>& moves, double* posed)
{
  store(rest, count, &moves.at[0][0], posed);
}

template <typename Scalar>
void blend_points_of_tile(const WeightTiles<Scalar>& weights, Index tile,
  const BlendValues<Scalar, 12>& values, const Vec3& center, const double* rest, Index count,
  double* posed)
{
  const Index begin = weights.start[static_cast<std::size_t>(tile)];
  const Index columns = weights.start[static_cast<std::size_t>(tile) + 1] - begin;
  blend_points(weights.columns.data() + begin,
    weights.weights.data() + begin * WeightTiles<Scalar>::lanes, columns, values.values.data(),
    center.data(), rest, count, posed);
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
