#ifndef bindpose_gltf_gltf_scene_meshes_h
#define bindpose_gltf_gltf_scene_meshes_h

// All triangles of a scene of a glTF file, and the nodes that move them.

#include "gltf/gltf_model.h"
#include "gltf/gltf_skin_reader.h"

#include <map>
#include <vector>

namespace bindpose
{

/// The meshes of the default scene. A mesh with a skin is in its bind pose: where its first joint
/// (of those with the fewest ancestors) moves it.
struct GltfSceneMeshes
{
  int scene = 0; ///< id of the scene
  Points points; ///< #V x 3, in scene coordinates
  Triangles triangles;
  std::vector<GltfPart>
    parts; ///< primitives of nodes with triangles, also those of points and lines
  std::vector<int> parents; ///< per node: id of the parent node, or -1
  std::vector<Eigen::Affine3d> node_to_scene; ///< per node
  std::vector<Eigen::Affine3d> mesh_to_scene; ///< per node: transform of its mesh in the bind pose
  /// The joints of the skins of these meshes. GltfJoint::rest is in scene coordinates.
  GltfSkinJoints skin_joints;
  Eigen::RowVectorXd largest_weights; ///< per joint: its largest weight
  std::vector<char> animated; ///< per node: whether an animation moves the node itself
  Index joint_animations = 0; ///< number of animations that move joints
  /// Per node with triangles: the nodes that move its whole mesh, the nearest first. They are the
  /// node and its ancestors, or for a skin the common ancestors of its joints.
  std::map<int, std::vector<int>> movers;
};

/// Read the meshes of the default scene. Throw GltfError for the defects that read_gltf_skin()
/// names, and if the scene has no triangles. Warn if meshes are not in the bind pose of their
/// skins.
///
/// Report: counts.meshes (nodes with triangles), counts.vertices, counts.triangles,
/// counts.skipped_primitives (points and lines).
GltfSceneMeshes read_gltf_scene(
  const tinygltf::Model& model, std::size_t file_size, Status& status);

} // namespace bindpose

#endif
