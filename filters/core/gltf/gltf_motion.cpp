// Reader of the motion in a glTF file (see gltf_motion.h).
#include "gltf/gltf_motion.h"

#include "gltf/gltf_frames.h"
#include "gltf/gltf_file.h"
#include "gltf/gltf_skin_reader.h"

#include <optional>
#include <set>
#include <utility>

namespace bindpose
{

namespace
{
/// Return the nodes with an invertible transform as joints.
GltfSkinJoints joints_of_nodes(const tinygltf::Model& model, const GltfNodes& nodes)
{
  const std::vector<Eigen::Affine3d> global = nodes.scene_transforms();
  std::vector<int> ids;
  std::vector<Eigen::Affine3d> rests;
  for (std::size_t n = 0; n < global.size(); ++n)
  {
    if (global[n].inverse().matrix().allFinite())
    {
      ids.push_back(static_cast<int>(n));
      rests.push_back(global[n]);
    }
  }
  if (ids.empty())
  {
    throw GltfError("the file has no node with an invertible transform");
  }
  return read_gltf_joints(model, nodes, ids, rests);
}

void read_motion(const GltfContent& content, GltfMotion& motion, Status& status)
{
  const tinygltf::Model& model = content.model;
  const GltfAccessors accessors(model, content.bytes.size());
  const GltfNodes nodes = read_gltf_nodes(model);
  GltfSkinJoints joints = joints_of_nodes(model, nodes);
  std::set<int> animated_nodes;
  const std::optional<std::string> name = read_gltf_frames(model, accessors, nodes, joints.nodes,
    motion.frames, motion.frames_per_second, &animated_nodes);
  motion.animation = name.value_or("");
  motion.animations = static_cast<Index>(model.animations.size());
  for (const int node : joints.nodes)
  {
    motion.animated.push_back(static_cast<char>(animated_nodes.count(node)));
  }
  motion.joints = std::move(joints.joints);
  motion.buffer_files = content.files.paths;
  status.report.set("counts.joints", motion.joints.size());
  status.report.set("counts.frames", motion.frames.size());
  status.report.set("counts.animations", motion.animations);
}
} // namespace

Status read_gltf_motion(ExecutionContext& context, const std::string& path, GltfMotion& motion)
{
  motion = GltfMotion();
  return read_gltf_file(context, path,
    [&](const GltfContent& content, Status& status) { read_motion(content, motion, status); });
}

Status read_gltf_motion(const std::string& path, std::string bytes, GltfMotion& motion)
{
  motion = GltfMotion();
  return read_gltf_bytes(path, std::move(bytes),
    [&](const GltfContent& content, Status& status) { read_motion(content, motion, status); });
}

} // namespace bindpose
