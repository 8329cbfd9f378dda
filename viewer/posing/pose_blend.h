#ifndef bindpose_posing_pose_blend_h
#define bindpose_posing_pose_blend_h

#include "pose/pose.h"
#include "weights/handles.h"

namespace bindpose
{

/// A handle's transform as the window shows it, relative to the parent: a scale about the pivot,
/// rotations about x, then y, then z, and a translation.
struct HandleValues
{
  Vec3 translate = Vec3::Zero();
  Vec3 degrees = Vec3::Zero();
  double scale = 1.0;
  double stretch = 1.0; ///< bones
  Eigen::Vector2d twist = Eigen::Vector2d::Zero(); ///< bones, degrees at head and tail
  /// The transform has a shear, an uneven scale or a reflection, which have no field: the nearest
  /// rotation and the mean scale are told.
  bool more = false;
};
HandleValues values_of(const Handles& handles, const Pose& pose, std::size_t handle);
/// Return the pose with other values for one handle. Its mode stays; its descendants follow.
Pose with_values(
  const Handles& handles, const Pose& pose, std::size_t handle, const HandleValues& values);

/// Interpolate between two poses, per handle and relative to its parent: pivots, scale, shear,
/// stretch and twist linearly, rotations by the shorter arc (slerp). Modes are those of `a` below
/// share 1. Share 0 returns `a` and share 1 returns `b`, bit for bit; a handle that is the same in
/// both poses, with all its ancestors, keeps its bits for every share.
Pose blend(const Handles& handles, const Pose& a, const Pose& b, double share);
/// The same for poses that are relative already (relative_pose()).
Pose blend_relative(const Handles& handles, const Pose& a, const Pose& b, double share);

} // namespace bindpose

#endif
