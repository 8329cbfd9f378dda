#ifndef bindpose_skinning_skinning_h
#define bindpose_skinning_skinning_h

// Skinning methods: linear blending, dual quaternions, optimized centers of rotation, and
// stretchable, twistable bones.

#include "base/execution.h"
#include "skinning/points_output.h"
#include "handles/handles.h"
#include "pose/bone_change.h"
#include "pose/pose.h"
#include "skinning/weight_tiles.h"

#include <optional>

namespace bindpose
{

/// #V x 3 coordinates in single precision, for display.
using FloatPoints = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Options of Skinning::bind().
struct SkinningOptions
{
  /// Store weights and transforms as floats: this takes half the memory and half the time. The
  /// error of a point is about 1e-7 of its displacement. Points that do not move are bit-identical
  /// to the rest pose.
  bool single_precision = false;
  /// Threshold (at least 0, less than 1): weights whose absolute value is at most this count as
  /// zero. 0: no nonzero weight is dropped.
  double smallest_weight = 0.0;
  /// Maximum number of weights per row. The largest ones are kept; if several are equal, those in
  /// the first columns. 0: all weights are kept.
  Index influences = 0;
  /// A center near the shape. Positions are computed relative to the center, because single
  /// precision is most accurate near 0. Empty: the mean of a few of the rest points. If a center is
  /// given, the result of a vertex has the same bits whichever other vertices are computed with it.
  std::optional<Vec3> center;
};

/// Linear blend and dual quaternion skinning. Weights are bound once and can then be used for many
/// poses.
///
/// If a row of weights does not sum to one, the difference is the weight of the rest position: v' =
/// v + sum_j w_j (T_j v - v). If it sums to one, this is v' = sum_j w_j T_j v. Therefore a vertex
/// whose weights are all zero does not move (instead of moving to the origin), and identity
/// transforms give bit-identical positions.
///
///     Skinning skinning;
///     skinning.bind(context, weights);
///     skinning.linear_blend(context, rest, transforms, posed);
///
/// Memory: 8 bytes (4 in single precision) for each nonzero weight. If a column has a nonzero
/// weight in a tile of 8 (16) consecutive vertices, the zeros of the column in this tile are
/// stored, too. Cost: one blend of 3x4 matrices per vertex; the vertices of a tile are blended
/// together. The result has the same bits for any number of threads and on any machine.
class Skinning
{
public:
  /// Copy the nonzero weights, #V x #handles. If the options drop weights of a row, the kept
  /// weights are scaled so that the row sum does not change. (They are not scaled if the sum of all
  /// weights or of the kept weights is at most zero.) Return invalid_input if an option is out of
  /// range or a weight is not finite; the message contains the vertex and the handle column.
  ///
  /// The report has row_sum_error, the largest |row sum - 1|; if it is above 1e-6, a warning
  /// contains it. If the options can drop weights, the report also has counts.dropped_weights and
  /// dropped_share, the largest sum of |weights| that was dropped from a row. If no weight is
  /// negative, the error of a point is at most dropped_share times d. Here d is the largest
  /// distance between two positions to which single handles transform the point.
  Status bind(ExecutionContext& context, WeightsView weights, const SkinningOptions& options = {});

  /// Compute v' = sum_j w_j T_j v (Magnenat-Thalmann et al. 1988). `transforms` has one entry per
  /// handle. `rest` and `posed` are #V x 3 and must be different arrays. The status is ok,
  /// canceled, or invalid_input if an array has the wrong size.
  Status linear_blend(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, PointsOutput posed) const;

  /// Apply linear_blend() to many instances of the shape in one call. Each instance has its own
  /// transforms. Weights and points are read once for all instances. The weights must be bound in
  /// single precision; otherwise the status is invalid_input.
  /// @param posed #V x 3 for each instance, row by row.
  /// @param placements one affine map per instance, applied after the blend; empty: none.
  Status linear_blend_many(ExecutionContext& context, PointsView rest,
    const std::vector<std::vector<Affine>>& transforms, const std::vector<float*>& posed,
    const std::vector<Affine>& placements = {}) const;
  Status linear_blend_many(ExecutionContext& context, PointsView rest,
    const std::vector<std::vector<Affine>>& transforms, std::vector<FloatPoints>& posed,
    const std::vector<Affine>& placements = {}) const;

  /// Transform normals by the blended transforms of linear_blend(): multiply by the cofactor matrix
  /// of the blended linear part and normalize to unit length. A normal whose transformed length is
  /// zero keeps its rest direction.
  Status linear_blend_normals(ExecutionContext& context, PointsView rest_normals,
    const std::vector<Affine>& transforms, PointsOutput posed_normals) const;

  /// Deform by dual quaternion skinning (Kavan et al. 2008). Each transform is split into two
  /// parts: a scale and shear about the handle's pivot, and a rigid motion. The scale and shear
  /// parts are blended linearly and applied first. The rigid motions are blended as dual
  /// quaternions. At each vertex, the reference is the handle with the largest weight (the first
  /// one if several are equal). The quaternions q and -q represent the same rotation; the one that
  /// is closer to the quaternion of the reference is used. If both are equally close (rotations
  /// that differ by exactly 180 degrees), the one with a nonnegative w component is used. The blend
  /// normalizes the sum of the weights implicitly. A vertex whose weights are all zero does not
  /// move. `pivots` is #handles x 3.
  Status dual_quaternion(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, PointsView pivots, PointsOutput posed) const;
  Status dual_quaternion_normals(ExecutionContext& context, PointsView rest_normals,
    const std::vector<Affine>& transforms, PointsView pivots, PointsOutput posed_normals) const;

  /// Deform by skinning about centers of rotation (Le and Hodgins 2016). A vertex rotates by the
  /// handles' blended quaternions (signs as in dual_quaternion) about its center, which moves by
  /// linear_blend. The scale and shear parts of the transforms are blended linearly and applied
  /// before the rotation. Therefore a twist does not change the distance from the axis if the
  /// center is on the axis, and a bent joint does not bulge as with dual quaternions. The result is
  /// exact if all handles have the same affine map.
  /// @param centers #V x 3 at rest, from rotation_centers().
  Status centers_of_rotation(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, PointsView centers, PointsOutput posed) const;
  Status centers_of_rotation_normals(ExecutionContext& context, PointsView rest_normals,
    const std::vector<Affine>& transforms, PointsOutput posed_normals) const;

  /// Deform by stretchable, twistable bones (Jacobson and Sorkine 2011). A bone with head a and
  /// tail b first moves a point p to a + K (p - a) + e (stretch - 1) (b - a). Here e is the
  /// endpoint weight (0 at the head, 1 at the tail). K is the rotation about the bone by the angle
  /// (1 - e) (twist of the head) + e (twist of the tail). Therefore a stretch translates the points
  /// beyond the tail instead of scaling them, and a twist keeps the distance from the bone. Then
  /// the transforms are blended as in linear_blend. If no bone stretches or twists, the result is
  /// bit-identical to linear_blend.
  /// @param bones one per handle; handles without stretch and twist are blended as in linear_blend.
  /// @param endpoints #V x #handles, 0 to 1 in the bones' columns. A NaN, or a matrix of size 0,
  /// selects the position of the point along the bone (fraction_along_bone).
  Status stretchable_bones(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
    WeightsView endpoints, PointsOutput posed) const;

  Index vertex_count() const { return this->vertices_; }
  Index handle_count() const { return this->handles_; }
  /// Return the number of nonzero weights.
  Index weight_count() const { return this->weight_count_; }

private:
  Status check(PointsView rest, const std::vector<Affine>& transforms) const;
  Status check_pivots(PointsView pivots) const;
  template <typename Scalar>
  bool pack(ExecutionContext& context, WeightsView weights, const SkinningOptions& options,
    WeightTiles<Scalar>& tiles);
  template <typename Scalar>
  const WeightTiles<Scalar>& tiles() const;
  template <typename Scalar>
  bool blend_affine(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, bool normals, PointsOutput posed) const;
  template <typename Scalar>
  bool blend_dual(ExecutionContext& context, PointsView rest, const std::vector<Affine>& transforms,
    PointsView pivots, bool normals, PointsOutput posed) const;
  template <typename Scalar>
  bool blend_about(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, const PointsView* centers, PointsOutput posed) const;
  template <typename Scalar>
  bool blend_bones(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
    WeightsView endpoints, PointsOutput posed) const;
  /// Return the center of the options, or else a point near the middle of the points.
  Vec3 center_of(PointsView points) const;

  std::optional<Vec3> center_; ///< SkinningOptions::center
  Index vertices_ = 0;
  Index handles_ = 0;
  Index weight_count_ = 0;
  bool is_single_precision_ = false;
  WeightTiles<float> single_tiles_; ///< weights in single precision
  WeightTiles<double> double_tiles_; ///< weights in double precision
  /// Reference of each vertex: the handle with its largest weight. Padded to whole tiles.
  std::vector<std::int32_t> reference_handles_;
};

/// Compute the transforms that skinning uses. A handle in mode full or ends uses its transform. A
/// handle in mode position or tail uses the translation of its pivot or tail. A free handle uses
/// the identity, and a warning contains the names of all free handles.
Status skinning_transforms(
  const Handles& handles, const Pose& pose, std::vector<Affine>& transforms);

/// Return stretch and twist of the bones in mode full or ends; other handles have none.
std::vector<BoneChange> bone_changes(const Handles& handles, const Pose& pose);

/// Return the handles' heads, #handles x 3.
Points handle_pivots(const Handles& handles);

} // namespace bindpose

#endif
