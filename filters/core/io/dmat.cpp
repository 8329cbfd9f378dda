// Reader and writer of DMAT files (see dmat.h). A file contains a line "columns rows" and the
// values, column by column, as text or as raw doubles.
#include "io/dmat.h"

#include "io/text_scanner.h"

#include <algorithm>
#include <cstring>

namespace bindpose
{

namespace
{
/// Maximum number of rows or columns of an empty matrix. An empty matrix has no values in the file,
/// so the size of the file does not limit these numbers. Without a limit, a loop over the rows or
/// columns of an invalid file could take hours.
constexpr Index largest_empty = Index(1) << 20;

Status read_size(TextScanner& scanner, Index& columns, Index& rows)
{
  Status status = scanner.read_index("the number of columns", largest_count, columns);
  return status.ok() ? scanner.read_index("the number of rows", largest_count, rows) : status;
}

Status read_ascii(TextScanner& scanner, Weights& matrix)
{
  for (Index c = 0; c < matrix.cols(); ++c)
  {
    for (Index r = 0; r < matrix.rows(); ++r)
    {
      std::string_view word;
      if (!scanner.next_word_across_lines(word))
      {
        return scanner.error("the file is truncated: the matrix has " +
          std::to_string(matrix.cols()) + " columns of " + std::to_string(matrix.rows()) +
          " values, but column " + std::to_string(c) + " has only " + std::to_string(r));
      }
      if (!parse_number(word, matrix(r, c)))
      {
        return scanner.error("expected a number");
      }
    }
  }
  return {};
}
} // namespace

Status read_dmat(const std::string& path, Weights& matrix)
{
  matrix.resize(0, 0);
  std::string text;
  Status status = read_file(path, text);
  if (!status.ok())
  {
    return status;
  }
  TextScanner scanner(path, text, 0);
  Index columns = 0;
  Index rows = 0;
  status = read_size(scanner, columns, rows);
  bool binary = false;
  TextScanner ahead = scanner;
  std::string_view word;
  if (status.ok() && columns == 0 && rows == 0 && ahead.next_word_across_lines(word))
  {
    binary = true;
    status = read_size(scanner, columns, rows);
  }
  if (!status.ok())
  {
    return status;
  }
  if (std::min(columns, rows) == 0 && std::max(columns, rows) > largest_empty)
  {
    return Status::invalid_input(path + ": the matrix size of " + std::to_string(columns) +
      " columns of " + std::to_string(rows) + " values is not valid");
  }
  const std::size_t values = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  const std::size_t left = text.size() - scanner.position();
  if (rows > 0 &&
    (values / static_cast<std::size_t>(rows) != static_cast<std::size_t>(columns) || values > left))
  {
    return Status::invalid_input(path + " is truncated: it is too short for " +
      std::to_string(columns) + " columns of " + std::to_string(rows) + " values");
  }
  matrix.resize(rows, columns);
  if (!binary)
  {
    status = read_ascii(scanner, matrix);
  }
  else if (left < values * sizeof(double))
  {
    status = Status::invalid_input(path + " is truncated: it is too short for " +
      std::to_string(columns) + " columns of " + std::to_string(rows) + " values");
  }
  else
  {
    const char* at = text.data() + scanner.position();
    for (Index c = 0; c < columns; ++c)
    {
      for (Index r = 0; r < rows; ++r, at += sizeof(double))
      {
        std::memcpy(&matrix(r, c), at, sizeof(double));
      }
    }
  }
  if (!status.ok())
  {
    matrix.resize(0, 0);
  }
  return status;
}

Status write_dmat(const std::string& path, WeightsView matrix, DmatEncoding encoding)
{
  const std::string size = std::to_string(matrix.cols()) + " " + std::to_string(matrix.rows());
  std::string text = (encoding == DmatEncoding::binary ? "0 0\n" : "") + size + "\n";
  for (Index c = 0; c < matrix.cols(); ++c)
  {
    for (Index r = 0; r < matrix.rows(); ++r)
    {
      const double value = matrix(r, c);
      if (encoding == DmatEncoding::binary)
      {
        char bytes[sizeof(double)];
        std::memcpy(bytes, &value, sizeof(double));
        text.append(bytes, sizeof(double));
        continue;
      }
      append_number(text, value);
      text += '\n';
    }
  }
  return write_file(path, text);
}

} // namespace bindpose
