#ifndef bindpose_pose_found_rotations_h
#define bindpose_pose_found_rotations_h

#include "pose/pose.h"

namespace bindpose
{

/// Return the pose for a method that computes rotations itself (as-rigid-as-possible). Only handles
/// in mode `automatic` change their mode. A translation is either relative to the parent or
/// relative to the world.
/// - A point, a cage vertex or a bone that the pose only translates gets mode `position`, so that
///   the method computes its rotation. So does a point or cage vertex that does not move.
/// - A handle that the pose rotates, scales, stretches or twists gets mode `full`. So does a
///   region, a bone at rest, and a bone that only moves with its parent.
Pose with_found_rotations(const Handles& handles, const Pose& pose);

} // namespace bindpose

#endif
