#ifndef bindpose_io_dmat_h
#define bindpose_io_dmat_h

#include "geometry/mesh.h"

#include <string>

namespace bindpose
{

/// Read a DMAT file (libigl's matrix format), ASCII or binary. An ASCII file contains "columns
/// rows", then the values column by column. A binary file contains "0 0", then "columns rows", then
/// raw little-endian doubles. Values that are not finite are accepted.
/// @return invalid_input, naming the file and, for text, the line, if the header is wrong, the file
/// is truncated, or a word is not a number.
Status read_dmat(const std::string& path, Weights& matrix);

/// The way in which write_dmat() stores the values.
enum class DmatEncoding
{
  ascii,
  binary
};

/// Write a matrix. Reading the file returns the same doubles.
Status write_dmat(
  const std::string& path, WeightsView matrix, DmatEncoding encoding = DmatEncoding::ascii);

} // namespace bindpose

#endif
