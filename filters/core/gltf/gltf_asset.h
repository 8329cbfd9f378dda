#ifndef bindpose_gltf_gltf_asset_h
#define bindpose_gltf_gltf_asset_h

// A glTF file whose meshes get a new skin. Everything else in the file is kept.

#include "geometry/mesh.h"
#include "gltf/gltf_document.h"
#include "gltf/gltf_joints.h"
#include "gltf/gltf_skin.h"

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
  /// Points and lines of a mesh get the weights of the nearest vertex of a triangle.
  /// @param joints in the rest pose; GltfJoint::rest is in scene coordinates
  /// @param weights #V x #joints, see write_gltf_skin()
  /// @param maximum_influences maximum number of weights kept per vertex; 0: no limit
  ///
  /// Report: counts.joints, counts.dropped_weights, sets, dropped_share, rest_joint (see
  /// write_gltf_skin()), losses[] (one phrase for each lost motion).
  Status set_skin(
    const std::vector<GltfJoint>& joints, const Weights& weights, Index maximum_influences);

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

  Status replace_skins(
    const std::vector<GltfJoint>& joints, const Weights& weights, Index maximum_influences);
  GltfJointNodes add_skeleton(
    const std::vector<GltfJoint>& joints, bool rest_joint, Status& status);

  GltfDocument document_;
  Points points_;
  Triangles triangles_;
  std::vector<Part> parts_;
  std::vector<Eigen::Affine3d> node_to_scene_;
  /// Per node: the transform from the mesh to the scene.
  std::vector<Eigen::Affine3d> mesh_to_scene_;
  int scene_ = 0; ///< id of the default scene
  std::vector<int> parents_; ///< per node: id of the parent node, or -1
  std::vector<char> animated_; ///< per node: whether an animation moves the node itself
};

} // namespace bindpose

#endif
