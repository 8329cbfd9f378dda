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

/// What glTF has no word for: it travels as the node's extras, {"bindpose": {…}}.
struct GltfNote
{
  std::string kind;
  Vec3 head = Vec3::Zero(); ///< at rest
  Vec3 tail = Vec3::Zero();
  Index region = 0;
  std::vector<std::array<Index, 3>> cage; ///< joints, the third may be -1
};

/// One joint of a skin: a column of the weights.
struct GltfJoint
{
  std::string name;
  Index parent = -1; ///< joint, or -1
  /// Joint to mesh when the skin was bound: the inverse of the file's inverse bind matrix.
  Eigen::Affine3d rest = Eigen::Affine3d::Identity();
  /// Joint to scene as the nodes stand. The joint moves the mesh by posed * rest^-1.
  Eigen::Affine3d posed = Eigen::Affine3d::Identity();
  std::optional<GltfNote> note;
};

/// A moment of an animation.
struct GltfFrame
{
  std::vector<Eigen::Affine3d> posed; ///< as GltfJoint::posed, one a joint; may be empty
  Points points; ///< where the vertices are; 0 rows: where the joints take them
  Points normals; ///< 0 rows: none
};

/// A triangle mesh, the skin on it and an animation of it. Optional parts have no rows.
struct GltfSkin
{
  std::string name = "mesh";
  Points points;
  Points normals;
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> texture; ///< origin at the lower left
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor> colors;
  Triangles triangles;
  std::vector<GltfJoint> joints; ///< none: a mesh without a skin
  /// #V x #joints. What a row lacks from one stays at rest.
  Weights weights;
  std::vector<GltfFrame> frames;
  double frames_per_second = 24.0;
};

enum class GltfAnimation
{
  joints, ///< the joints' translations, rotations and scales
  morph ///< each frame's points as a morph target
};

struct GltfOptions
{
  bool binary = true; ///< .glb; else .gltf with the numbers as base64 in the same file
  /// Weights of a vertex that are kept, the largest, 1 to 65535; 0: all.
  Index influences = 0;
  GltfAnimation animation = GltfAnimation::joints;
};

/// Writes a skinned mesh as glTF 2.0.
///
/// Weights: all that are not zero as a float beside one (at most 2^-24 counts as zero), in as many
/// sets JOINTS_n, WEIGHTS_n of four as the fullest vertex needs. glTF wants rows that sum to one
/// and no negative number: where a row lacks more than 1e-6, a further joint that rests, "rest",
/// holds what lacks, which is exactly what skinning does with it; negative weights, and what a row
/// has above one, are taken away and the row is divided by its sum, with a warning.
///
/// Joints: a node each, below its parent's, so that what hangs on a joint follows it; the top ones
/// below one node that is none. Nodes hold translation, rotation and scale: other matrices are
/// replaced by their polar decomposition's rotation and the scales along the joint's axes, each
/// below what its parents really hold, so that errors do not add up.
///
/// Report: counts.{vertices, triangles, joints, frames, dropped_weights}, sets, rest_joint (yes,
/// no), dropped_share (the largest part of a row that `influences` dropped; the rest of the row is
/// divided by its sum), animation (joints, morph), file_bytes, and pose_error and animation_error:
/// the largest distance, as a fraction of the diagonal, of a vertex as the file moves it from where
/// it belongs: what shears and dropped weights do.
///
/// invalid_input for sizes that do not fit, numbers that are not finite floats, more than 65534
/// joints, parents in a circle, names that are not UTF-8, more than 4 GB.
Status write_gltf_skin(
  const std::string& path, const GltfSkin& skin, const GltfOptions& options = {});
/// The same with progress and cancel, frame by frame; a cancelled file is not written.
Status write_gltf_skin(const std::string& path, const GltfSkin& skin, const GltfOptions& options,
  ExecutionContext& context);

/// Reads the triangles of a .gltf or .glb file and, if it has one, the first skin that a mesh uses,
/// with all meshes that use it; without a skin all meshes, where their nodes put them. Rows of
/// weights are divided by their sums, and the joint that holds what rows lacked is gone again. The
/// first animation that moves a joint is sampled at its keys when they are evenly spaced, else at
/// 24 frames a second. Buffers may be in the file, in its text or in files beside it; pictures are
/// not read.
///
/// Report: counts.vertices, counts.triangles, counts.joints, counts.frames, counts.skins,
/// counts.animations, counts.materials, counts.unweighted_vertices, counts.skipped_primitives
/// (points and lines), counts.morph_targets, sets, not_kept[] (one phrase per kind of content that
/// is not read: other animations, materials, textures, morph targets, cameras, lights, other meshes
/// …). One warning lists not_kept.
///
/// invalid_input with one sentence that names the file for all that is broken: no JSON, another
/// version, buffers and accessors that do not fit, coordinates and matrices that are not finite,
/// joints out of range, nodes in a circle, required extensions (compressed meshes).
Status read_gltf_skin(const std::string& path, GltfSkin& skin);

} // namespace bindpose

#endif
