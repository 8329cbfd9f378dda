#ifndef bindpose_pose_pivot_rotation_h
#define bindpose_pose_pivot_rotation_h

#include "pose/pose.h"
#include "weights/handles.h"

namespace bindpose
{

/// The rotation that fits best how all pivots move that are not free, and how the frames of full
/// handles turn, each as large as `reach`. The identity when nothing says more.
Eigen::Matrix3d pivot_rotation(const Handles& handles, const Pose& pose, double reach);

} // namespace bindpose

#endif
