// Reader and writer of OBJ files (see obj.h). Vertices are lines "v x y z", faces are lines "f a b
// c …". Vertex ids begin at 1, and each corner has the form "a", "a/t", "a//n" or "a/t/n".
// Polylines "l a b …" are used only if there is no face. A line that ends with a backslash
// continues on the next line.
#include "io/obj.h"

#include "io/text_scanner.h"

namespace bindpose
{

namespace
{
Status read_vertex(TextScanner& scanner, std::vector<Vec3>& points)
{
  Vec3 p;
  for (int k = 0; k < 3; ++k)
  {
    Status status = scanner.read_number("a vertex coordinate", p[k]);
    if (!status.ok())
    {
      return status;
    }
  }
  points.push_back(p);
  return {};
}

/// Get the next word of a line, or of its continuation after a backslash.
bool next_continued_word(TextScanner& scanner, std::string_view& word)
{
  while (scanner.next_word(word))
  {
    if (word.back() != '\\' || !TextScanner(scanner).rest_of_line().empty())
    {
      return true;
    }
    scanner.next_line();
    word.remove_suffix(1);
    if (!word.empty())
    {
      return true;
    }
  }
  return false;
}

/// Read the vertex ids of a face or a polyline. Skip entries with fewer than `minimum_vertices`
/// vertices.
Status read_entry(TextScanner& scanner, Index vertices, const std::string& element_name,
  std::size_t minimum_vertices, std::vector<Index>& corners, std::vector<Index>& offsets,
  Index& skipped)
{
  const std::size_t begin = corners.size();
  std::string_view word;
  while (next_continued_word(scanner, word))
  {
    const std::string_view number = word.substr(0, word.find('/'));
    Index id = 0;
    if (!parse_index(number, id))
    {
      return scanner.error("expected a vertex id of a " + element_name);
    }
    const Index vertex = id < 0 ? vertices + id : id - 1;
    if (id == 0 || vertex < 0)
    {
      return scanner.error("a " + element_name + " references vertex " + std::to_string(id) +
        ", which does not exist");
    }
    corners.push_back(vertex);
  }
  if (corners.size() < begin + minimum_vertices)
  {
    corners.resize(begin);
    skipped += 1;
    return {};
  }
  offsets.push_back(static_cast<Index>(corners.size()));
  return {};
}

/// Check ids against the final number of vertices, because ids may precede their vertices.
Status check_entries(const std::string& path, const std::string& element_name,
  const std::vector<Index>& corners, Index count)
{
  for (const Index vertex : corners)
  {
    if (vertex >= count)
    {
      return Status::invalid_input(path + ": a " + element_name + " references vertex " +
        std::to_string(vertex + 1) + ", but there are " + std::to_string(count) + " vertices");
    }
  }
  return {};
}
} // namespace

Status read_obj(const std::string& path, PolygonMesh& mesh)
{
  mesh = PolygonMesh();
  std::string text;
  Status status = read_file(path, text);
  if (!status.ok())
  {
    return status;
  }
  TextScanner scanner(path, text);
  std::vector<Vec3> points;
  while (status.ok() && scanner.next_line())
  {
    std::string_view word;
    scanner.next_word(word);
    if (word == "v")
    {
      status = read_vertex(scanner, points);
    }
    else if (word == "f")
    {
      status = read_entry(scanner, static_cast<Index>(points.size()), "face", 3, mesh.corners,
        mesh.offsets, mesh.skipped);
    }
    else if (word == "l")
    {
      Index skipped = 0;
      status = read_entry(scanner, static_cast<Index>(points.size()), "line", 2, mesh.line_corners,
        mesh.line_offsets, skipped);
    }
  }
  if (mesh.polygon_count() > 0)
  {
    mesh.line_corners.clear();
    mesh.line_offsets.resize(1);
  }
  const auto count = static_cast<Index>(points.size());
  if (status.ok() && (count == 0 || mesh.polygon_count() + mesh.line_count() == 0))
  {
    status = Status::invalid_input(path +
      ": an OBJ file must have vertices and faces, but this file has " + std::to_string(count) +
      " vertices and " + std::to_string(mesh.polygon_count()) + " faces");
  }
  if (status.ok())
  {
    status = check_entries(path, "face", mesh.corners, count);
  }
  if (status.ok())
  {
    status = check_entries(path, "line", mesh.line_corners, count);
  }
  if (!status.ok())
  {
    mesh = PolygonMesh();
    return status;
  }
  mesh.points.resize(static_cast<Index>(points.size()), 3);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points.row(v) = points[v].transpose();
  }
  return status;
}

Status write_obj(const std::string& path, const PolygonMesh& mesh)
{
  std::string text;
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    text += 'v';
    for (int k = 0; k < 3; ++k)
    {
      text += ' ';
      append_number(text, mesh.points(v, k));
    }
    text += '\n';
  }
  for (Index f = 0; f < mesh.polygon_count(); ++f)
  {
    text += 'f';
    for (Index c = mesh.offsets[f]; c < mesh.offsets[f + 1]; ++c)
    {
      text += ' ';
      append_index(text, mesh.corners[c] + 1);
    }
    text += '\n';
  }
  return write_file(path, text);
}

} // namespace bindpose
