#ifndef bindpose_io_obj_h
#define bindpose_io_obj_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Read vertices and faces of a Wavefront OBJ file as doubles. Texture coordinates, normals,
/// materials, groups and points are skipped, so that faces share vertices even if the normals of
/// their corners differ. Lines are read only if the file has no face. Negative ids count back from
/// the last vertex.
/// invalid_input, with file and line, for: a file without vertices, or with neither faces nor
/// lines; words that are not numbers; coordinates that are not finite; vertex ids out of range.
Status read_obj(const std::string& path, PolygonMesh& mesh);

/// Write vertices and faces. Coordinates can be read back as the same doubles.
Status write_obj(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
