#ifndef bindpose_pose_bone_moves_h
#define bindpose_pose_bone_moves_h

#include "pose/skinning.h"
#include "pose/weight_tiles.h"

namespace bindpose
{

/// A bone that stretches or twists, in its own frame: z points from the head along the bone, x and
/// y are perpendicular to it.
template <typename Scalar>
struct BoneFrame
{
  Scalar coordinates[3][4]; ///< rows that map (point, 1) to x, y and z
  /// World directions after the transform: four times the x axis, four times the y axis, and the
  /// displacement of the tail by the stretch.
  Scalar directions[3][3];
  Scalar per_length; ///< factor from z to the endpoint weight, before clamping to [0, 1]
  /// Twist at the head, and its increase from head to tail, in turns.
  Scalar head_turns, more_turns;
  bool twists;
};

template <typename Scalar>
struct BoneFrames
{
  /// Index in frames; -1: the bone neither stretches nor twists.
  std::vector<std::int32_t> of_column;
  std::vector<BoneFrame<Scalar>> frames;
};

/// @param center origin of the tiles' points (load_points()).
template <typename Scalar>
BoneFrames<Scalar> bone_frames(
  const std::vector<BoneChange>& bones, const std::vector<Affine>& transforms, const Vec3& center);

/// Add to `moves` the displacements that stretch and twist add to linear blending, see
/// Skinning::stretchable_bones(). The rotations are accurate to the last digits of a Scalar.
/// @param endpoints #V x #handles endpoint weights, or of size 0.
/// @param first first vertex of the tile.
/// @param count number of its vertices.
template <typename Scalar>
void add_bone_moves(const WeightTiles<Scalar>& weights, const BoneFrames<Scalar>& bones,
  WeightsView endpoints, Index first, Index count, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves);

} // namespace bindpose

#endif
