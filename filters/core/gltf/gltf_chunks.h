#ifndef bindpose_gltf_gltf_chunks_h
#define bindpose_gltf_gltf_chunks_h

#include <string>
#include <string_view>

namespace bindpose
{

/// The parts of a glTF file.
struct GltfChunks
{
  std::string_view text; ///< the JSON text
  std::string_view buffer; ///< the binary chunk of a .glb file; empty: none
  std::string_view further; ///< all chunks after these, with their headers
};

/// Split the content of a .gltf or .glb file; the result refers to it. Throw GltfError for a chunk
/// that extends beyond the end of the file.
GltfChunks split_gltf(std::string_view content);

/// Return the content of a .glb file with these chunks. It must be smaller than 4 GiB.
std::string join_glb(const GltfChunks& chunks);

} // namespace bindpose

#endif
