#ifndef bindpose_pose_skinning_h
#define bindpose_pose_skinning_h

#include "base/execution.h"
#include "pose/pose.h"
#include "pose/weight_tiles.h"
#include "weights/handles.h"

namespace bindpose
{

/// #V x 3 coordinates in single precision, for drawing.
using FloatPoints = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Change of a bone along itself at rest, before its transform.
struct BoneChange
{
  Vec3 head = Vec3::Zero();
  Vec3 vector = Vec3::Zero(); ///< from head to tail
  double stretch = 1.0; ///< posed length / rest length
  Eigen::Vector2d twist = Eigen::Vector2d::Zero(); ///< degrees at head and tail, right-handed
  /// Report whether anything changes.
  bool any() const { return this->stretch != 1.0 || this->twist != Eigen::Vector2d::Zero(); }
};

struct SkinningOptions
{
  /// Store weights and transforms as floats: half the memory and twice the speed. The error of a
  /// point is about 1e-7 of its displacement. Points at rest are exact to the bit.
  bool single_precision = false;
  /// Weights of at most this absolute value count as zero; 0: only zeros do.
  double smallest_weight = 0.0;
  /// Number of largest weights of a row that are kept (of equal ones those of the first columns);
  /// 0: all.
  Index influences = 0;
};

/// Linear blend and dual quaternion skinning. Weights are bound once; points are moved many times.
///
/// If a row of weights does not sum to one, the difference counts as a weight of the rest position:
/// v' = v + sum_j w_j (T_j v - v). If it sums to one, this is v' = sum_j w_j T_j v. A row of zeros
/// therefore does not move, instead of moving to the origin, and identity transforms change no bit.
///
///     Skinning skinning;
///     skinning.bind(context, weights);
///     skinning.linear_blend(context, rest, transforms, posed);
///
/// Memory: 8 bytes (4 in single precision) for each nonzero weight, and for zeros next to them in
/// tiles of 8 (16) consecutive vertices. Cost: one blend of 3x4 matrices per vertex; the vertices
/// of a tile are blended together. The result has the same bits for any number of threads and on
/// any machine.
class Skinning
{
public:
  /// Copy the nonzero weights, #V x #handles. The weights that the options drop are distributed
  /// over the other weights of the row, in proportion. invalid_input, naming vertex and handle
  /// column, for a weight that is not finite; invalid_input for options out of range.
  ///
  /// The report has row_sum_error, the largest |row sum - 1|; above 1e-6 a warning states it. If
  /// the options can drop weights, it also has counts.dropped_weights and dropped_share, the
  /// largest sum of |weights| that a row lost. For weights of at least 0, the error of a point is
  /// at most dropped_share times the distance between the positions to which two handles would move
  /// it.
  Status bind(ExecutionContext& context, WeightsView weights, const SkinningOptions& options = {});

  /// Compute v' = sum_j w_j T_j v (Magnenat-Thalmann et al. 1988). `transforms` has one entry per
  /// handle. `rest` and `posed` are #V x 3 and must be different arrays. The status is ok,
  /// canceled or invalid_input (sizes).
  Status linear_blend(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, Points& posed) const;

  /// Blend many instances of the shape together, each with its own transforms. Weights and points
  /// are read once for all instances. The weights must be bound in single precision; otherwise the
  /// status is invalid_input.
  /// @param posed #V x 3 for each instance, row by row.
  /// @param placements one affine map per instance, applied after the blend; empty: none.
  Status linear_blend_many(ExecutionContext& context, PointsView rest,
    const std::vector<std::vector<Affine>>& transforms, const std::vector<float*>& posed,
    const std::vector<Affine>& placements = {}) const;
  Status linear_blend_many(ExecutionContext& context, PointsView rest,
    const std::vector<std::vector<Affine>>& transforms, std::vector<FloatPoints>& posed,
    const std::vector<Affine>& placements = {}) const;

  /// Compute the normals under the same blend: the cofactor matrix of the blended linear part, unit
  /// length. A normal that collapses to zero keeps its rest direction.
  Status linear_blend_normals(ExecutionContext& context, PointsView rest_normals,
    const std::vector<Affine>& transforms, Points& posed_normals) const;

  /// Dual quaternion skinning (Kavan et al. 2008). Each transform is split into a scale and shear
  /// about its pivot, which is blended linearly first, and a rigid motion, which is blended as a
  /// dual quaternion. Signs are aligned to the handle of the largest weight (the first of equal
  /// ones), so q and -q give the same result. A handle at exactly 180 degrees to it keeps the sign
  /// for which the real part of its rotation's quaternion is nonnegative. The blend itself
  /// normalizes rows; a row of zeros does not move. `pivots` is #handles x 3.
  Status dual_quaternion(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, PointsView pivots, Points& posed) const;
  Status dual_quaternion_normals(ExecutionContext& context, PointsView rest_normals,
    const std::vector<Affine>& transforms, PointsView pivots, Points& posed_normals) const;

  /// Skinning about centers of rotation (Le and Hodgins 2016). A vertex rotates by the handles'
  /// blended quaternions (signs as in dual_quaternion) about its center, which moves by
  /// linear_blend. A scale and shear of a transform is blended linearly and applied before the
  /// rotation. A twist therefore keeps its radius if the center is on the axis, and a bent joint
  /// does not bulge as with dual quaternions. The result is exact if all handles have the same
  /// affine map.
  /// @param centers #V x 3 at rest, from rotation_centers().
  Status about_centers(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, PointsView centers, Points& posed) const;
  Status about_centers_normals(ExecutionContext& context, PointsView rest_normals,
    const std::vector<Affine>& transforms, Points& posed_normals) const;

  /// Stretchable, twistable bones (Jacobson and Sorkine 2011). A bone with head a and tail b first
  /// moves a point p to a + K (p - a) + e (stretch - 1) (b - a). Here e is the endpoint weight (0
  /// at the head, 1 at the tail), and K rotates about the bone by the angle between both ends'
  /// twists at e. A stretch therefore translates the points beyond the tail instead of scaling
  /// them, and a twist keeps the radius. Then the transforms blend as in linear_blend. If no bone
  /// changes, the result equals that of linear_blend, bit for bit.
  /// @param bones one per handle; handles without a change are blended as in linear_blend.
  /// @param endpoints #V x #handles, 0 to 1 in the bones' columns. A NaN, or a matrix of size 0,
  /// selects the position of the point along the bone (projected_endpoint).
  Status stretchable_bones(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
    WeightsView endpoints, Points& posed) const;

  Index vertex_count() const { return this->vertices_; }
  Index handle_count() const { return this->handles_; }
  /// Number of nonzero weights.
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
    const std::vector<Affine>& transforms, bool normals, Points& posed) const;
  template <typename Scalar>
  bool blend_dual(ExecutionContext& context, PointsView rest, const std::vector<Affine>& transforms,
    PointsView pivots, bool normals, Points& posed) const;
  template <typename Scalar>
  bool blend_about(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, const PointsView* centers, Points& posed) const;
  template <typename Scalar>
  bool blend_bones(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
    WeightsView endpoints, Points& posed) const;

  Index vertices_ = 0;
  Index handles_ = 0;
  Index weight_count_ = 0;
  bool single_ = false;
  WeightTiles<float> floats_; ///< used in single precision
  WeightTiles<double> doubles_; ///< used in double precision
  /// Handle of each vertex's largest weight, padded to whole tiles.
  std::vector<std::int32_t> references_;
};

/// Compute the transforms that skinning uses. A handle in mode full or ends uses its transform. A
/// handle in mode position or tail uses the translation of its pivot or tail. A free handle uses
/// the identity, and a warning names all free handles.
Status skinning_transforms(
  const Handles& handles, const Pose& pose, std::vector<Affine>& transforms);

/// Return the changes of bones in mode full or ends along themselves; other handles have none.
std::vector<BoneChange> bone_changes(const Handles& handles, const Pose& pose);

/// Return the handles' heads, #handles x 3.
Points handle_pivots(const Handles& handles);

} // namespace bindpose

#endif
