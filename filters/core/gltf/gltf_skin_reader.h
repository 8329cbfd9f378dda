#ifndef bindpose_gltf_gltf_skin_reader_h
#define bindpose_gltf_gltf_skin_reader_h

// The joints and weights of skins in a parsed glTF file.

#include "gltf/gltf_model.h"
#include "gltf/gltf_skin.h"

#include <string>
#include <utility>
#include <vector>

namespace bindpose
{

/// Joints and their nodes.
struct GltfSkinJoints
{
  std::vector<GltfJoint> joints;
  std::vector<int> nodes; ///< node of each joint
};

/// Return the joints of nodes. Names are unique and not empty. The parent of a joint is the joint
/// of the nearest ancestor of its node. Throw GltfError if a node occurs twice, and for matrices
/// that are not finite.
/// @param rests joint-to-mesh transforms in the bind pose, see GltfJoint::rest
GltfSkinJoints read_gltf_joints(const tinygltf::Model& model, const GltfNodes& nodes,
  const std::vector<int>& joint_nodes, const std::vector<Eigen::Affine3d>& rests);

/// For each vertex, pairs of joint (index into the skin's list) and weight above 0.
using GltfInfluences = std::vector<std::vector<std::pair<Index, double>>>;

/// Append the weights of a primitive: the attributes JOINTS_n and WEIGHTS_n. Throw GltfError for
/// negative weights, unknown joints, and attributes that do not match.
/// @param joints number of joints of the skin
/// @return the number of sets of four weights per vertex
Index read_gltf_weights(const GltfAccessors& accessors, const tinygltf::Primitive& primitive,
  Index vertices, std::size_t joints, GltfInfluences& influences);

} // namespace bindpose

#endif
