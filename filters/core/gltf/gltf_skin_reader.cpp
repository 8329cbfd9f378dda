#include "gltf/gltf_skin_reader.h"

#include <set>

namespace bindpose
{

namespace
{
bool read_vector(const tinygltf::Value& value, Vec3& to)
{
  for (int k = 0; k < 3; ++k)
  {
    if (!value.IsArray() || value.ArrayLen() != 3 || !value.Get(k).IsNumber())
    {
      return false;
    }
    to[k] = value.Get(k).GetNumberAsDouble();
  }
  return to.allFinite();
}

/// Read the extras that Bindpose writes for a handle. Return nothing if they are missing or
/// invalid.
std::optional<GltfHandleExtras> read_handle_extras(
  const tinygltf::Value& extras, std::size_t joints)
{
  if (!extras.IsObject() || !extras.Has("bindpose") || !extras.Get("bindpose").IsObject())
  {
    return {};
  }
  const tinygltf::Value& properties = extras.Get("bindpose");
  GltfHandleExtras handle_extras;
  if (!properties.Has("kind") || !properties.Get("kind").IsString() ||
    !read_vector(properties.Get("head"), handle_extras.head) ||
    !read_vector(properties.Get("tail"), handle_extras.tail))
  {
    return {};
  }
  handle_extras.kind = properties.Get("kind").Get<std::string>();
  if (properties.Has("region") && properties.Get("region").IsNumber())
  {
    const double region = properties.Get("region").GetNumberAsDouble();
    handle_extras.region = region > 0.0 && region < 1e15 ? static_cast<Index>(region) : 0;
  }
  const tinygltf::Value& cage = properties.Get("cage");
  for (std::size_t e = 0; cage.IsArray() && e < cage.ArrayLen(); ++e)
  {
    const tinygltf::Value& corners = cage.Get(static_cast<int>(e));
    std::array<Index, 3> element{ -1, -1, -1 };
    for (int k = 0; k < 3; ++k)
    {
      const bool has_corners =
        corners.IsArray() && corners.ArrayLen() == 3 && corners.Get(k).IsInt();
      element[k] = has_corners ? corners.Get(k).GetNumberAsInt() : -2;
      if (element[k] < (k < 2 ? 0 : -1) || element[k] >= static_cast<Index>(joints))
      {
        return {};
      }
    }
    handle_extras.cage.push_back(element);
  }
  return handle_extras;
}
} // namespace

GltfSkinJoints read_gltf_joints(const tinygltf::Model& model, const GltfNodes& nodes,
  const std::vector<int>& joint_nodes, const std::vector<Eigen::Affine3d>& rests)
{
  GltfSkinJoints result;
  result.nodes = joint_nodes;
  std::vector<int> joint_of_node(model.nodes.size(), -1);
  for (std::size_t j = 0; j < joint_nodes.size(); ++j)
  {
    gltf_element(model.nodes, joint_nodes[j], "node");
    int& joint = joint_of_node[joint_nodes[j]];
    if (joint >= 0)
    {
      throw GltfError("the skin contains a joint twice");
    }
    joint = static_cast<int>(j);
  }
  const std::vector<Eigen::Affine3d> global = nodes.scene_transforms();
  std::set<std::string> names;
  for (std::size_t j = 0; j < joint_nodes.size(); ++j)
  {
    const int id = joint_nodes[j];
    GltfJoint joint;
    joint.posed = global[id];
    joint.rest = rests[j];
    if (!joint.rest.matrix().allFinite() || !joint.posed.matrix().allFinite())
    {
      throw GltfError(
        "joint " + std::to_string(j) + " has a matrix that is not finite or not invertible");
    }
    for (int ancestor = nodes.parents[id]; ancestor >= 0 && joint.parent < 0;
         ancestor = nodes.parents[ancestor])
    {
      joint.parent = joint_of_node[ancestor];
    }
    joint.handle_extras = read_handle_extras(model.nodes[id].extras, joint_nodes.size());
    const std::string name = sanitize_line(model.nodes[id].name);
    joint.name = name.empty() ? "joint " + std::to_string(j) : name;
    for (int copy = 2; !names.insert(joint.name).second; ++copy)
    {
      joint.name =
        (name.empty() ? "joint " + std::to_string(j) : name) + "_" + std::to_string(copy);
    }
    result.joints.push_back(joint);
  }
  return result;
}

Index read_gltf_weights(const GltfAccessors& accessors, const tinygltf::Primitive& primitive,
  Index vertices, std::size_t joints, GltfInfluences& influences)
{
  const auto first = influences.size();
  influences.resize(first + static_cast<std::size_t>(vertices));
  for (Index set = 0;; ++set)
  {
    const std::string joint_name = "JOINTS_" + std::to_string(set);
    const std::string weight_name = "WEIGHTS_" + std::to_string(set);
    const GltfNumbers ids = read_gltf_attribute(
      accessors, primitive, joint_name.c_str(), TINYGLTF_TYPE_VEC4, vertices, true);
    const GltfNumbers weights =
      read_gltf_attribute(accessors, primitive, weight_name.c_str(), TINYGLTF_TYPE_VEC4, vertices);
    if (ids.rows() != weights.rows())
    {
      throw GltfError("JOINTS and WEIGHTS of set " + std::to_string(set) +
        " must be either both present or both missing");
    }
    if (ids.rows() == 0)
    {
      return set;
    }
    for (Index v = 0; v < vertices; ++v)
    {
      for (int k = 0; k < 4; ++k)
      {
        const double weight = weights(v, k);
        if (weight == 0.0)
        {
          continue; // skip unused entries, whose joint id may be invalid
        }
        if (weight < 0.0 || ids(v, k) >= static_cast<double>(joints))
        {
          throw GltfError("vertex " + std::to_string(v) +
            (weight < 0.0
                ? std::string(" has a negative weight")
                : " has a weight of joint " + std::to_string(static_cast<Index>(ids(v, k))) +
                  ", but there are " + std::to_string(joints) + " joints"));
        }
        influences[first + v].emplace_back(static_cast<Index>(ids(v, k)), weight);
      }
    }
  }
}

} // namespace bindpose
