#ifndef bindpose_look_look_document_h
#define bindpose_look_look_document_h

// A mesh with a look as a glTF document.

#include "gltf_edit/gltf_document.h"
#include "io/mesh_look.h"
#include "io/polygon_mesh.h"

#include <map>
#include <string>
#include <vector>

namespace bindpose
{

/// The triangles of the polygons of a mesh.
struct LookTriangles
{
  Triangles corners; ///< #T x 3, indices into PolygonMesh::corners
  std::vector<Index> faces; ///< polygon of each triangle
};

/// Append a scene with one node and one mesh per part of a look, and one primitive per material.
/// The corners of faces that share vertex, texture coordinates and normal share a vertex of the
/// document. A part whose corners do not all have a normal gets none, and corners without texture
/// coordinates, or with coordinates that are not finite floats, get (0, 0). Colors are converted
/// from sRGB to linear values, as glTF requires. If the mesh is far from the origin, its center is
/// the translation of the nodes, because glTF stores coordinates as floats. Polygons without a
/// material get a gray one, because the default material of glTF is a metal.
/// @param materials id of a material in the document, by its name in the look
/// @return point of the mesh for each vertex of the document, in the order of the scene
std::vector<Index> append_look_scene(const PolygonMesh& mesh, const MeshLook& look,
  const LookTriangles& triangles, const std::map<std::string, int>& materials,
  GltfDocument& document);

} // namespace bindpose

#endif
