#ifndef bindpose_pose_pivot_rotation_h
#define bindpose_pose_pivot_rotation_h

#include "handles/handles.h"
#include "pose/pose.h"

namespace bindpose
{

/// Return one rotation for the whole pose. It best fits the motion of all constrained pivots and
/// tails, and the linear parts of the transforms of handles in mode full. A linear part counts like
/// three additional points, at the distance `pivot_radius` from the pivot along the three axes.
/// Return the identity if no handle determines the rotation.
Eigen::Matrix3d pivot_rotation(const Handles& handles, const Pose& pose, double pivot_radius);

} // namespace bindpose

#endif
