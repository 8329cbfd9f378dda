#ifndef bindpose_io_medit_h
#define bindpose_io_medit_h

#include "geometry/mesh.h"

#include <string>

namespace bindpose
{

/// The supported content of a MEDIT file: tets, triangles or both, with common vertices.
struct MeditMesh
{
  Points points;
  Triangles triangles;
  Tets tets;
};

/// Read an ASCII MEDIT file (INRIA's .mesh format): Vertices (2D vertices get z = 0), Triangles,
/// Tetrahedra. Other sections and all reference numbers are skipped. Ids in the file begin at 1, in
/// the result at 0.
/// @return invalid_input, naming file and line, if the header is wrong, the file is truncated, a
/// word is not a number, a coordinate is not finite, or a vertex id is out of range.
Status read_medit(const std::string& path, MeditMesh& mesh);

/// Write a MEDIT file of version 2, dimension 3. Reading the file returns the same doubles.
Status write_medit(
  const std::string& path, PointsView points, TrianglesView triangles, TetsView tets);

} // namespace bindpose

#endif
