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

/// What a bone does along itself, at rest: the transform comes afterwards.
struct BoneChange
{
  Vec3 head = Vec3::Zero();
  Vec3 vector = Vec3::Zero(); ///< from head to tail
  double stretch = 1.0; ///< posed length / rest length
  Eigen::Vector2d twist = Eigen::Vector2d::Zero(); ///< degrees at head and tail, right-handed
  /// Whether anything changes.
  bool any() const { return this->stretch != 1.0 || this->twist != Eigen::Vector2d::Zero(); }
};

struct SkinningOptions
{
  /// Weights and transforms as floats: half the memory, twice the speed, and points that are right
  /// to about 1e-7 of what they move by. At rest no bit moves all the same.
  bool single_precision = false;
  /// Weights of at most this size count as zero; 0: none but zeros.
  double smallest_weight = 0.0;
  /// The largest weights of a row that are kept, of equals those of the first columns; 0: all.
  Index influences = 0;
};

/// Linear blend and dual quaternion skinning: binds weights once, moves points many times.
///
/// Both take the share that a row of weights lacks from one (or has above it) to be at rest:
/// v' = v + sum_j w_j (T_j v - v). With rows that sum to one this is v' = sum_j w_j T_j v; a row of
/// zeros stays where it is instead of falling into the origin, and all-identity moves no bit.
///
///     Skinning skinning;
///     skinning.bind(context, weights);
///     skinning.linear_blend(context, rest, transforms, posed);
///
/// Memory: 8 bytes (4 in single precision) for each weight that is not zero, and for zeros beside
/// them in tiles of 8 (16) consecutive vertices. Cost: one blend of 3x4 matrices a vertex, tiles at
/// once. The same bits for any number of threads and on any machine.
class Skinning
{
public:
  /// Copies the non-zero weights, #V x #handles. What the options drop is shared out among what is
  /// left of the row, in proportion. invalid_input, naming vertex and handle column, for a weight
  /// that is not finite, and for options out of range. Report: row_sum_error, the largest |row sum
  /// - 1|; above 1e-6 there is a warning with the number; counts.dropped_weights and dropped_share,
  /// the largest sum of |weights| that a row lost: with weights of at least 0 no point is off by
  /// more than that share of the distance between the places where two handles would take it.
  Status bind(ExecutionContext& context, WeightsView weights, const SkinningOptions& options = {});

  /// v' = sum_j w_j T_j v (Magnenat-Thalmann et al. 1988). transforms: one a handle.
  /// rest and posed: #V x 3; posed may not be rest. Only cancelled or invalid_input (sizes).
  Status linear_blend(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, Points& posed) const;

  /// The same for many instances of the shape at once, each with transforms of its own: weights and
  /// points are read once for all. Of weights bound in single precision; invalid_input for others.
  /// @param posed #V x 3 for each instance, row by row.
  /// @param placements where each instance stands: an affine map after the blend; empty: none.
  Status linear_blend_many(ExecutionContext& context, PointsView rest,
    const std::vector<std::vector<Affine>>& transforms, const std::vector<float*>& posed,
    const std::vector<Affine>& placements = {}) const;
  Status linear_blend_many(ExecutionContext& context, PointsView rest,
    const std::vector<std::vector<Affine>>& transforms, std::vector<FloatPoints>& posed,
    const std::vector<Affine>& placements = {}) const;

  /// Normals under the same blend: the cofactor matrix of the blended linear part, unit length.
  /// A normal that collapses to zero keeps its rest direction.
  Status linear_blend_normals(ExecutionContext& context, PointsView rest_normals,
    const std::vector<Affine>& transforms, Points& posed_normals) const;

  /// Dual quaternion skinning (Kavan et al. 2008). Each transform is split into a scale and shear
  /// about its pivot, blended linearly first, and a rigid motion, blended as a dual quaternion.
  /// Signs are aligned to the handle of the largest weight (the first of equals), so q and -q give
  /// the same result; at exactly 180 degrees to it a handle keeps the sign in which its rotation's
  /// quaternion has a non-negative real part. Rows are normalised by the blend itself; a row of
  /// zeros rests. pivots: #handles x 3.
  Status dual_quaternion(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, PointsView pivots, Points& posed) const;
  Status dual_quaternion_normals(ExecutionContext& context, PointsView rest_normals,
    const std::vector<Affine>& transforms, PointsView pivots, Points& posed_normals) const;

  /// Skinning about centres of rotation (Le and Hodgins 2016): a vertex turns by the handles'
  /// blended quaternions (signs as in dual_quaternion) about its centre, which moves by
  /// linear_blend. A scale and shear of a transform is blended linearly and comes before the turn.
  /// So a twist keeps its radius where the centre lies on the axis, and a bent joint does not bulge
  /// as dual quaternions make it. Exact for one affine map of all handles.
  /// @param centres #V x 3 at rest, from rotation_centres().
  Status about_centres(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, PointsView centres, Points& posed) const;
  Status about_centres_normals(ExecutionContext& context, PointsView rest_normals,
    const std::vector<Affine>& transforms, Points& posed_normals) const;

  /// Stretchable, twistable bones (Jacobson and Sorkine 2011): a bone first moves a point by
  /// K (p - a) + e (stretch - 1) (b - a) from its head a on, where K turns about the bone by the
  /// angle between both ends' twists at the endpoint weight e (0 at the head, 1 at the tail); then
  /// the transforms blend as in linear_blend, which this is, bit for bit, where nothing changes. So
  /// a stretch moves what is beyond the tail along, instead of scaling it, and a twist keeps the
  /// radius.
  /// @param bones one a handle; handles without a change are like those of linear_blend.
  /// @param endpoints #V x #handles, 0 to 1, of the bones' columns; NaN, and a matrix of size 0:
  /// where the point is along the bone (projected_endpoint).
  Status stretchable_bones(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
    WeightsView endpoints, Points& posed) const;

  Index vertex_count() const { return this->vertices_; }
  Index handle_count() const { return this->handles_; }
  /// Non-zero weights.
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
    const std::vector<Affine>& transforms, const PointsView* centres, Points& posed) const;
  template <typename Scalar>
  bool blend_bones(ExecutionContext& context, PointsView rest,
    const std::vector<Affine>& transforms, const std::vector<BoneChange>& bones,
    WeightsView endpoints, Points& posed) const;

  Index vertices_ = 0;
  Index handles_ = 0;
  Index weight_count_ = 0;
  bool single_ = false;
  WeightTiles<float> floats_; ///< in single precision
  WeightTiles<double> doubles_; ///< else
  std::vector<std::int32_t> references_; ///< handle of the largest weight, for whole tiles
};

/// The transforms that skinning uses: those of handles in mode full; of a handle in mode position
/// or tail the translation of that, of a bone in mode ends its own; identity for a free handle,
/// with a warning that names them.
Status skinning_transforms(
  const Handles& handles, const Pose& pose, std::vector<Affine>& transforms);

/// What bones in mode full do along themselves; nothing for all other handles.
std::vector<BoneChange> bone_changes(const Handles& handles, const Pose& pose);

/// #handles x 3 pivots: the handles' heads.
Points handle_pivots(const Handles& handles);

} // namespace bindpose

#endif
