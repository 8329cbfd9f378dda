#ifndef bindpose_gltf_edit_gltf_joints_h
#define bindpose_gltf_edit_gltf_joints_h

// Joints of a skin as nodes of a glTF document.

#include "gltf_edit/gltf_document.h"
#include "gltf/gltf_skin.h"

#include <vector>

namespace bindpose
{

/// Return the joint ids in an order in which each joint follows its parent. Joints in a cycle are
/// missing.
std::vector<Index> parents_first(const std::vector<GltfJoint>& joints);

/// Compute the local transforms of the joints' glTF nodes for the joint-to-scene maps `exact_maps`.
/// A node stores a translation, a rotation and scales, so it can only approximate a map with shear.
/// Set `stored_maps` to the joint-to-scene maps of the nodes.
/// @return one local transform per joint.
std::vector<Trs> local_maps(const std::vector<GltfJoint>& joints,
  const std::vector<Eigen::Affine3d>& exact_maps, std::vector<Eigen::Affine3d>& stored_maps);

/// Return invalid_input for more than 65534 joints, parents that do not exist, cyclic parents, and
/// transforms that are not invertible or not finite floats.
Status check_joints(const std::vector<GltfJoint>& joints);

/// The nodes of the joints of a skin.
struct GltfJointNodes
{
  int root = -1; ///< the parent of all joints without a parent; it is not a joint. -1: no such node
  std::vector<int> joints; ///< one node per joint; if there is a joint "rest", it is the last one
};

/// Append the nodes of joints, and a node "handles" as the parent of those without a parent. The
/// caller adds the root to a scene or to the children of a node.
/// @param local_transforms one transform per joint, relative to its parent joint
/// @param rest_joint whether a joint "rest" is added, which does not move
GltfJointNodes append_joints(GltfDocument& document, const std::vector<GltfJoint>& joints,
  const std::vector<Trs>& local_transforms, bool rest_joint);

/// Append a skin, and return its id.
/// @param nodes result of append_joints()
/// @param mesh_to_rest transform from the coordinates of the mesh to those of GltfJoint::rest
int append_skin(GltfDocument& document, const std::vector<GltfJoint>& joints,
  const GltfJointNodes& nodes, const Eigen::Affine3d& mesh_to_rest);

} // namespace bindpose

#endif
