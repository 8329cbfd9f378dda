#ifndef bindpose_io_off_h
#define bindpose_io_off_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Read an ASCII OFF file (Geomview's Object File Format).
///
/// Accepted: comments, counts on the line of the word OFF, the variants COFF, NOFF, STOFF and their
/// combinations (colors, normals and texture coordinates are skipped), colors after a face, any
/// text after the last face. Each vertex and each face is on a separate line.
/// invalid_input, with file and line, for: no OFF header, binary or four-dimensional OFF, negative
/// counts, a truncated file, words that are not numbers, coordinates that are not finite, vertex
/// ids out of range. Faces of one or two corners are skipped and counted.
Status read_off(const std::string& path, PolygonMesh& mesh);

/// Write ASCII OFF. Coordinates can be read back as the same doubles.
Status write_off(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
