#ifndef bindpose_skinning_bone_moves_h
#define bindpose_skinning_bone_moves_h

// Displacements by stretchable, twistable bones (Jacobson and Sorkine 2011), for tiles of vertices.

#include "pose/bone_change.h"
#include "pose/pose.h"
#include "skinning/weight_tiles.h"

namespace bindpose
{

/// A bone that stretches or twists, and the map to the bone's own frame. The z axis of this frame
/// points from the head along the bone; x and y are perpendicular to the bone.
template <typename Scalar>
struct BoneFrame
{
  Scalar coordinates[3][4]; ///< rows that map (point, 1) to x, y and z
  /// Directions in space after the bone's transform: four times the x axis, four times the y axis,
  /// and the displacement of the tail by the stretch. The factor four cancels the factor 1/4 of the
  /// computed sine and cosine terms.
  Scalar directions[3][3];
  /// 1 / length of the bone. The endpoint weight is z / length, clamped to [0, 1].
  Scalar per_length;
  /// Twist at the head, and twist at the tail minus twist at the head. Unit: full turns.
  Scalar head_turns, turn_difference;
  bool twists;
};

template <typename Scalar>
struct BoneFrames
{
  /// Per handle: index in `frames`; -1: the handle neither stretches nor twists.
  std::vector<std::int32_t> frame_of_column;
  std::vector<BoneFrame<Scalar>> frames;
};

/// Return the frames of all bones that stretch or twist.
/// @param center origin of the tiles' points (load_points()).
template <typename Scalar>
BoneFrames<Scalar> bone_frames(
  const std::vector<BoneChange>& bones, const std::vector<Affine>& transforms, const Vec3& center);

/// Add the displacements by stretch and twist to `moves`, which already contains the displacements
/// of linear blending; see Skinning::stretchable_bones(). The rotations are accurate to the last
/// digits of a Scalar.
/// @param endpoints #V x #handles endpoint weights, or of size 0.
/// @param first first vertex of the tile.
/// @param count number of vertices in the tile.
template <typename Scalar>
void add_bone_moves(const WeightTiles<Scalar>& weights, const BoneFrames<Scalar>& bones,
  WeightsView endpoints, Index first, Index count, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves);

} // namespace bindpose

#endif
