#ifndef bindpose_io_gltf_skin_h
#define bindpose_io_gltf_skin_h

#include "base/execution.h"
#include "base/mesh.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace bindpose
{

/// Data that glTF has no field for. They are stored in the node's extras, {"bindpose": {…}}.
struct GltfNote
{
  std::string kind;
  Vec3 head = Vec3::Zero(); ///< at rest
  Vec3 tail = Vec3::Zero();
  Index region = 0;
  std::vector<std::array<Index, 3>> cage; ///< joint ids; the third may be -1
};

/// One joint of a skin: a column of the weights.
struct GltfJoint
{
  std::string name;
  Index parent = -1; ///< index of the parent joint, or -1
  /// Joint to mesh in the bind pose: the inverse of the file's inverse bind matrix.
  Eigen::Affine3d rest = Eigen::Affine3d::Identity();
  /// Joint to scene in the pose of the nodes. The joint moves the mesh by posed * rest^-1.
  Eigen::Affine3d posed = Eigen::Affine3d::Identity();
  std::optional<GltfNote> note;
};

/// One frame of an animation.
struct GltfFrame
{
  std::vector<Eigen::Affine3d> posed; ///< as GltfJoint::posed, one per joint; may be empty
  Points points; ///< positions of the vertices; 0 rows: computed from the joints
  Points normals; ///< 0 rows: no normals
};

/// A triangle mesh with its skin and an animation. Optional parts have no rows.
struct GltfSkin
{
  std::string name = "mesh";
  Points points;
  Points normals;
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> texture; ///< origin at the lower left
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor> colors;
  Triangles triangles;
  std::vector<GltfJoint> joints; ///< empty: a mesh without a skin
  /// #V x #joints. If the sum of a row is below one, the missing weight belongs to the rest
  /// position.
  Weights weights;
  std::vector<GltfFrame> frames;
  double frames_per_second = 24.0;
};

enum class GltfAnimation
{
  joints, ///< translations, rotations and scales of the joints
  morph ///< one morph target per frame
};

struct GltfOptions
{
  bool binary = true; ///< .glb; else .gltf with the numbers as base64 in the same file
  /// Largest number of weights kept per vertex, 1 to 65535; 0: all. The largest weights are kept.
  Index influences = 0;
  GltfAnimation animation = GltfAnimation::joints;
};

/// Write a skinned mesh as glTF 2.0.
///
/// Weights: all nonzero weights are written. A weight counts as zero if a float cannot represent it
/// next to one (at most 2^-24). The number of sets JOINTS_n, WEIGHTS_n of four is that of the
/// vertex with the most weights. glTF requires rows that sum to one and no negative numbers. If the
/// sum of a row is below one by more than 1e-6, the missing part becomes the weight of an
/// additional joint "rest". This joint does not move, so that skinning gives the same result.
/// Negative weights and the excess of a row above one are removed and the row is divided by its
/// sum, with a warning.
///
/// Joints: each joint is a node below its parent's node and follows it. The nodes of joints without
/// a parent are below one node that is not a joint. Nodes contain translation, rotation and scale.
/// Any other matrix is replaced by the rotation of its polar decomposition and the scales along the
/// joint's axes. Each replacement is computed relative to the replaced parents, so that errors do
/// not accumulate.
///
/// Report:
/// - counts.{vertices, triangles, joints, frames, dropped_weights}, sets, rest_joint (yes, no)
/// - dropped_share: the largest part of a row that `influences` dropped; the rest of the row is
///   divided by its sum
/// - animation (joints, morph), file_bytes
/// - pose_error and animation_error: the largest distance between a vertex as the file moves it and
///   its correct position, in bounding-box diagonals. The errors result from shears and dropped
///   weights.
///
/// invalid_input: sizes that do not match, numbers that are not finite floats, more than 65534
/// joints, cyclic parents, names that are not UTF-8, more than 4 GB.
Status write_gltf_skin(
  const std::string& path, const GltfSkin& skin, const GltfOptions& options = {});
/// Write the same with progress and cancel per frame. No file is written after a cancel.
Status write_gltf_skin(const std::string& path, const GltfSkin& skin, const GltfOptions& options,
  ExecutionContext& context);

/// Read the triangles of a .gltf or .glb file. If a mesh uses a skin, read the first such skin and
/// all meshes that use it. Without a skin, read all meshes, transformed by their nodes. Rows of
/// weights are divided by their sums, and the joint "rest" that write_gltf_skin() adds is removed.
/// The first animation that moves a joint is sampled at its keys if they are evenly spaced, else at
/// 24 frames per second. Buffers may be in the file, in its text or in files next to it. Images are
/// not read.
///
/// Report: counts.vertices, counts.triangles, counts.joints, counts.frames, counts.skins,
/// counts.animations, counts.materials, counts.unweighted_vertices, counts.skipped_primitives
/// (points and lines), counts.morph_targets, sets, not_kept[] (one phrase per type of content that
/// is not read: other animations, materials, textures, morph targets, cameras, lights, other meshes
/// …). One warning lists not_kept.
///
/// invalid_input, with one sentence that contains the file name, for every defect: invalid JSON,
/// another version, buffers and accessors that do not match, coordinates and matrices that are not
/// finite, joints out of range, cyclic nodes, required extensions (compressed meshes).
Status read_gltf_skin(const std::string& path, GltfSkin& skin);

} // namespace bindpose

#endif
