#ifndef bindpose_pose_pivot_rotation_h
#define bindpose_pose_pivot_rotation_h

#include "pose/pose.h"
#include "weights/handles.h"

namespace bindpose
{

/// Return the rotation that best fits the motion of all constrained pivots and tails and the linear
/// parts of full handles, each weighted as a frame of size `reach`. Return the identity if nothing
/// determines the rotation.
Eigen::Matrix3d pivot_rotation(const Handles& handles, const Pose& pose, double reach);

} // namespace bindpose

#endif
