#ifndef bindpose_gltf_obj_document_h
#define bindpose_gltf_obj_document_h

// An OBJ file as a glTF document.

#include "gltf/gltf_document.h"
#include "io/obj.h"

#include <map>
#include <string>
#include <vector>

namespace bindpose
{

/// The triangles of an OBJ file.
struct ObjTriangles
{
  Triangles corners; ///< #T x 3, indices into PolygonMesh::corners
  std::vector<Index> faces; ///< polygon of each triangle
};

/// Append a scene with one node and one mesh per part of an OBJ file, and one primitive per
/// material. The corners of faces that share vertex, texture coordinates and normal share a vertex
/// of the document. A part whose corners do not all have a normal gets none, and corners without
/// texture coordinates get (0, 0). Colors are converted from sRGB to linear values, as glTF
/// requires. If the mesh is far from the origin, its center is the translation of the nodes,
/// because glTF stores coordinates as floats.
/// @param materials id of a material in the document, by the name in the OBJ file
void append_obj_scene(const PolygonMesh& mesh, const ObjLook& look, const ObjTriangles& triangles,
  const std::map<std::string, int>& materials, GltfDocument& document);

} // namespace bindpose

#endif
