#ifndef bindpose_gltf_gltf_frames_h
#define bindpose_gltf_gltf_frames_h

#include "gltf/gltf_model.h"
#include "gltf/gltf_skin.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace bindpose
{

/// Read the frames of the first animation that moves one of the joints or a node above it. The
/// animation is sampled at its keys if they are evenly spaced, otherwise at 24 frames per second.
/// Throw GltfError for keys that are not valid, more than 100,000 frames, and frames that need more
/// memory than is available.
/// @param joint_nodes node of each joint
/// @param frames GltfFrame::posed of each frame is set
/// @param frames_per_second is set if there is an animation
/// @param animated_nodes if not null, is set to the nodes that the animation moves themselves
/// @return the name of the animation, which may be empty; nothing if there is no animation
std::optional<std::string> read_gltf_frames(const tinygltf::Model& model,
  const GltfAccessors& accessors, GltfNodes nodes, const std::vector<int>& joint_nodes,
  std::vector<GltfFrame>& frames, double& frames_per_second,
  std::set<int>* animated_nodes = nullptr);

} // namespace bindpose

#endif
