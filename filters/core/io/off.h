#ifndef bindpose_io_off_h
#define bindpose_io_off_h

#include "io/polygon_mesh.h"

namespace bindpose
{

/// Read an ASCII OFF file (Geomview's Object File Format).
///
/// The file may contain comments, colors after a face, and any text after the last face. The
/// element counts may be on the line of the word OFF. The variants COFF, NOFF, STOFF and their
/// combinations are supported; their colors, normals and texture coordinates are skipped. Each
/// vertex and each face is on a separate line. Faces of one or two corners are skipped and counted.
/// @return invalid_input, naming file and line, if there is no OFF header, the format is binary or
/// four-dimensional OFF, a count is negative, the file is truncated, a word is not a number, a
/// coordinate is not finite, or a vertex id is out of range.
Status read_off(const std::string& path, PolygonMesh& mesh);

/// Write ASCII OFF. Reading the file returns the same doubles.
Status write_off(const std::string& path, const PolygonMesh& mesh);

} // namespace bindpose

#endif
