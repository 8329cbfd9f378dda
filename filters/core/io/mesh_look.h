#ifndef bindpose_io_mesh_look_h
#define bindpose_io_mesh_look_h

#include "geometry/mesh.h"

#include <string>
#include <vector>

namespace bindpose
{

/// The look of the polygons of a file. Optional matrices have no rows if the file has no such data.
struct MeshLook
{
  /// Texture coordinates; the origin is at the lower left.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> texture;
  Points normals;
  Points colors; ///< #V x 3, sRGB values from 0 to 1; only if all vertices have a color
  std::vector<Index> texture_ids; ///< per corner of a polygon: row of `texture`, or -1
  std::vector<Index> normal_ids; ///< per corner of a polygon: row of `normals`, or -1
  std::vector<Index> materials; ///< per polygon: index into material_names, or -1
  std::vector<Index> parts; ///< per polygon: index into part_names
  std::vector<std::string> material_names;
  /// Names of the parts that have polygons. OBJ: objects and groups, as "object", "group" or
  /// "object group".
  std::vector<std::string> part_names;
  std::vector<std::string> libraries; ///< OBJ: the texts after mtllib, files with materials
  std::string picture; ///< PLY: file name of the picture of the texture; empty: none
};

} // namespace bindpose

#endif
