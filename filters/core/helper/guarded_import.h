#ifndef bindpose_helper_guarded_import_h
#define bindpose_helper_guarded_import_h

#include "base/execution.h"

#include <string>
#include <vector>

namespace bindpose
{

// These functions run the helper executable bindpose-importer, because the libraries that read the
// files crash, hang or take all memory on some damaged files. The time and memory limits of the
// helper grow linearly with the size of the file. `bytes` is set to the bytes of a .glb file.
// Warnings of the helper are warnings of the status.
// Return invalid_input, naming the file and the reason, if the file cannot be read; canceled if the
// context was canceled; unavailable if the helper is not found.

/// Convert a file to glTF by the library assimp.
Status import_guarded(ExecutionContext& context, const std::string& path, std::string& bytes);

/// Decompress the meshes of a glTF file: the extensions KHR_draco_mesh_compression, by the library
/// Draco, and EXT_meshopt_compression, by the library meshoptimizer. Everything else in the file is
/// kept, except that all buffers are joined into one.
/// @param buffer_files the buffer files of the glTF file; their sizes are added to the size of the
/// file for the limits
Status decompress_guarded(ExecutionContext& context, const std::string& path,
  const std::vector<std::string>& buffer_files, std::string& bytes);

} // namespace bindpose

#endif
