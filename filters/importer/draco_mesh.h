#ifndef draco_mesh_h
#define draco_mesh_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bindpose
{

/// An attribute of a compressed mesh, and the type of the accessor that gets its values.
struct DracoAttribute
{
  std::uint32_t id; ///< unique id in the compressed mesh
  int component_type; ///< a constant of tinygltf
  int columns; ///< number of components
};

/// A decompressed mesh.
struct DracoMesh
{
  std::size_t vertex_count = 0;
  std::vector<std::uint32_t> corners; ///< vertices of the triangles, three per triangle
  std::vector<std::string> values; ///< bytes per attribute, row by row
};

/// Decompress a mesh and some of its attributes by the library Draco. Throw GltfError if the data
/// are not valid, if an attribute does not exist or does not have the type of its accessor, or if
/// Bindpose was built without Draco.
DracoMesh decode_draco_mesh(std::string_view data, const std::vector<DracoAttribute>& attributes);

} // namespace bindpose

#endif
