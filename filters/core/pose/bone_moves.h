#ifndef bindpose_pose_bone_moves_h
#define bindpose_pose_bone_moves_h

#include "pose/skinning.h"
#include "pose/weight_tiles.h"

namespace bindpose
{

/// A bone that stretches or twists, in a frame of its own: z along it from its head on, x and y
/// across.
template <typename Scalar>
struct BoneFrame
{
  Scalar coordinates[3][4]; ///< from a point (and one) to x, y and z
  /// Under the transform: four times those of x and y, and all that the stretch adds.
  Scalar directions[3][3];
  Scalar per_length; ///< endpoint weight of z, before it is clamped to 0 to 1
  Scalar head_turns, more_turns; ///< the twist at the head, and what is added up to the tail
  bool twists;
};

template <typename Scalar>
struct BoneFrames
{
  std::vector<std::int32_t> of_column; ///< -1: neither stretches nor twists
  std::vector<BoneFrame<Scalar>> frames;
};

/// @param centre what the tiles' points are less (load_points()).
template <typename Scalar>
BoneFrames<Scalar> bone_frames(
  const std::vector<BoneChange>& bones, const std::vector<Affine>& transforms, const Vec3& centre);

/// moves += what stretches and twists add to linear blending, see Skinning::stretchable_bones(). A
/// turn is right to the last digits of a Scalar.
/// @param endpoints #V x #handles endpoint weights, or of size 0.
/// @param first the tile's first vertex; @param count its vertices.
template <typename Scalar>
void add_bone_moves(const WeightTiles<Scalar>& weights, const BoneFrames<Scalar>& bones,
  WeightsView endpoints, Index first, Index count, const TilePoints<Scalar>& points,
  TilePoints<Scalar>& moves);

} // namespace bindpose

#endif
