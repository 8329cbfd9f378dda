#ifndef bindpose_gltf_gltf_skin_h
#define bindpose_gltf_gltf_skin_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace bindpose
{

/// Properties of a handle that glTF has no field for. They are stored as the object "bindpose" in
/// the extras of the joint's node.
struct GltfHandleExtras
{
  std::string kind;
  Vec3 head = Vec3::Zero(); ///< rest position of the handle; for a bone, of its head
  Vec3 tail = Vec3::Zero();
  Index region = 0;
  std::vector<std::array<Index, 3>> cage; ///< cage elements as joint ids; the third id may be -1
};

/// One joint of a skin: a column of the weights.
struct GltfJoint
{
  std::string name;
  Index parent = -1; ///< index of the parent joint, or -1
  /// Joint-to-mesh transform in the bind pose: the inverse of the file's inverse bind matrix.
  Eigen::Affine3d rest = Eigen::Affine3d::Identity();
  /// Joint-to-scene transform in the pose that the file's nodes define. The joint moves the mesh by
  /// the transform posed * rest^-1.
  Eigen::Affine3d posed = Eigen::Affine3d::Identity();
  /// Transform from the parent of the joint's node to the parent joint, or to the scene. Other
  /// nodes may be between both.
  Eigen::Affine3d to_parent_joint = Eigen::Affine3d::Identity();
  std::optional<GltfHandleExtras> handle_extras;
};

/// One frame of an animation.
struct GltfFrame
{
  /// Joint-to-scene transforms like GltfJoint::posed, one per joint; may be empty.
  std::vector<Eigen::Affine3d> posed;
  Points points; ///< posed positions of the vertices; 0 rows: computed from the joints
  Points normals; ///< normals of the vertices; 0 rows: no normals
};

/// The vertices of a primitive of a node.
struct GltfPart
{
  int node;
  int primitive; ///< index of the primitive in the mesh of the node
  Index first; ///< index of the first vertex in the points that were read
  Index count;
};

/// A triangle mesh with its skin (joints and weights) and an animation. Optional arrays have no
/// rows.
struct GltfSkin
{
  std::string name = "mesh";
  Points points;
  Points normals;
  /// Texture coordinates; the origin is at the lower left.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> texture;
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor> colors;
  Triangles triangles;
  std::vector<GltfJoint> joints; ///< joints of the skin; empty: a mesh without a skin
  /// #V x #joints. If the sum of a row is below one, the missing weight is assigned to the rest
  /// position.
  Weights weights;
  std::vector<GltfFrame> frames;
  double frames_per_second = 24.0;
  /// Files besides the glTF file from which buffers were read; not used by write_gltf_skin().
  std::vector<std::string> buffer_files;
};

/// The form in which an animation is stored.
enum class GltfAnimation
{
  joints, ///< translations, rotations and scales of the joints
  morph ///< one morph target per frame
};

/// Options of write_gltf_skin().
struct GltfOptions
{
  bool binary = true; ///< true: .glb; false: .gltf with the binary data as base64 in the same file
  /// Maximum number of weights kept per vertex, 1 to 65535; 0: no limit. The largest weights are
  /// kept.
  Index influences = 0;
  GltfAnimation animation = GltfAnimation::joints;
};

/// Write a skinned mesh as glTF 2.0.
///
/// Weights: all nonzero weights are written. A weight of at most 2^-24 counts as zero, because
/// adding it to the float 1 gives 1. Weights are stored in sets of four weights per vertex. Set n
/// is the pair of attributes JOINTS_n and WEIGHTS_n. The vertex with the most weights determines
/// the number of sets. glTF requires rows that sum to one and no negative weights. If the sum of a
/// row is below one by more than 1e-6, the missing part becomes the weight of an additional joint
/// "rest". This joint does not move, so that skinning gives the same result. Negative weights are
/// removed; then rows whose sum is above one are divided by their sum. One warning reports how many
/// vertices had negative weights or a sum above one.
///
/// Joints: each joint is a node below its parent's node and moves with it. The nodes of joints
/// without a parent are below one node that is not a joint. Nodes contain translation, rotation and
/// scale. A matrix with shear is replaced by the rotation of its polar decomposition and the scales
/// along the joint's axes. Each replacement is computed relative to the replaced parents, so that
/// errors do not accumulate.
///
/// Report:
/// - counts.{vertices, triangles, joints, frames, dropped_weights}, sets, rest_joint (yes, no)
/// - dropped_share: the largest sum of the weights of one row that were dropped because of
///   `influences`; the remaining weights of the row are divided by their sum
/// - animation (joints, morph), file_bytes
/// - pose_error and animation_error: the largest distance between the position of a vertex
///   according to the file and its correct position, in bounding-box diagonals. The errors result
///   from shears and dropped weights.
///
/// Return invalid_input for sizes that do not match, values that are not finite floats, more than
/// 65534 joints, cyclic parents, names that are not UTF-8, and more than 4 GB.
Status write_gltf_skin(
  const std::string& path, const GltfSkin& skin, const GltfOptions& options = {});
/// Write the same file as the function above, with progress. A cancel request is checked once per
/// frame. No file is written after a cancel.
Status write_gltf_skin(ExecutionContext& context, const std::string& path, const GltfSkin& skin,
  const GltfOptions& options);

/// The warning of read_gltf_skin() about content that is not read contains this phrase.
constexpr const char* not_kept_phrase = "Bindpose does not keep";

/// Read the triangles of a .gltf or .glb file. Only one skin is read: the skin of the first skinned
/// mesh. All meshes that use this skin are read; other meshes are omitted. If the file has no
/// skinned mesh, all meshes are read, transformed by their nodes. Rows of weights are divided by
/// their sums, and the joint "rest" that write_gltf_skin() adds is removed. The first animation
/// that moves a joint is read. The animation is sampled at its keys if they are evenly spaced,
/// otherwise at 24 frames per second. Buffers may be binary chunks, base64 in the glTF file, or
/// separate files in or below the folder of the glTF file. Images are not read.
///
/// Report: counts.vertices, counts.triangles, counts.joints, counts.frames, counts.skins,
/// counts.animations, counts.materials, counts.unweighted_vertices, counts.skipped_primitives
/// (points and lines), counts.morph_targets, sets, not_kept[] (one phrase per type of content that
/// is not read: other animations, materials, textures, morph targets, cameras, lights, other meshes
/// …). One warning lists the content of not_kept.
///
/// Return invalid_input, with one sentence that contains the file name, for every defect: invalid
/// JSON, a glTF version other than 2.0, buffers and accessors that do not match, coordinates and
/// matrices that are not finite, joints out of range, cyclic nodes, unknown required extensions.
/// See read_gltf_file() for compressed files.
Status read_gltf_skin(ExecutionContext& context, const std::string& path, GltfSkin& skin);

} // namespace bindpose

#endif
