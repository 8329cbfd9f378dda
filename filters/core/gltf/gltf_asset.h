#ifndef bindpose_gltf_gltf_asset_h
#define bindpose_gltf_gltf_asset_h

// A glTF file whose meshes get a new skin. Everything else in the file is kept.

#include "base/execution.h"
#include "geometry/mesh.h"
#include "gltf/gltf_document.h"
#include "gltf/gltf_joints.h"
#include "gltf/gltf_skin.h"
#include "gltf/gltf_weights.h"

#include <string>
#include <vector>

namespace bindpose
{

/// The meshes of the default scene of a glTF file, which can get one skeleton. The file is edited:
/// nodes, materials, textures, vertex attributes, meshes, cameras, animations, extras and unknown
/// extensions keep their values; skins, joints and weights are added or replaced.
class GltfAsset
{
public:
  /// Read a .gltf or .glb file. If a mesh already has a skin, its position is that of the bind
  /// pose.
  ///
  /// Report: counts.meshes (nodes with triangles), counts.vertices, counts.triangles,
  /// counts.skipped_primitives (points and lines).
  ///
  /// Return invalid_input for the defects that read_gltf_skin() names, and if the default scene has
  /// no triangles.
  Status read(const std::string& path);

  /// #V x 3, in scene coordinates. The vertices of a mesh occur once for each node with the mesh.
  const Points& points() const { return this->points_; }
  const Triangles& triangles() const { return this->triangles_; }

  /// Replace the skins of all nodes with triangles by one skeleton. Call this function once.
  ///
  /// The node-to-scene transform of a node with a mesh does not move a skinned mesh. Therefore it
  /// is included in the inverse bind matrices, and the rest pose does not change. If an animation
  /// moves such a node, its motion is lost, unless the motion is that of a common parent of all
  /// nodes with triangles: then the joints are added below this parent. Lost motions are warnings.
  ///
  /// Points and lines of a mesh get the weights of the nearest point of a triangle.
  /// @param skin joints, weights (#V x #joints, see write_gltf_skin()) and frames. Frames become an
  /// animation of the joints; animations of the file are kept. Other members are not used.
  /// Transforms of joints are in scene coordinates.
  /// @param maximum_influences maximum number of weights kept per vertex; 0: no limit
  ///
  /// Report: counts.joints, counts.frames, counts.dropped_weights, sets, dropped_share, rest_joint,
  /// pose_error, animation_error (see write_gltf_skin()), losses[] (one phrase for each lost
  /// motion).
  ///
  /// Return invalid_input for sizes that do not match and values that are not finite floats,
  /// canceled after a request, which is checked once per frame.
  Status set_skin(ExecutionContext& context, const GltfSkin& skin, Index maximum_influences);

  /// Write the file, as .glb or as .gltf with all data in the same file. Report: file_bytes.
  Status write(const std::string& path, bool binary) const;

private:
  /// The vertices of a primitive of a node.
  struct Part
  {
    int node;
    int primitive; ///< index of the primitive in the mesh of the node
    Index first; ///< first vertex in points_
    Index count;
  };
  struct Reader;

  Status check(const GltfSkin& skin, Index maximum_influences) const;
  Status replace_skins(ExecutionContext& context, const GltfSkin& skin, Index maximum_influences);
  /// Add the nodes of the joints, below the scene or below an animated parent of all nodes with
  /// triangles.
  GltfJointNodes add_skeleton(const std::vector<GltfJoint>& joints,
    const std::vector<Trs>& local_transforms, bool rest_joint, Status& status);
  void attach_skin(
    const std::vector<GltfJoint>& joints, const GltfWeights& packed, const GltfJointNodes& nodes);

  std::string path_; ///< the file, for messages
  GltfDocument document_;
  Points points_;
  Triangles triangles_;
  std::vector<Part> parts_;
  std::vector<Eigen::Affine3d> node_to_scene_;
  /// Per node: the transform from the mesh to the scene.
  std::vector<Eigen::Affine3d> mesh_to_scene_;
  int scene_ = 0; ///< id of the default scene
  std::vector<int> parents_; ///< per node: id of the parent node, or -1
  Index joint_animations_ = 0; ///< number of animations that move joints of the meshes' skins
  std::vector<char> animated_; ///< per node: whether an animation moves the node itself
};

} // namespace bindpose

#endif
