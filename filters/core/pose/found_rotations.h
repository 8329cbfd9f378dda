#ifndef bindpose_pose_found_rotations_h
#define bindpose_pose_found_rotations_h

#include "pose/pose.h"

namespace bindpose
{

/// Return a copy of the pose for a method that computes rotations itself (as-rigid-as-possible).
/// Only the modes of handles in mode `automatic` are changed. A handle counts as translated if its
/// transform, in the world or relative to the parent, is a translation. It counts as at rest if one
/// of these transforms is the identity.
/// - A point, a cage vertex or a bone that is only translated gets mode `position`, so that the
///   method computes its rotation. A point or cage vertex at rest also gets mode `position`.
/// - A handle that is rotated, scaled, stretched or twisted gets mode `full`. A region and a bone
///   at rest (such as a bone that only moves with its parent) also get mode `full`.
Pose resolve_automatic_modes(const Handles& handles, const Pose& pose);

} // namespace bindpose

#endif
