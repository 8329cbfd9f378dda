#ifndef guarded_import_h
#define guarded_import_h

#include "base/execution.h"

#include <string>

namespace bindpose
{

/// Convert a file to glTF by the library assimp. Assimp crashes, hangs or takes all memory on some
/// damaged files. Therefore the helper executable bindpose-importer converts the file. The time and
/// memory limits of the helper grow linearly with the size of the file.
/// @param bytes is set to the bytes of a .glb file
/// @return invalid_input, naming the file and the reason, if the file cannot be read; canceled if
/// the context was canceled; unavailable if the helper is not found
Status import_guarded(ExecutionContext& context, const std::string& path, std::string& bytes);

} // namespace bindpose

#endif
