#ifndef bindpose_pose_found_rotations_h
#define bindpose_pose_found_rotations_h

#include "pose/pose.h"

namespace bindpose
{

/// Return the pose for a method that finds rotations (as-rigid-as-possible): a handle in mode
/// `automatic` that only moves gets mode `position`, so that the method finds its rotation; one
/// that the pose rotates, scales, stretches or twists gets mode `full`, and so does a region. A
/// handle only moves if its transform relative to its parent, or its transform in the world, is a
/// translation. Other modes stay.
Pose with_found_rotations(const Handles& handles, const Pose& pose);

} // namespace bindpose

#endif
