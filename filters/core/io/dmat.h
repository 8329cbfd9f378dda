#ifndef bindpose_io_dmat_h
#define bindpose_io_dmat_h

#include "base/mesh.h"

#include <string>

namespace bindpose
{

/// Read a DMAT file (libigl's matrix format), ASCII or binary. It contains "columns rows", then the
/// values column by column. Binary files contain "0 0", then "columns rows", then raw little-endian
/// doubles. invalid_input, with the file and, for text, the line, for: a wrong header, a truncated
/// file, words that are not numbers. Values that are not finite are accepted.
Status read_dmat(const std::string& path, Weights& matrix);

enum class DmatEncoding
{
  ascii,
  binary
};

/// Write a matrix. Its values can be read back as the same doubles.
Status write_dmat(
  const std::string& path, WeightsView matrix, DmatEncoding encoding = DmatEncoding::ascii);

} // namespace bindpose

#endif
