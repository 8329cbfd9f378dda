#ifndef meshopt_view_h
#define meshopt_view_h

#include <cstddef>
#include <string>
#include <string_view>

namespace bindpose
{

/// Properties of a compressed buffer view, as in the glTF extension EXT_meshopt_compression.
struct MeshoptView
{
  std::size_t count; ///< number of elements
  std::size_t stride; ///< bytes per element
  std::string mode; ///< ATTRIBUTES, TRIANGLES or INDICES
  std::string filter; ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// Decompress a buffer view by the library meshoptimizer.
/// @return count x stride bytes
/// Throw GltfError if the data or the properties are not valid, or if Bindpose was built without
/// meshoptimizer.
std::string decode_meshopt_view(std::string_view data, const MeshoptView& view);

} // namespace bindpose

#endif
