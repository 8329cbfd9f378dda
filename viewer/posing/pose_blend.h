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
  /// True if the transform has a shear, an uneven scale or a reflection, for which there are no
  /// fields. The other fields then contain the nearest rotation and the mean scale.
  bool more = false;
};
HandleValues values_of(const Handles& handles, const Pose& pose, std::size_t handle);
/// Return the pose with other values for one handle. Keep the handle's mode, and move its
/// descendants along.
Pose with_values(
  const Handles& handles, const Pose& pose, std::size_t handle, const HandleValues& values);

/// Interpolate between two poses, per handle and relative to its parent. Pivots, scale, shear,
/// stretch and twist change linearly; rotations turn by the shorter arc (slerp). `share` is the
/// fraction of the way: 0 returns `a` and 1 returns `b`, bit for bit. Below 1 the modes are those
/// of `a`. A handle that is equal in both poses, together with all its ancestors, keeps its bits
/// for every share.
Pose blend(const Handles& handles, const Pose& a, const Pose& b, double share);
/// The same for poses that are already relative (relative_pose()).
Pose blend_relative(const Handles& handles, const Pose& a, const Pose& b, double share);

} // namespace bindpose

#endif
