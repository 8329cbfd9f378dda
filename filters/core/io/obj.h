#ifndef bindpose_io_obj_h
#define bindpose_io_obj_h

#include "io/mesh_look.h"
#include "io/polygon_mesh.h"

namespace bindpose
{

/// Read vertices and faces of a Wavefront OBJ file as doubles. Texture coordinates, normals,
/// materials, groups and points are skipped. Faces therefore share vertices even if the normals at
/// their corners differ. Polylines are read only if the file has no face. Negative ids count back
/// from the last vertex.
/// @return invalid_input, naming file and line, if there are no vertices, if there are neither
/// faces nor polylines, if a word is not a number, if a coordinate is not finite, or if a vertex id
/// is out of range.
Status read_obj(const std::string& path, PolygonMesh& mesh);
/// Read also the look of the faces. Ids of texture coordinates and normals that do not exist become
/// -1, with a warning.
Status read_obj(const std::string& path, PolygonMesh& mesh, MeshLook& look);

/// Write vertices and faces. Reading the file returns the same doubles.
Status write_obj(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
