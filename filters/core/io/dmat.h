#ifndef bindpose_io_dmat_h
#define bindpose_io_dmat_h

#include "base/mesh.h"

#include <string>

namespace bindpose
{

/// Reads a DMAT file (libigl's matrix format), ASCII or binary: "columns rows", then the values
/// column by column; binary files say "0 0", then "columns rows", then raw little-endian doubles.
/// invalid_input, naming the file and, for text, the line, for: a wrong header, a truncated file,
/// words that are no numbers. Values that are not finite are read as they are.
Status read_dmat(const std::string& path, Weights& matrix);

enum class DmatEncoding
{
  ascii,
  binary
};

/// Writes a matrix; values read back as the same doubles.
Status write_dmat(
  const std::string& path, WeightsView matrix, DmatEncoding encoding = DmatEncoding::ascii);

} // namespace bindpose

#endif
