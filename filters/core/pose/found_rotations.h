#ifndef bindpose_pose_found_rotations_h
#define bindpose_pose_found_rotations_h

#include "pose/pose.h"

namespace bindpose
{

/// Return a copy of the pose for a method that computes rotations itself (as-rigid-as-possible).
/// Only the modes of handles in mode `automatic` are changed. A handle counts as translated if its
/// world transform or its transform relative to the parent is a translation. It counts as at rest
/// if one of these transforms is the identity.
/// - Mode `position`: points and cage vertices that are translated or at rest, and translated
///   bones. The method computes the rotations of these handles.
/// - Mode `full`: all regions, bones at rest (such as a bone that only moves with its parent), and
///   all handles that are rotated, scaled, stretched or twisted.
Pose resolve_automatic_modes(const Handles& handles, const Pose& pose);

} // namespace bindpose

#endif
