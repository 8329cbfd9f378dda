#ifndef decompressed_gltf_h
#define decompressed_gltf_h

#include <string>

namespace bindpose
{

/// Decompress the meshes of a .gltf or .glb file: the extensions KHR_draco_mesh_compression and
/// EXT_meshopt_compression. All buffers are joined into one, without the compressed data.
///
/// The minimum and maximum of an accessor are computed again for Draco, which may round values.
/// @return the bytes of a .glb file
/// Throw GltfError if the file is not valid, or if Bindpose was built without the library that is
/// needed.
std::string decompress_gltf(const std::string& path);

} // namespace bindpose

#endif
