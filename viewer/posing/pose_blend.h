#ifndef bindpose_posing_pose_blend_h
#define bindpose_posing_pose_blend_h

#include "pose/pose.h"
#include "weights/handles.h"

namespace bindpose
{

/// A handle's transform as a person types it: about its pivot, first scaled, then turned about x,
/// then y, then z, then moved.
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
HandleValues values_of(const Handle& handle, const HandlePose& pose);
/// The pose with these values; its mode stays.
HandlePose with_values(const Handle& handle, const HandlePose& pose, const HandleValues& values);

/// Between two poses: pivots go straight, rotations by the shorter arc (slerp), scale and shear,
/// stretch and twist linearly. Modes are those of `a` up to share 1. Share 0 gives `a` and share 1
/// `b`, to the bit.
Pose blend(const Handles& handles, const Pose& a, const Pose& b, double share);

} // namespace bindpose

#endif
