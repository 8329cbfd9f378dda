#ifndef bindpose_io_off_h
#define bindpose_io_off_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Reads an ASCII OFF file (Geomview's Object File Format).
///
/// Tolerated: comments, counts on the line of the word OFF, the variants COFF, NOFF, STOFF and
/// their mixtures (colours, normals, texture coordinates are skipped), colours behind a face,
/// anything behind the last face. One vertex and one face a line.
/// invalid_input, naming file and line, for: no OFF header, binary or four-dimensional OFF,
/// negative counts, a truncated file, words that are no numbers, coordinates that are not finite,
/// vertex ids out of range. Faces of one or two corners are skipped and counted.
Status read_off(const std::string& path, PolygonMesh& mesh);

/// Writes ASCII OFF; coordinates read back as the same doubles.
Status write_off(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
