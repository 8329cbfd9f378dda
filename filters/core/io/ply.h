#ifndef bindpose_io_ply_h
#define bindpose_io_ply_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Read vertices and faces of a PLY file: ASCII, binary little-endian or big-endian, with
/// coordinates of any number type. Other elements and properties are skipped.
/// @return invalid_input, naming the file and, for text, the line, if the header is wrong, there
/// are no vertices or faces, the file is truncated, a word is not a number, a coordinate is not
/// finite, or a vertex id is out of range.
Status read_ply(const std::string& path, PolygonMesh& mesh);

/// Write binary little-endian PLY with double coordinates.
Status write_ply(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
