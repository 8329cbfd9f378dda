#ifndef bindpose_gltf_gltf_motion_h
#define bindpose_gltf_gltf_motion_h

#include "gltf/gltf_skin.h"

#include <string>
#include <vector>

namespace bindpose
{

/// The nodes of a glTF file as joints, and the first animation that moves a node. Meshes and skins
/// do not matter.
struct GltfMotion
{
  /// All nodes with an invertible transform. GltfJoint::rest is the node-to-scene transform without
  /// the animation.
  std::vector<GltfJoint> joints;
  std::vector<char> animated; ///< per joint: whether the animation moves the node itself
  std::vector<GltfFrame> frames; ///< GltfFrame::posed per joint; empty if there is no animation
  double frames_per_second = 24.0;
  std::string animation; ///< name of the animation
  Index animations = 0; ///< number of animations in the file
  std::vector<std::string> buffer_files; ///< other files from which buffers were read
};

/// Read the motion in a .gltf or .glb file. Nodes with a singular transform, by which some programs
/// hide things, are left out.
///
/// Report: counts.joints, counts.frames, counts.animations. Return invalid_input for the defects of
/// nodes and animations that read_gltf_skin() names, and if no node is left. See read_gltf_file()
/// for compressed files.
Status read_gltf_motion(ExecutionContext& context, const std::string& path, GltfMotion& motion);
/// Read the bytes of a glTF file that was made from the file `path`.
Status read_gltf_motion(const std::string& path, std::string bytes, GltfMotion& motion);

} // namespace bindpose

#endif
