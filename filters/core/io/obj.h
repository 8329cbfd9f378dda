#ifndef bindpose_io_obj_h
#define bindpose_io_obj_h

#include "io/polygon_mesh.h"

#include <string>
#include <vector>

namespace bindpose
{

/// The look of the faces of an OBJ file. Rows of optional matrices are missing if the file has
/// none.
struct ObjLook
{
  /// Texture coordinates; the origin is at the lower left.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> texture;
  Points normals;
  Points colors; ///< #V x 3, from 0 to 1; only if all vertices have a color
  std::vector<Index> texture_ids; ///< per corner of a face: row of `texture`, or -1
  std::vector<Index> normal_ids; ///< per corner of a face: row of `normals`, or -1
  std::vector<Index> materials; ///< per face: index into material_names, or -1
  std::vector<Index> parts; ///< per face: index into part_names
  std::vector<std::string> material_names;
  /// Names of the objects and groups that have faces: "object", "group" or "object group".
  std::vector<std::string> part_names;
  std::vector<std::string> libraries; ///< the texts after mtllib: files with materials
};

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
Status read_obj(const std::string& path, PolygonMesh& mesh, ObjLook& look);

/// Write vertices and faces. Reading the file returns the same doubles.
Status write_obj(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
