#ifndef assimp_file_h
#define assimp_file_h

#include <string>

namespace bindpose
{

/// Convert a file of one of assimp's formats to glTF; see to_gltf_document(). Other files are read
/// only if they are in the folder of the file.
/// @return the bytes of a .glb file
/// Throw std::runtime_error, with assimp's message, if the file cannot be read, or if Bindpose
/// was built without assimp.
std::string convert_by_assimp(const std::string& path);

} // namespace bindpose

#endif
