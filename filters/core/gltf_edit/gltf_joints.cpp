#include "gltf_edit/gltf_joints.h"

#include <algorithm>

namespace bindpose
{

namespace
{
using Json = GltfDocument::Json;

Json to_json(const GltfHandleExtras& handle_extras)
{
  Json properties{ { "kind", handle_extras.kind }, { "head", to_gltf_json(handle_extras.head) },
    { "tail", to_gltf_json(handle_extras.tail) } };
  if (handle_extras.region != 0)
  {
    properties["region"] = handle_extras.region;
  }
  if (!handle_extras.cage.empty())
  {
    properties["cage"] = handle_extras.cage;
  }
  return { { "bindpose", std::move(properties) } };
}
} // namespace

std::vector<Index> parents_first(const std::vector<GltfJoint>& joints)
{
  // children[j + 1] are the children of joint j; children[0] are the joints without a parent.
  std::vector<std::vector<Index>> children(joints.size() + 1);
  for (std::size_t j = 0; j < joints.size(); ++j)
  {
    children[joints[j].parent + 1].push_back(static_cast<Index>(j));
  }
  std::vector<Index> order = children[0];
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const std::vector<Index>& child_ids = children[order[k] + 1];
    order.insert(order.end(), child_ids.begin(), child_ids.end());
  }
  return order;
}

std::vector<Trs> local_maps(const std::vector<GltfJoint>& joints,
  const std::vector<Eigen::Affine3d>& exact_maps, std::vector<Eigen::Affine3d>& stored_maps)
{
  std::vector<Trs> local_transforms(joints.size());
  stored_maps.resize(joints.size());
  for (const Index j : parents_first(joints))
  {
    const Index parent = joints[j].parent;
    const Eigen::Affine3d parent_map =
      (parent < 0 ? Eigen::Affine3d::Identity() : stored_maps[parent]) * joints[j].to_parent_joint;
    Eigen::Affine3d local = parent_map.inverse() * exact_maps[j];
    // If the parent's map is singular, no local transform can correct the joint.
    if (!local.matrix().allFinite())
    {
      local = exact_maps[j];
    }
    local_transforms[j] = nearest_trs(local);
    stored_maps[j] = parent_map * local_transforms[j].affine();
  }
  return local_transforms;
}

Status check_joints(const std::vector<GltfJoint>& joints)
{
  constexpr std::size_t maximum_joints = 65534; // joint ids have 16 bits
  if (joints.size() > maximum_joints)
  {
    return Status::invalid_input("a glTF file can have at most " + std::to_string(maximum_joints) +
      " handles, not " + std::to_string(joints.size()));
  }
  for (const GltfJoint& joint : joints)
  {
    if (joint.parent >= static_cast<Index>(joints.size()) || joint.parent < -1)
    {
      return Status::invalid_input("joint '" + joint.name + "' has a parent that does not exist");
    }
    if (!fits_in_float(joint.rest.matrix()) || !fits_in_float(joint.posed.matrix()) ||
      joint.rest.linear().determinant() == 0.0)
    {
      return Status::invalid_input(
        "joint '" + joint.name + "' has a transform that is not finite or not invertible");
    }
  }
  return parents_first(joints).size() == joints.size()
    ? Status()
    : Status::invalid_input("the hierarchy of the joints contains a cycle");
}

GltfJointNodes append_joints(GltfDocument& document, const std::vector<GltfJoint>& joints,
  const std::vector<Trs>& local_transforms, bool rest_joint)
{
  GltfJointNodes nodes;
  nodes.root = document.append("nodes", { { "name", "handles" } });
  for (std::size_t j = 0; j < joints.size(); ++j)
  {
    Json node{ { "name", joints[j].name } };
    set_transform(node, local_transforms[j]);
    if (joints[j].handle_extras)
    {
      node["extras"] = to_json(*joints[j].handle_extras);
    }
    nodes.joints.push_back(document.append("nodes", std::move(node)));
  }
  if (rest_joint)
  {
    GltfHandleExtras handle_extras;
    handle_extras.kind = "rest";
    nodes.joints.push_back(
      document.append("nodes", { { "name", "rest" }, { "extras", to_json(handle_extras) } }));
  }
  for (std::size_t j = 0; j < nodes.joints.size(); ++j)
  {
    const Index parent = j < joints.size() ? joints[j].parent : -1;
    document.list("nodes")[parent < 0 ? nodes.root : nodes.joints[parent]]["children"].push_back(
      nodes.joints[j]);
  }
  return nodes;
}

int append_skin(GltfDocument& document, const std::vector<GltfJoint>& joints,
  const GltfJointNodes& nodes, const Eigen::Affine3d& mesh_to_rest)
{
  std::vector<float> inverse_binds;
  for (std::size_t j = 0; j < nodes.joints.size(); ++j)
  {
    const Eigen::Affine3d rest = j < joints.size() ? joints[j].rest : Eigen::Affine3d::Identity();
    const Eigen::Matrix4d inverse = (rest.inverse() * mesh_to_rest).matrix();
    // Write the matrix column by column, which is also Eigen's storage order.
    std::transform(inverse.data(), inverse.data() + inverse.size(),
      std::back_inserter(inverse_binds), [](double x) { return static_cast<float>(x); });
  }
  const int matrices = document.append_accessor(inverse_binds, 16, 0);
  Json skin{ { "name", "skin" } };
  if (nodes.root >= 0)
  {
    skin["skeleton"] = nodes.root;
  }
  skin["joints"] = nodes.joints;
  skin["inverseBindMatrices"] = matrices;
  return document.append("skins", std::move(skin));
}

} // namespace bindpose
