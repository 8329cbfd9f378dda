#ifndef bindpose_gltf_edit_gltf_pose_error_h
#define bindpose_gltf_edit_gltf_pose_error_h

// The error of a pose in a glTF file. The causes are rounding to floats, dropped weights, and nodes
// that contain only translation, rotation and scale.

#include "geometry/mesh.h"
#include "gltf/gltf_skin.h"
#include "gltf_edit/gltf_weights.h"

#include <vector>

namespace bindpose
{

/// A skin and the weights that a file stores for it. The referenced objects must outlive this one.
struct GltfStoredSkin
{
  const Points& points; ///< #V x 3, rest positions
  const std::vector<GltfJoint>& joints;
  const Weights& weights; ///< #V x #joints
  const GltfWeights& stored_weights;
};

/// Return the largest distance between the position of a vertex according to the file and its
/// correct position. To measure it, the vertices are moved twice: according to the file, and
/// exactly. Cost: O(#V * influences).
/// @param exact_maps exact joint-to-scene maps
/// @param stored_maps joint-to-scene maps according to the file
/// @param exact_points correct positions; if empty, computed from `exact_maps`
double largest_pose_error(const GltfStoredSkin& skin,
  const std::vector<Eigen::Affine3d>& exact_maps, const std::vector<Eigen::Affine3d>& stored_maps,
  const Points& exact_points = Points());

} // namespace bindpose

#endif
