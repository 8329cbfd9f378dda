#ifndef bindpose_pose_handle_hierarchy_h
#define bindpose_pose_handle_hierarchy_h

// Parents and children of handles: inherited transforms and parent-relative poses.

#include "pose/pose.h"

namespace bindpose
{

/// Return the indices of all handles such that each handle comes after its parent. If the parents
/// form a cycle, which check_handles() rejects, one handle of the cycle comes before its parent.
std::vector<Index> parents_first(const Handles& handles);

/// Return the transform that a child inherits from its posed parent. The child is attached at the
/// rest position `position`. If the parent is a bone that stretches or twists, the result is the
/// motion of the bone's cross-section at `position`, as in Skinning::stretchable_bones(). A child
/// at the tail inherits the whole stretch and the twist of the tail. A child at the head inherits
/// only the twist of the head.
Affine transform_for_child(const Handle& parent, const HandlePose& posed, const Vec3& position);
/// Return the transform that a handle inherits from its parent, or the identity for a root.
Affine inherited_transform(const Handles& handles, const Pose& pose, Index handle);

/// Convert world transforms to transforms relative to the parents, and back: world =
/// transform_for_child(parent) * relative. The transforms of roots, and of children whose parents
/// have a singular transform, are copied without conversion.
Pose relative_pose(const Handles& handles, const Pose& pose);
Pose absolute_pose(const Handles& handles, const Pose& relative);

/// Move a handle with its parent: the transform relative to the parent remains that of the base
/// pose. The base transform is kept bit for bit if the parent has not moved or if the parent's base
/// transform is singular. The parent must already have its final pose, see parents_first().
void follow_parent(const Handles& handles, const Pose& base, Index handle, Pose& pose);

/// Return the transform that applies `first`, then `second`.
Affine compose(const Affine& second, const Affine& first);
/// Compute the inverse of a transform. Return false, and leave `inverse` unchanged, if the
/// transform is singular.
bool invert(const Affine& transform, Affine& inverse);

} // namespace bindpose

#endif
