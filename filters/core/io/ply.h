#ifndef bindpose_io_ply_h
#define bindpose_io_ply_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Read vertices and faces of a PLY file: ASCII, binary little-endian or big-endian, coordinates of
/// any number type. Other elements and properties are skipped.
/// invalid_input, with the file and, for text, the line, for: a wrong header, no vertices or faces,
/// a truncated file, words that are not numbers, coordinates that are not finite, vertex ids out of
/// range.
Status read_ply(const std::string& path, PolygonMesh& mesh);

/// Write binary little-endian PLY with double coordinates.
Status write_ply(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
