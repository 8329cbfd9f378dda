#ifndef bindpose_io_medit_h
#define bindpose_io_medit_h

#include "base/mesh.h"

#include <string>

namespace bindpose
{

/// The content of a MEDIT file that is read: tets, triangles or both, over the same vertices.
struct MeditMesh
{
  Points points;
  Triangles triangles;
  Tets tets;
};

/// Read an ASCII MEDIT file (INRIA's .mesh): Vertices (2D vertices get z = 0), Triangles,
/// Tetrahedra. Other sections and all references are skipped. Ids are those of the file minus one.
/// invalid_input, with file and line, for: a wrong header, a truncated file, words that are not
/// numbers, coordinates that are not finite, vertex ids out of range.
Status read_medit(const std::string& path, MeditMesh& mesh);

/// Write version 2, dimension 3. Coordinates can be read back as the same doubles.
Status write_medit(
  const std::string& path, PointsView points, TrianglesView triangles, TetsView tets);

} // namespace bindpose

#endif
