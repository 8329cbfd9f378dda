// Reader and writer of OFF files (see off.h): the word OFF, three counts, then one line per vertex
// and one line per face.
#include "io/off.h"

#include "io/text_scanner.h"

namespace bindpose
{

namespace
{

/// Accept the word OFF with any of the prefixes ST, C, N. The additional values of these variants
/// follow the coordinates and are skipped.
Status read_header(TextScanner& scanner)
{
  std::string_view word;
  if (!scanner.next_word_across_lines(word))
  {
    return scanner.error("the file has no OFF header");
  }
  const std::size_t off = word.find("OFF");
  if (off == std::string_view::npos || off + 3 != word.size())
  {
    return scanner.error("an OFF file must begin with the word OFF");
  }
  for (const char c : word.substr(0, off))
  {
    if (c == '4' || c == 'n')
    {
      return scanner.error(
        "OFF files with vertices that are not three-dimensional are not supported");
    }
    if (c != 'S' && c != 'T' && c != 'C' && c != 'N')
    {
      return scanner.error("an OFF file must begin with the word OFF");
    }
  }
  return {};
}

Status read_counts(TextScanner& scanner, Index& vertices, Index& faces)
{
  TextScanner ahead = scanner;
  std::string_view word;
  if (ahead.next_word_across_lines(word) && word == "BINARY")
  {
    return ahead.error("binary OFF files are not supported");
  }
  Status status = scanner.read_index("the number of vertices", largest_count, vertices);
  if (status.ok())
  {
    status = scanner.read_index("the number of faces", largest_count, faces);
  }
  scanner.rest_of_line(); // skip the number of edges, which may be missing
  return status;
}

Status read_off_vertices(TextScanner& scanner, std::size_t bytes, Index count, Points& points)
{
  // A vertex needs at least three digits and three blanks. Check the count against the file size,
  // so that a wrong count cannot allocate all memory.
  if (static_cast<std::size_t>(count) > bytes / 6 + 1)
  {
    return scanner.error(
      "the file is truncated: it is too short for " + std::to_string(count) + " vertices");
  }
  points.resize(count, 3);
  for (Index v = 0; v < count; ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      Status status = scanner.read_number("a vertex coordinate", points(v, k));
      if (!status.ok())
      {
        return status;
      }
    }
    scanner.rest_of_line();
  }
  return {};
}
} // namespace

Status read_off(const std::string& path, PolygonMesh& mesh)
{
  mesh = PolygonMesh();
  std::string text;
  Status status = read_file(path, text);
  if (!status.ok())
  {
    return status;
  }
  TextScanner scanner(path, text);
  Index vertices = 0;
  Index faces = 0;
  status = read_header(scanner);
  if (status.ok())
  {
    status = read_counts(scanner, vertices, faces);
  }
  if (status.ok())
  {
    status = read_off_vertices(scanner, text.size(), vertices, mesh.points);
  }
  for (Index f = 0; f < faces && status.ok(); ++f)
  {
    Index corners = 0;
    status = scanner.read_index("the number of corners of a face", largest_count, corners);
    const std::size_t begin = mesh.corners.size();
    for (Index k = 0; k < corners && status.ok(); ++k)
    {
      Index vertex = 0;
      status = scanner.read_index("a vertex id of a face", vertices, vertex);
      mesh.corners.push_back(vertex);
    }
    scanner.rest_of_line(); // skip a color
    if (corners < 3)
    {
      mesh.corners.resize(begin);
      mesh.skipped += 1;
      continue;
    }
    mesh.end_polygon();
  }
  if (!status.ok())
  {
    mesh = PolygonMesh();
  }
  return status;
}

Status write_off(const std::string& path, const PolygonMesh& mesh)
{
  std::string text = "OFF\n";
  append_index(text, mesh.points.rows());
  text += ' ';
  append_index(text, mesh.polygon_count());
  text += " 0\n";
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      append_number(text, mesh.points(v, k));
      text += k < 2 ? ' ' : '\n';
    }
  }
  for (Index f = 0; f < mesh.polygon_count(); ++f)
  {
    append_index(text, mesh.offsets[f + 1] - mesh.offsets[f]);
    for (Index c = mesh.offsets[f]; c < mesh.offsets[f + 1]; ++c)
    {
      text += ' ';
      append_index(text, mesh.corners[c]);
    }
    text += '\n';
  }
  return write_file(path, text);
}

} // namespace bindpose
