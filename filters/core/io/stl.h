#ifndef bindpose_io_stl_h
#define bindpose_io_stl_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Reads an STL file, ASCII or binary. Vertices at equal places become one, so that a closed
/// surface is closed; normals and attributes are skipped.
/// invalid_input, naming the file and, for text, the line, for: neither form, no triangle, a
/// truncated file, words that are no numbers, coordinates that are not finite.
Status read_stl(const std::string& path, PolygonMesh& mesh);

/// Writes binary STL: floats, polygons fanned into triangles, normals from the triangles.
Status write_stl(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
