#ifndef bindpose_poses_pose_blend_h
#define bindpose_poses_pose_blend_h

#include "handles/handles.h"
#include "pose/pose.h"

namespace bindpose
{

// Values of a handle's transform in the number fields of the window, and interpolation of poses.

/// A handle's transform relative to its parent, in the form in which the window shows it: a scale
/// about the pivot, rotations about x, then y, then z, and a translation.
struct HandleValues
{
  Vec3 translate = Vec3::Zero();
  Vec3 degrees = Vec3::Zero();
  double scale = 1.0;
  double stretch = 1.0; ///< for bones only
  /// Twist in degrees at head and tail, for bones only.
  Eigen::Vector2d twist = Eigen::Vector2d::Zero();
  /// True if the transform has a shear, a non-uniform scale or a reflection, which these fields
  /// cannot express. They then contain the nearest rotation and the mean scale.
  bool is_approximate = false;
};
HandleValues values_of(const Handles& handles, const Pose& pose, std::size_t handle);
/// Return the pose with new values for one handle. The descendants of the handle move with the
/// handle. All modes are kept.
Pose with_values(
  const Handles& handles, const Pose& pose, std::size_t handle, const HandleValues& values);

/// Interpolate between two poses. A handle's pose relative to the handle's parent is interpolated:
/// pivots, scale, shear, stretch and twist linearly, rotations along the shorter arc (slerp).
/// `fraction` is the interpolation parameter: 0 returns `a` and 1 returns `b`, bit for bit. Below 1
/// the modes are those of `a`. If a handle and all its ancestors are equal in both poses, the
/// handle's bits do not change.
Pose blend(const Handles& handles, const Pose& a, const Pose& b, double fraction);
/// Like blend(), for poses that are already relative (relative_pose()).
Pose blend_relative(const Handles& handles, const Pose& a, const Pose& b, double fraction);

} // namespace bindpose

#endif
