#ifndef bindpose_io_stl_h
#define bindpose_io_stl_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Read an STL file, ASCII or binary. Vertices with equal coordinates are merged, because STL
/// repeats the corners of every triangle. Normals and attributes are skipped.
/// @return invalid_input, naming the file and, for text, the line, if the file has neither format,
/// there is no triangle, the file is truncated, a word is not a number, or a coordinate is not
/// finite.
Status read_stl(const std::string& path, PolygonMesh& mesh);

/// Write binary STL: coordinates as floats, polygons triangulated as fans, normals of the
/// triangles.
Status write_stl(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
