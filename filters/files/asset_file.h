#ifndef asset_file_h
#define asset_file_h

#include "base/execution.h"
#include "gltf_edit/gltf_asset.h"

#include <string>
#include <vector>

namespace bindpose
{

/// Extensions of the files that read_asset_file() reads.
inline const char* asset_extensions()
{
  return "glb gltf obj ply fbx dae 3ds 3mf";
}

/// A file of another format, converted to glTF.
struct AssetBytes
{
  std::string bytes; ///< a .glb file
  /// OBJ and PLY: the point of the mesh, as vtkMeshFileReader reads it, for each vertex of the
  /// scene.
  std::vector<Index> points;
  Index point_count = 0; ///< OBJ and PLY: number of points of the mesh
};

/// Convert a file of another format than glTF; see read_asset_file().
Status read_asset_bytes(ExecutionContext& context, const std::string& path, AssetBytes& asset);

/// Read a file that can get a new skin. A file of another format than glTF is converted to glTF:
/// OBJ with texture coordinates, normals, groups, vertex colors, and the materials and pictures of
/// its .mtl files; PLY with texture coordinates, normals, vertex colors and its picture; FBX,
/// Collada (DAE), 3DS and 3MF by import_guarded().
Status read_asset_file(ExecutionContext& context, const std::string& path, GltfAsset& asset);

} // namespace bindpose

#endif
