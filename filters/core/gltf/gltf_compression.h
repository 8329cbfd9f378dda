#ifndef bindpose_gltf_gltf_compression_h
#define bindpose_gltf_gltf_compression_h

// The extensions of glTF that compress meshes. Bindpose decompresses files that require them before
// it parses them; see decompress_guarded(). Where they are optional, the files have uncompressed
// values, too, and these are read.

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace bindpose
{

constexpr const char* draco_extension = "KHR_draco_mesh_compression";
constexpr const char* meshopt_extension = "EXT_meshopt_compression";

/// Parse the JSON text of a glTF file. Throw GltfError if it is not an object.
nlohmann::ordered_json parse_gltf_text(std::string_view text);

/// Return the file of a buffer, given by the JSON object of the buffer. The path is empty if the
/// buffer is in the glTF file.
/// @param folder the folder of the glTF file
std::string gltf_buffer_path(const nlohmann::ordered_json& buffer, const std::string& folder);

/// Return an extension of an object of the JSON text, or null.
const nlohmann::ordered_json* gltf_extension(
  const nlohmann::ordered_json& object, const char* name);

/// Report whether a buffer has no values of its own: EXT_meshopt_compression declares such buffers
/// for programs that do not decompress.
bool is_fallback_buffer(const nlohmann::ordered_json& buffer);

/// The compression of a glTF file.
struct GltfCompression
{
  bool is_required = false; ///< whether the file must be decompressed
  std::vector<std::string> buffer_files; ///< files that the decompression reads
};

/// Return the compression of a .gltf or .glb file. A file that is not valid needs none.
/// @param folder the folder of the glTF file
GltfCompression find_compression(std::string_view content, const std::string& folder);

/// Remove these extensions from a document whose buffer views have all values without compression.
void remove_compression(nlohmann::ordered_json& document);

} // namespace bindpose

#endif
