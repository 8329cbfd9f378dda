#ifndef bindpose_skinning_weight_tiles_h
#define bindpose_skinning_weight_tiles_h

#include "geometry/mesh.h"

#include <limits>
#include <type_traits>
#include <vector>

namespace bindpose
{

/// Weights in tiles of consecutive vertices. A tile stores the columns in which at least one of its
/// vertices has a weight. For each of these columns it stores the weights of all its vertices,
/// including zeros. The weights of a column in a tile fill one 64-byte register, so a blend
/// multiplies whole registers by the values of a handle. Scalar: float (tiles of 16) or double
/// (tiles of 8).
template <typename Scalar>
struct WeightTiles
{
  static constexpr Index lanes = 64 / sizeof(Scalar);

  std::vector<Index> start{ 0 }; ///< #tiles + 1: index of each tile's first column in `columns`
  std::vector<std::int32_t> columns; ///< handle of each column, ascending within a tile
  std::vector<Scalar> weights; ///< `lanes` weights for each column

  /// Return the tile of a vertex (first function), or the lane of the vertex in its tile (second
  /// function).
  static Index tile_of(Index vertex) { return vertex / lanes; }
  static Index lane_of(Index vertex) { return vertex % lanes; }
  Index weight_of(Index k, Index lane) const { return k * lanes + lane; }
};

/// The values that are blended: `entries` values per handle, such as the entries of a matrix.
template <typename Scalar, int entries>
struct BlendValues
{
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::int32_t, std::int64_t>;
  /// The sign bit of a Scalar.
  static constexpr Bits sign_bit = std::numeric_limits<Bits>::min();

  std::vector<Scalar> values; ///< `entries` values for each handle
  /// #handles x #handles, row by row: entry (j, r) is sign_bit if the values of handle j are
  /// negated in the sum of a vertex with reference handle r, else 0. Empty: all 0.
  std::vector<Bits> signs;
};

/// The blended values of a tile: one row per entry, one lane per vertex.
template <typename Scalar, int entries>
struct alignas(64) BlendedTile
{
  Scalar sums[entries][WeightTiles<Scalar>::lanes];
};

/// Compute sum_j w_j values_j for each vertex of the tile, in the order of the columns.
/// @param references reference handle of each vertex of the tile: the column of values.signs that
/// applies to the vertex. Null if values.signs is empty.
template <typename Scalar, int entries>
void blend_tile(const WeightTiles<Scalar>& weights, Index tile,
  const BlendValues<Scalar, entries>& values, const std::int32_t* references,
  BlendedTile<Scalar, entries>& blended);

/// Coordinates of a tile's vertices, one lane per vertex.
template <typename Scalar>
struct alignas(64) TilePoints
{
  Scalar at[3][WeightTiles<Scalar>::lanes];
};

/// Load the points of a tile, relative to the center. Lanes beyond `count` repeat the first point.
template <typename Scalar>
void load_points(const double* rest, Index count, const Vec3& center, TilePoints<Scalar>& points);

/// Compute the displacements of points by x -> x + A x + b, where A and b differ per vertex (3 x 4,
/// row by row).
template <typename Scalar>
void affine_moves(const BlendedTile<Scalar, 12>& blended, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves);

/// Compute the displacements of points by rigid motions. The blended values are sums of dual
/// quaternions (real part x, y, z, w, then dual part). Each sum is divided by the length of its
/// real part. If this length is zero, there is no displacement.
template <typename Scalar>
void dual_quaternion_moves(const BlendedTile<Scalar, 8>& blended, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves);

/// Write posed = rest + moves for the first `count` vertices.
template <typename Scalar>
void store_moved(const double* rest, Index count, const TilePoints<Scalar>& moves, double* posed);

/// Combine blend_tile, load_points, affine_moves and store_moved in one call.
template <typename Scalar>
void blend_points_of_tile(const WeightTiles<Scalar>& weights, Index tile,
  const BlendValues<Scalar, 12>& values, const Vec3& center, const double* rest, Index count,
  double* posed);

/// Combine blend_tile, affine_moves and posed = rest + moves for the first `count` vertices in one
/// call.
void pose_tile(const WeightTiles<float>& weights, Index tile, const BlendValues<float, 12>& values,
  const TilePoints<float>& points, const TilePoints<float>& rest, Index count, float* posed);

} // namespace bindpose

#endif
