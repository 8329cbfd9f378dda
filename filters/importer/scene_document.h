#ifndef scene_document_h
#define scene_document_h

// A scene of assimp as a glTF document.

#include "gltf_edit/gltf_document.h"

#include <string>

struct aiScene;

namespace bindpose
{

/// Convert a scene to glTF: nodes, triangles with normals, texture coordinates and vertex colors,
/// materials, skins and animations. Cameras, lights, points and lines are left out.
///
/// Embedded pictures are stored in the document; those that must be converted have a data URI. For
/// a picture in a file the document has the path of the file, relative to `folder`. If there is no
/// such file in `folder` or below it, but one with the same name in `folder`, its path is used
/// instead. Pictures that are missing or have an unknown format are left out, with a warning of the
/// helper.
/// @param scene with triangles only, and at most one primitive type per mesh
GltfDocument to_gltf_document(const aiScene& scene, const std::string& folder);

} // namespace bindpose

#endif
