#ifndef bindpose_pose_weight_tiles_h
#define bindpose_pose_weight_tiles_h

#include "base/mesh.h"

#include <limits>
#include <type_traits>
#include <vector>

namespace bindpose
{

/// Weights by tiles of consecutive vertices: for each column that any vertex of the tile has, a
/// weight for each of them, zeros among them. A tile is what the machine's widest registers hold,
/// so that a blend is a product of a few numbers a column with whole registers.
/// Scalar: float (tiles of 16) or double (of 8).
template <typename Scalar>
struct WeightTiles
{
  static constexpr Index lanes = 64 / sizeof(Scalar);

  std::vector<Index> start{ 0 }; ///< #tiles + 1, into columns
  std::vector<std::int32_t> columns; ///< ascending within a tile
  std::vector<Scalar> weights; ///< lanes of them for each column

  /// Tile of a vertex, and its place in it.
  static Index tile_of(Index vertex) { return vertex / lanes; }
  static Index lane_of(Index vertex) { return vertex % lanes; }
  Index weight_of(Index k, Index lane) const { return k * lanes + lane; }
};

/// What a tile's vertices blend: `entries` numbers a handle.
template <typename Scalar, int entries>
struct BlendValues
{
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
  /// The sign bit of a Scalar.
  static constexpr Bits sign_bit = std::numeric_limits<Bits>::min();

  std::vector<Scalar> values; ///< entries for each handle
  /// 0, or sign_bit where the weight counts with the other sign, for each pair of handles: of the
  /// column, then of the vertex's reference. Empty: all 0.
  std::vector<Bits> signs;
};

/// A tile's sums, entry by entry, lanes side by side.
template <typename Scalar, int entries>
struct alignas(64) BlendedTile
{
  Scalar sums[entries][WeightTiles<Scalar>::lanes];
};

/// sum_j w_j values_j of each vertex of the tile, in the order of the columns.
/// @param references handle of each vertex of the tile that signs refer to; null without signs.
template <typename Scalar, int entries>
void blend_tile(const WeightTiles<Scalar>& weights, Index tile,
  const BlendValues<Scalar, entries>& values, const std::int32_t* references,
  BlendedTile<Scalar, entries>& blended);

/// Coordinates of a tile's vertices, lanes side by side.
template <typename Scalar>
struct alignas(64) TilePoints
{
  Scalar at[3][WeightTiles<Scalar>::lanes];
};

/// Points less the centre; what is beyond `count` is the first point.
template <typename Scalar>
void load_points(const double* rest, Index count, const Vec3& centre, TilePoints<Scalar>& points);

/// By how much x -> x + A x + b moves points, A and b a vertex's own (3 x 4, row by row).
template <typename Scalar>
void affine_moves(const BlendedTile<Scalar, 12>& blended, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves);

/// The same of the rigid motions that sums of dual quaternions (real x, y, z, w, then dual) are
/// once they are divided by their length; nothing where that is zero.
template <typename Scalar>
void dual_quaternion_moves(const BlendedTile<Scalar, 8>& blended, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves);

/// posed = rest + moves for the first `count` vertices.
template <typename Scalar>
void store_moved(const double* rest, Index count, const TilePoints<Scalar>& moves, double* posed);

/// blend_tile, load_points, affine_moves and store_moved in one.
template <typename Scalar>
void blend_points_of_tile(const WeightTiles<Scalar>& weights, Index tile,
  const BlendValues<Scalar, 12>& values, const Vec3& centre, const double* rest, Index count,
  double* posed);

/// blend_tile, affine_moves and posed = rest + moves for the first `count` vertices, in one.
void pose_tile(const WeightTiles<float>& weights, Index tile, const BlendValues<float, 12>& values,
  const TilePoints<float>& points, const TilePoints<float>& rest, Index count, float* posed);

} // namespace bindpose

#endif
