#ifndef bindpose_pose_found_rotations_h
#define bindpose_pose_found_rotations_h

#include "pose/pose.h"

namespace bindpose
{

/// Return the pose for a method that finds rotations (as-rigid-as-possible). Only handles in mode
/// `automatic` change their mode.
/// - A point or a cage vertex that is at most translated gets mode `position`, so that the method
///   finds its rotation. So does a bone that is translated.
/// - A handle that the pose rotates, scales, stretches or twists gets mode `full`. So does a
///   region, and a bone at rest or at the position that its parent carries it to.
/// A translation counts if it is a translation relative to the parent or in the world.
Pose with_found_rotations(const Handles& handles, const Pose& pose);

} // namespace bindpose

#endif
