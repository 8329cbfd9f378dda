#ifndef bindpose_pose_bone_change_h
#define bindpose_pose_bone_change_h

#include "base/mesh_types.h"

namespace bindpose
{

/// A stretch and a twist of a bone. They are applied to the rest position, before the bone's
/// transform.
struct BoneChange
{
  Vec3 head = Vec3::Zero();
  Vec3 vector = Vec3::Zero(); ///< vector from head to tail at rest
  double stretch = 1.0; ///< posed length / rest length
  /// Twist at head and tail, degrees, right-handed.
  Eigen::Vector2d twist = Eigen::Vector2d::Zero();
  /// Report whether the bone stretches or twists.
  bool any() const { return this->stretch != 1.0 || this->twist != Eigen::Vector2d::Zero(); }
};

} // namespace bindpose

#endif
