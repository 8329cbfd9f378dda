#include "meshopt_view.h"

#include "gltf/gltf_model.h"

#ifdef BINDPOSE_HAS_MESHOPTIMIZER
#include <algorithm>

#include <meshoptimizer.h>
#endif

namespace bindpose
{

#ifdef BINDPOSE_HAS_MESHOPTIMIZER

namespace
{
/// Check the properties, because the library asserts them. The result can be at most 128 times as
/// large as the data: 256 vertices need at least four bytes per byte of a vertex.
void check(std::string_view data, const MeshoptView& view)
{
  const auto& [count, stride, mode, filter] = view;
  const bool has_indices = mode == "TRIANGLES" || mode == "INDICES";
  const bool is_valid_mode = (mode == "ATTRIBUTES" && stride % 4 == 0 && stride <= 256) ||
    (has_indices && (stride == 2 || stride == 4) && (mode == "INDICES" || count % 3 == 0));
  const bool is_valid_filter = filter == "NONE" ||
    (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
    (filter == "QUATERNION" && stride == 8) || (filter == "EXPONENTIAL" && stride % 4 == 0);
  constexpr std::size_t largest_ratio = 128;
  const std::size_t most_elements =
    has_indices ? 3 * data.size() : largest_ratio * data.size() / std::max<std::size_t>(stride, 1);
  if (!is_valid_mode || !is_valid_filter || (has_indices && filter != "NONE") || stride == 0 ||
    count == 0 || count > most_elements)
  {
    throw GltfError(
      "the mode, filter, count and stride of the compressed data do not fit together");
  }
}
} // namespace

std::string decode_meshopt_view(std::string_view data, const MeshoptView& view)
{
  check(data, view);
  const auto& [count, stride, mode, filter] = view;
  std::string bytes(count * stride, '\0');
  const auto* input = reinterpret_cast<const unsigned char*>(data.data());
  const int error = mode == "ATTRIBUTES"
    ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, input, data.size())
    : mode == "TRIANGLES"
    ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, input, data.size())
    : meshopt_decodeIndexSequence(bytes.data(), count, stride, input, data.size());
  if (error != 0)
  {
    throw GltfError("the data cannot be decompressed");
  }
  if (filter == "OCTAHEDRAL")
  {
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  }
  else if (filter == "QUATERNION")
  {
    meshopt_decodeFilterQuat(bytes.data(), count, stride);
  }
  else if (filter == "EXPONENTIAL")
  {
    meshopt_decodeFilterExp(bytes.data(), count, stride);
  }
  return bytes;
}

#else

std::string decode_meshopt_view(std::string_view, const MeshoptView&)
{
  throw GltfError("Bindpose was built without meshoptimizer (Debian package libmeshoptimizer-dev)");
}

#endif

} // namespace bindpose
