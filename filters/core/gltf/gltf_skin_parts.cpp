#include "gltf/gltf_skin_parts.h"

#include <map>
#include <set>

namespace bindpose
{

namespace
{
/// Return the skin of the first mesh that has one, or -1 if no mesh has one.
int first_skin(const tinygltf::Model& model)
{
  for (const tinygltf::Node& node : model.nodes)
  {
    if (node.mesh >= 0 && node.skin >= 0)
    {
      return node.skin;
    }
  }
  return -1;
}
} // namespace

GltfSkinParts find_skin_parts(const tinygltf::Model& model, const GltfAccessors& accessors)
{
  GltfSkinParts result;
  result.skin = first_skin(model);
  std::set<int> instanced_meshes;
  // First vertex of each combination of vertex accessors. Primitives with the same accessors but
  // different materials share these vertices.
  std::map<std::map<std::string, int>, Index> first_vertex;
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
  {
    const tinygltf::Node& node = model.nodes[n];
    if (node.mesh < 0)
    {
      continue;
    }
    if (node.skin != result.skin)
    {
      result.omitted_meshes += 1;
      continue;
    }
    const tinygltf::Mesh& mesh = gltf_element(model.meshes, node.mesh, "mesh");
    if (result.skin >= 0 && !instanced_meshes.insert(node.mesh).second)
    {
      // The joints determine the position of the mesh, so a second node with this mesh would
      // duplicate it.
      continue;
    }
    if (result.skin < 0)
    {
      first_vertex.clear(); // a mesh at another position needs its own vertices
    }
    for (std::size_t k = 0; k < mesh.primitives.size(); ++k)
    {
      const tinygltf::Primitive& primitive = mesh.primitives[k];
      if (!has_triangles(primitive))
      {
        result.skipped += 1;
        continue;
      }
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end())
      {
        throw GltfError("a mesh has no attribute POSITION");
      }
      const Index count = accessors.count(position->second, "POSITION");
      const auto [entry, is_new] = first_vertex.insert({ primitive.attributes, result.vertices });
      result.parts.push_back({ static_cast<int>(n), static_cast<int>(k), entry->second, count });
      result.vertices += is_new ? count : 0;
    }
    result.meshes += 1;
  }
  return result;
}

} // namespace bindpose
