#ifndef bindpose_gltf_edit_gltf_asset_h
#define bindpose_gltf_edit_gltf_asset_h

// A glTF file whose meshes get a new skin. Everything else in the file is kept.

#include "base/execution.h"
#include "geometry/mesh.h"
#include "gltf_edit/gltf_document.h"
#include "gltf_edit/gltf_joints.h"
#include "gltf/gltf_file.h"
#include "gltf/gltf_scene_meshes.h"
#include "gltf/gltf_skin.h"
#include "gltf_edit/gltf_weights.h"

#include <optional>
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
  /// Read a .gltf or .glb file. A mesh with a skin has the position of its bind pose.
  ///
  /// Compressed meshes are decompressed; see read_gltf_file().
  ///
  /// Report: see read_gltf_scene(). Return invalid_input for the defects that read_gltf_skin()
  /// names, and if the default scene has no triangles.
  /// @param convert converts pictures in formats that glTF does not allow; null: they are left out
  Status read(ExecutionContext& context, const std::string& path, ConvertPicture convert = nullptr);
  /// Read the bytes of a glTF file that was made from the file `path`. Its nodes need not be kept,
  /// so set_skin() moves meshes to root nodes.
  Status read_bytes(const std::string& path, std::string bytes, ConvertPicture convert = nullptr);

  /// #V x 3, in scene coordinates. The vertices of a mesh occur once for each node with the mesh.
  const Points& points() const { return this->meshes_.points; }
  const Triangles& triangles() const { return this->meshes_.triangles; }
  /// The joints of the skins of the meshes, in scene coordinates. Empty if no mesh has a skin.
  const std::vector<GltfJoint>& joints() const { return this->meshes_.skin_joints.joints; }
  /// For each of these joints, its largest weight.
  const Eigen::RowVectorXd& largest_weights() const { return this->meshes_.largest_weights; }

  /// Replace the skins of all nodes with triangles by one skeleton. Call this function once.
  ///
  /// If all joints are among joints(), with the same names and rest positions, their nodes are
  /// kept, with their poses and animations. Otherwise, and if a vertex needs the joint "rest" (see
  /// write_gltf_skin()), new nodes are added.
  ///
  /// The node-to-scene transform of a node with a mesh does not move a skinned mesh. Therefore it
  /// is included in the inverse bind matrices, and the rest pose does not change. If an animation
  /// moves such a node, or a joint that is replaced, its motion is lost, unless the motion is that
  /// of a common parent of all nodes with triangles: then the joints are added below this parent.
  /// Lost motions are warnings.
  ///
  /// Points and lines of a mesh get the weights of the nearest point of a triangle.
  /// @param skin joints, weights (#V x #joints, see write_gltf_skin()) and frames. Frames become an
  /// animation of the joints; animations of the file are kept. Other members are not used.
  /// Transforms of joints are in scene coordinates.
  /// @param maximum_influences maximum number of weights kept per vertex; 0: no limit
  ///
  /// Report: counts.joints, counts.frames, counts.dropped_weights, sets, dropped_share, rest_joint,
  /// pose_error, animation_error (see write_gltf_skin()), kept_joints (yes, no), losses[] (one
  /// phrase for each lost motion).
  ///
  /// Return invalid_input for sizes that do not match and values that are not finite floats,
  /// canceled after a request, which is checked once per frame.
  Status set_skin(ExecutionContext& context, GltfSkin skin, Index maximum_influences);

  /// Set `bytes` to the bytes of the file; see GltfDocument::to_bytes().
  Status to_bytes(bool binary, std::string& bytes) const
  {
    return this->document_.to_bytes(binary, bytes);
  }
  /// Write the file, as .glb or as .gltf with all data in the same file. Report: file_bytes.
  Status write(const std::string& path, bool binary) const;

private:
  /// Set the document and the meshes to those of a file.
  void load(const GltfContent& content, const ConvertPicture& convert, Status& status);
  /// Set the path. If the status is an error, remove the document and the meshes.
  Status finish_reading(const std::string& path, Status status);
  Status check(const GltfSkin& skin, Index maximum_influences) const;
  Status replace_skins(ExecutionContext& context, GltfSkin& skin, Index maximum_influences);
  /// Return the index into joints() of each joint of a skin. Return nothing if a joint is not among
  /// them.
  std::optional<std::vector<Index>> find_joints(const std::vector<GltfJoint>& joints) const;
  /// Replace the joints of the skin by those of the file, and express the frames by them.
  GltfJointNodes keep_joints(const std::vector<Index>& ids, GltfSkin& skin) const;
  /// Add the nodes of the joints, below the scene or below an animated parent of all nodes with
  /// triangles.
  GltfJointNodes add_skeleton(const std::vector<GltfJoint>& joints,
    const std::vector<Trs>& local_transforms, bool rest_joint);
  /// Add a root node to the default scene. If the file has no scene, create one with all root
  /// nodes.
  void add_to_scene(int node);
  /// Return the nearest animated node that moves all meshes, or -1.
  int common_mover() const;
  /// Add a warning and an entry of losses[] for each motion that the meshes lose.
  void report_losses(bool keeps_joints, Status& status) const;
  /// Move the mesh of a node to a root node without a transform, and return this node.
  int move_mesh_to_root(int id);
  void copy_meshes_of_other_nodes();
  void keep_skin_properties(std::size_t from, int to);
  void attach_skin(const std::vector<GltfJoint>& joints, const GltfWeights& packed,
    const GltfJointNodes& nodes, bool keeps_joints);

  std::string path_; ///< the file, for messages
  bool is_converted_ = false; ///< whether the file was made from a file of another format
  GltfDocument document_;
  GltfSceneMeshes meshes_;
};

} // namespace bindpose

#endif
