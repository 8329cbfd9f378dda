#include "draco_mesh.h"

#include "gltf/gltf_model.h"

#ifdef BINDPOSE_HAS_DRACO
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#endif

namespace bindpose
{

#ifdef BINDPOSE_HAS_DRACO

namespace
{
template <typename Number>
std::string values_of(const draco::Mesh& mesh, const DracoAttribute& request)
{
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(request.id);
  const std::string name = "attribute " + std::to_string(request.id) + " of the compressed mesh ";
  if (!attribute)
  {
    throw GltfError(name + "does not exist");
  }
  const auto columns = static_cast<std::size_t>(request.columns);
  std::vector<Number> row(columns);
  std::string bytes;
  bytes.reserve(mesh.num_points() * columns * sizeof(Number));
  for (draco::PointIndex vertex(0); vertex < mesh.num_points(); ++vertex)
  {
    if (attribute->num_components() != request.columns ||
      !attribute->ConvertValue(attribute->mapped_index(vertex), row.data()))
    {
      throw GltfError(name + "does not have the type of its accessor");
    }
    bytes.append(reinterpret_cast<const char*>(row.data()), columns * sizeof(Number));
  }
  return bytes;
}

std::string values_of(const draco::Mesh& mesh, const DracoAttribute& request)
{
  switch (request.component_type)
  {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return values_of<std::int8_t>(mesh, request);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return values_of<std::uint8_t>(mesh, request);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return values_of<std::int16_t>(mesh, request);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return values_of<std::uint16_t>(mesh, request);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return values_of<std::uint32_t>(mesh, request);
    default:
      return values_of<float>(mesh, request);
  }
}
} // namespace

DracoMesh decode_draco_mesh(std::string_view data, const std::vector<DracoAttribute>& attributes)
{
  draco::DecoderBuffer buffer;
  buffer.Init(data.data(), data.size());
  draco::Decoder decoder;
  const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok())
  {
    throw GltfError("the data cannot be decompressed: " + decoded.status().error_msg_string());
  }
  const draco::Mesh& mesh = *decoded.value();
  DracoMesh result;
  result.vertex_count = mesh.num_points();
  result.corners.reserve(3 * std::size_t(mesh.num_faces()));
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
  {
    for (const draco::PointIndex& vertex : mesh.face(face))
    {
      result.corners.push_back(vertex.value());
    }
  }
  for (const DracoAttribute& attribute : attributes)
  {
    result.values.push_back(values_of(mesh, attribute));
  }
  return result;
}

#else

DracoMesh decode_draco_mesh(std::string_view, const std::vector<DracoAttribute>&)
{
  throw GltfError("Bindpose was built without Draco (Debian package libdraco-dev)");
}

#endif

} // namespace bindpose
