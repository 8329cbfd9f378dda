#ifndef bindpose_io_obj_h
#define bindpose_io_obj_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Reads vertices and faces of a Wavefront OBJ file as doubles. Texture coordinates, normals,
/// materials, groups, lines and points are skipped, so that vertices stay shared between faces
/// whatever their corners' normals are. Negative ids count back from the last vertex.
/// invalid_input, naming file and line, for: a file without a vertex or face, words that are no
/// numbers, coordinates that are not finite, vertex ids out of range.
Status read_obj(const std::string& path, PolygonMesh& mesh);

/// Writes vertices and faces; coordinates read back as the same doubles.
Status write_obj(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
