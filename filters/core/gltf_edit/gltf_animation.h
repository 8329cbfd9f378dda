#ifndef bindpose_gltf_edit_gltf_animation_h
#define bindpose_gltf_edit_gltf_animation_h

// The frames of a skin as an animation of a glTF document.

#include "base/execution.h"
#include "gltf_edit/gltf_document.h"
#include "gltf_edit/gltf_joints.h"
#include "gltf_edit/gltf_pose_error.h"
#include "gltf/gltf_skin.h"

namespace bindpose
{

/// Check the frames of a skin. Return invalid_input if the number of joints, points or normals of a
/// frame does not match, for values that are not finite floats, and if frames_per_second is not
/// between 0 and 1e6. A frame needs points only for morph targets.
Status check_frames(const GltfSkin& skin, GltfAnimation animation);

/// Append an animation with three tracks per joint.
/// @param nodes nodes of the joints, see append_joints()
/// @param stored for the error
/// @param largest_error is set to the largest error of a frame, see largest_pose_error()
/// @return canceled after a request, which is checked once per frame
Status append_joint_animation(ExecutionContext& context, GltfDocument& document,
  const GltfSkin& skin, const GltfJointNodes& nodes, const GltfStoredSkin& stored,
  double& largest_error);

/// Append one morph target per frame to the first primitive of a mesh, and an animation of their
/// weights. The weight of a target is one at the time of its frame and zero at the other frames.
void append_shape_animation(GltfDocument& document, const GltfSkin& skin, int mesh, int node);

} // namespace bindpose

#endif
