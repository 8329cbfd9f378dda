#ifndef bindpose_io_stl_h
#define bindpose_io_stl_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Read an STL file, ASCII or binary. Vertices with equal coordinates are merged, so that a closed
/// surface is closed. Normals and attributes are skipped.
/// invalid_input, with the file and, for text, the line, for: neither format, no triangle, a
/// truncated file, words that are not numbers, coordinates that are not finite.
Status read_stl(const std::string& path, PolygonMesh& mesh);

/// Write binary STL: floats, polygons triangulated as fans, normals of the triangles.
Status write_stl(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
