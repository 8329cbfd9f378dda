#ifndef bindpose_gltf_gltf_file_h
#define bindpose_gltf_gltf_file_h

#include "base/execution.h"
#include "gltf/gltf_model.h"

#include <functional>
#include <string>

namespace bindpose
{

/// A glTF file that was read and parsed.
struct GltfContent
{
  std::string bytes; ///< the file; if its meshes are compressed, the decompressed file
  GltfBufferFiles files;
  tinygltf::Model model;
};

/// Read and parse a file, and call use(content, status), which may add warnings and a report to the
/// status. A file that requires decompression by Draco or meshopt is decompressed by
/// decompress_guarded().
/// Return invalid_input, with the path in the message, if the file cannot be read, or if
/// parse_gltf() or use() throws GltfError or std::bad_alloc; the status of decompress_guarded() if
/// it fails.
Status read_gltf_file(ExecutionContext& context, const std::string& path,
  const std::function<void(const GltfContent&, Status&)>& use);

/// Parse the bytes of a file, which may be made from a file of another format, and call
/// use(content, status). See read_gltf_file(). Files that require decompression are refused.
Status read_gltf_bytes(const std::string& path, std::string bytes,
  const std::function<void(const GltfContent&, Status&)>& use);

} // namespace bindpose

#endif
