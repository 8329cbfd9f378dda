#ifndef bindpose_io_medit_h
#define bindpose_io_medit_h

#include "base/mesh.h"

#include <string>

namespace bindpose
{

/// What is used of a MEDIT file: tets, triangles or both over the same vertices.
struct MeditMesh
{
  Points points;
  Triangles triangles;
  Tets tets;
};

/// Reads an ASCII MEDIT file (INRIA's .mesh): Vertices (2D ones get z = 0), Triangles, Tetrahedra.
/// Other sections and all references are skipped. Ids are as in the file, less one.
/// invalid_input, naming file and line, for: a wrong header, a truncated file, words that are no
/// numbers, coordinates that are not finite, vertex ids out of range.
Status read_medit(const std::string& path, MeditMesh& mesh);

/// Writes version 2, dimension 3; coordinates read back as the same doubles.
Status write_medit(
  const std::string& path, PointsView points, TrianglesView triangles, TetsView tets);

} // namespace bindpose

#endif
