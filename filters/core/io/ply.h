#ifndef bindpose_io_ply_h
#define bindpose_io_ply_h

#include "io/mesh_look.h"
#include "io/polygon_mesh.h"

namespace bindpose
{

/// Read vertices and faces of a PLY file: ASCII, binary little-endian or big-endian, with
/// coordinates of any number type. Other elements and properties are skipped.
/// @return invalid_input, naming the file and, for text, the line, if the header is wrong, there
/// are no vertices or faces, the file is truncated, a word is not a number, a coordinate is not
/// finite, or a vertex id is out of range.
Status read_ply(const std::string& path, PolygonMesh& mesh);
/// Read also the look of the faces: colors (red, green, blue), normals (nx, ny, nz) and texture
/// coordinates (s, t; u, v; or texture_u, texture_v) of vertices, texture coordinates of corners
/// (the list texcoord) and the name of the picture (the comment TextureFile). There is one part and
/// at most one material, "texture".
Status read_ply(const std::string& path, PolygonMesh& mesh, MeshLook& look);

/// Write binary little-endian PLY with double coordinates.
Status write_ply(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
