// Displacements by stretchable, twistable bones (Jacobson and Sorkine 2011), for a tile of
// vertices.
//
// At a point (x, y, z) of a bone's frame the endpoint weight is e = z / length, clamped to [0, 1].
// The twist angle is a = (1 - e) head + e tail, where `head` and `tail` are the twists at the ends.
// `vector` points from the head to the tail. Twist and stretch displace the point by
//
//   ( -sin(a) y - (1 - cos(a)) x,  sin(a) x - (1 - cos(a)) y,  0 )  +  e (stretch - 1) vector.
//
// With s = sin(a / 2) and c = cos(a / 2), sin(a) = 2 s c and 1 - cos(a) = 2 s^2. The products s c
// and s^2 are exactly zero without a twist. If a whole turn is subtracted from the angle a, both s
// and c change their signs, but s c and s^2 do not change. Therefore the angle a is first reduced
// to the range from minus half a turn to half a turn. The power series are evaluated at a / 4,
// which is at most an eighth of a turn, so few terms suffice.
#include "skinning/bone_moves.h"

#include "base/packs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
/// Number of terms of the power series. For angles up to an eighth of a turn, the first omitted
/// term is smaller than the round-off.
template <typename Scalar>
constexpr int terms = sizeof(Scalar) == 4 ? 5 : 9;

/// Adding and then subtracting this constant rounds a much smaller number to the nearest integer.
/// The constant is 1.5 * 2^23 for floats and 1.5 * 2^52 for doubles.
template <typename Scalar>
constexpr Scalar rounding_constant = sizeof(Scalar) == 4 ? 12582912.0 : 6755399441055744.0;

/// Return the coefficients of the power series of cos(x pi / 2) if first = 0, or of sin(x pi / 2)
/// if first = 1. Zero coefficients (every second power of x) are left out.
template <typename Scalar>
constexpr std::array<Scalar, terms<Scalar>> coefficients(int first)
{
  std::array<Scalar, terms<Scalar>> result{};
  double factor = first == 0 ? 1.0 : 0.5 * EIGEN_PI;
  for (int k = 0; k < terms<Scalar>; ++k)
  {
    result[k] = static_cast<Scalar>(factor);
    factor *= -(0.25 * EIGEN_PI * EIGEN_PI) / ((first + 2 * k + 1) * (first + 2 * k + 2));
  }
  return result;
}

/// Compute cos(x pi / 2) (first = 0) or sin(x pi / 2) / x (first = 1). Even and odd terms are
/// summed separately: two short chains of dependent operations are faster than one long chain.
/// @param square x^2.
/// @param fourth x^4.
template <int first, typename Scalar, typename Pack>
BINDPOSE_ALWAYS_INLINE void sum_series(const Pack& square, const Pack& fourth, Pack& sum)
{
  constexpr auto factors = coefficients<Scalar>(first);
  constexpr int last = terms<Scalar> - 1;
  static_assert(last % 2 == 0);
  Pack even = Pack{} + factors[last], odd = Pack{} + factors[last - 1];
#pragma GCC unroll 8
  for (int k = last - 2; k > 0; k -= 2)
  {
    even = even * fourth + factors[k];
    odd = odd * fourth + factors[k - 1];
  }
  sum = (even * fourth + factors[0]) + odd * square;
}

/// Compute the dot product of the four numbers `a` and (x, y, z, 1), where `point` is (x, y, z).
template <typename Scalar, typename Pack>
BINDPOSE_ALWAYS_INLINE void coordinate(const Scalar* a, const Pack (&point)[3], Pack& result)
{
  result = point[0] * a[0] + point[1] * a[1] + (point[2] * a[2] + a[3]);
}

template <typename Scalar>
BINDPOSE_ALWAYS_INLINE void add_tile_moves(const std::int32_t* columns, const Scalar* weights,
  Index columns_of_tile, const std::int32_t* frame_of_column, const BoneFrame<Scalar>* frames,
  const double* endpoints, Index handles, Index count, const Scalar* points, Scalar* moves)
{
  constexpr Index tile_lanes = WeightTiles<Scalar>::lanes;
  constexpr Index lanes = PackOf<Scalar>::lanes;
  using Pack = typename PackOf<Scalar>::Pack;
  const Pack zero = {}, one = zero + Scalar(1);
  for (Index begin = 0; begin < tile_lanes; begin += lanes)
  {
    const Pack point[3] = { pack_at(points + begin), pack_at(points + tile_lanes + begin),
      pack_at(points + 2 * tile_lanes + begin) };
    Pack sums[3] = { pack_at(moves + begin), pack_at(moves + tile_lanes + begin),
      pack_at(moves + 2 * tile_lanes + begin) };
    for (Index k = 0; k < columns_of_tile; ++k)
    {
      const std::int32_t column = columns[k];
      if (frame_of_column[column] < 0)
      {
        continue;
      }
      const BoneFrame<Scalar>& bone = frames[frame_of_column[column]];
      Pack x, y, e;
      coordinate(bone.coordinates[2], point, e);
      e *= bone.per_length;
      e = e > zero ? e : zero;
      e = e < one ? e : one;
      if (endpoints)
      {
        const double* const from = endpoints + column;
        Pack endpoint_weights = e;
        for (Index i = begin; i < std::min(begin + lanes, count); ++i)
        {
          endpoint_weights[i - begin] = static_cast<Scalar>(from[i * handles]);
        }
        e = endpoint_weights == endpoint_weights ? endpoint_weights
                                                 : e; // an endpoint weight of NaN is replaced by e
      }
      const Pack w = pack_at(weights + k * tile_lanes + begin);
      const Pack longer = w * e;
      for (int r = 0; r < 3; ++r)
      {
        sums[r] += longer * bone.directions[2][r];
      }
      if (bone.twists)
      {
        const Pack turns = e * bone.turn_difference + bone.head_turns;
        const Pack rounded = turns + rounding_constant<Scalar>;
        const Pack part = turns - (rounded - rounding_constant<Scalar>);
        const Pack square = part * part, fourth = square * square;
        Pack sine, cosine; // sine and cosine of a quarter of the angle
        sum_series<1, Scalar>(square, fourth, sine);
        sum_series<0, Scalar>(square, fourth, cosine);
        sine *= part;
        // With s = sin(a / 2) and c = cos(a / 2), compute half_s = s / 2 and c. Then
        // sin(a) / 4 = half_s c and (1 - cos(a)) / 4 = 2 half_s^2.
        const Pack half_s = sine * cosine, c = one - (sine + sine) * sine;
        const Pack half_sw = half_s * w;
        const Pack sin_w = half_sw * c, versine_w = half_sw * (half_s + half_s);
        coordinate(bone.coordinates[0], point, x);
        coordinate(bone.coordinates[1], point, y);
        const Pack dx = -(sin_w * y + versine_w * x), dy = sin_w * x - versine_w * y;
        for (int r = 0; r < 3; ++r)
        {
          sums[r] += dx * bone.directions[0][r] + dy * bone.directions[1][r];
        }
      }
    }
    for (int r = 0; r < 3; ++r)
    {
      pack_at(moves + r * tile_lanes + begin) = sums[r];
    }
  }
}

// This function is generated by a macro, because functions with SIMD clones cannot be templates.
#define BINDPOSE_OF_SCALAR(Scalar)                                                                 \
  BINDPOSE_SIMD_CLONES void add(const std::int32_t* columns, const Scalar* weights,                \
    Index columns_of_tile, const std::int32_t* frame_of_column, const BoneFrame<Scalar>* frames,   \
    const double* endpoints, Index handles, Index count, const Scalar* points, Scalar* moves)      \
  {                                                                                                \
    add_tile_moves(columns, weights, columns_of_tile, frame_of_column, frames, endpoints, handles, \
      count, points, moves);                                                                       \
  }
BINDPOSE_OF_SCALAR(float)
BINDPOSE_OF_SCALAR(double)
#undef BINDPOSE_OF_SCALAR
} // namespace

template <typename Scalar>
BoneFrames<Scalar> bone_frames(
  const std::vector<BoneChange>& bones, const std::vector<Affine>& transforms, const Vec3& center)
{
  BoneFrames<Scalar> result;
  for (std::size_t j = 0; j < bones.size(); ++j)
  {
    const BoneChange& bone = bones[j];
    const double length = bone.vector.stableNorm();
    if (!bone.any() || length == 0.0)
    {
      result.frame_of_column.push_back(-1);
      continue;
    }
    result.frame_of_column.push_back(static_cast<std::int32_t>(result.frames.size()));
    const Eigen::Matrix3d linear = transforms[j].leftCols<3>();
    Eigen::Matrix3d axes; // axes of the bone's frame, one per row
    axes.row(2) = bone.vector.stableNormalized();
    axes.row(0) = Vec3(axes.row(2)).unitOrthogonal();
    axes.row(1) = axes.row(2).cross(axes.row(0));
    const Vec3 origin = axes * (center - bone.head);
    const Vec3 directions[3] = { 4.0 * linear * axes.row(0).transpose(),
      4.0 * linear * axes.row(1).transpose(), linear * ((bone.stretch - 1.0) * bone.vector) };
    BoneFrame<Scalar> frame;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int i = 0; i < 3; ++i)
      {
        frame.coordinates[axis][i] = static_cast<Scalar>(axes(axis, i));
        frame.directions[axis][i] = static_cast<Scalar>(directions[axis][i]);
      }
      frame.coordinates[axis][3] = static_cast<Scalar>(origin[axis]);
    }
    // For a very short bone, 1 / length can exceed the largest Scalar. The value is clamped,
    // because the product of 0 and infinity would be NaN.
    frame.per_length =
      static_cast<Scalar>(std::min(1.0 / length, 1.0 * std::numeric_limits<Scalar>::max()));
    // If the number of turns is too large to be rounded to an integer, the angle is meaningless.
    // The twist is clamped in this case.
    const double limit = 0.1 * rounding_constant<Scalar>;
    const double head = bone.twist[0] / 360.0, more = (bone.twist[1] - bone.twist[0]) / 360.0;
    frame.head_turns = static_cast<Scalar>(head - std::nearbyint(head));
    frame.turn_difference = static_cast<Scalar>(std::clamp(more, -limit, limit));
    frame.twists = bone.twist != Eigen::Vector2d::Zero();
    result.frames.push_back(frame);
  }
  return result;
}

template <typename Scalar>
void add_bone_moves(const WeightTiles<Scalar>& weights, const BoneFrames<Scalar>& bones,
  WeightsView endpoints, Index first, Index count, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves)
{
  const auto tile = static_cast<std::size_t>(weights.tile_of(first));
  const Index begin = weights.start[tile], columns = weights.start[tile + 1] - begin;
  add(weights.columns.data() + begin, weights.weights.data() + weights.weight_of(begin, 0), columns,
    bones.frame_of_column.data(), bones.frames.data(),
    endpoints.size() > 0 ? endpoints.data() + first * endpoints.cols() : nullptr, endpoints.cols(),
    count, &points.at[0][0], &moves.at[0][0]);
}

#define BINDPOSE_INSTANTIATE(Scalar)                                                               \
  template BoneFrames<Scalar> bone_frames(                                                         \
    const std::vector<BoneChange>&, const std::vector<Affine>&, const Vec3&);                      \
  template void add_bone_moves(const WeightTiles<Scalar>&, const BoneFrames<Scalar>&, WeightsView, \
    Index, Index, const TilePoints<Scalar>&, TilePoints<Scalar>&);
BINDPOSE_INSTANTIATE(float)
BINDPOSE_INSTANTIATE(double)
#undef BINDPOSE_INSTANTIATE

} // namespace bindpose
