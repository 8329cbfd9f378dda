#ifndef bindpose_pose_found_rotations_h
#define bindpose_pose_found_rotations_h

#include "pose/pose.h"

namespace bindpose
{

/// Return the pose for a method that finds rotations (as-rigid-as-possible). A handle in mode
/// `automatic` gets mode `position`, so that the method finds its rotation, if it is a point or a
/// cage vertex that is at most translated, or a bone that is translated. It gets mode `full` if the
/// pose rotates, scales, stretches or twists it, if it is a bone at rest or where its parent
/// carries it, or if it is a region. A translation counts relative to the parent or in the world.
/// Other modes stay.
Pose with_found_rotations(const Handles& handles, const Pose& pose);

} // namespace bindpose

#endif
