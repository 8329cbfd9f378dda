// Reader and writer of MEDIT files (see medit.h). A file consists of keywords. A keyword is
// followed by a count and by this number of lines, which contain numbers. The last number of a line
// is a reference number, which is not used. An unknown keyword and its numbers are skipped up to
// the next keyword.
#include "io/medit.h"

#include "io/text_scanner.h"

namespace bindpose
{

namespace
{

Status read_count(TextScanner& scanner, std::size_t bytes, Index& count)
{
  Status status = scanner.read_index("a number of entries", largest_count, count);
  if (status.ok() && static_cast<std::size_t>(count) > bytes / 4 + 1)
  {
    status = scanner.error(
      "the file is truncated: it is too short for " + std::to_string(count) + " entries");
  }
  return status;
}

Status read_medit_vertices(TextScanner& scanner, std::size_t bytes, Index dimension, Points& points)
{
  Index count = 0;
  Status status = read_count(scanner, bytes, count);
  if (!status.ok())
  {
    return status;
  }
  points.setZero(count, 3);
  for (Index v = 0; v < count && status.ok(); ++v)
  {
    for (Index k = 0; k < dimension && status.ok(); ++k)
    {
      status = scanner.read_number("a vertex coordinate", points(v, k));
    }
    std::string_view reference;
    if (status.ok() && !scanner.next_word_across_lines(reference))
    {
      status = scanner.error("the file ends before the last vertex");
    }
  }
  return status;
}

template <typename Elements>
Status read_elements(TextScanner& scanner, std::size_t bytes, Elements& elements)
{
  Index count = 0;
  Status status = read_count(scanner, bytes, count);
  if (!status.ok())
  {
    return status;
  }
  elements.setZero(count, elements.cols());
  for (Index e = 0; e < count && status.ok(); ++e)
  {
    for (Index k = 0; k < elements.cols() && status.ok(); ++k)
    {
      status = scanner.read_index("a vertex id", largest_count, elements(e, k));
    }
    std::string_view reference;
    if (status.ok() && !scanner.next_word_across_lines(reference))
    {
      status = scanner.error("the file ends before the last element");
    }
  }
  if (status.ok())
  {
    elements.array() -= 1;
  }
  return status;
}

template <typename Elements>
Status check_ids(
  const std::string& path, const char* name, Index vertices, const Elements& elements)
{
  for (Index k = 0; k < elements.size(); ++k)
  {
    const Index id = elements.data()[k];
    if (id < 0 || id >= vertices)
    {
      return Status::invalid_input(path + ": " + name + " " +
        std::to_string(k / elements.cols() + 1) + " references vertex " + std::to_string(id + 1) +
        ", but there are " + std::to_string(vertices) + " vertices");
    }
  }
  return {};
}

Status read_sections(TextScanner& scanner, std::size_t bytes, MeditMesh& mesh)
{
  Index dimension = 3;
  std::string_view word;
  Status status;
  while (status.ok() && scanner.next_word_across_lines(word) && word != "End")
  {
    if (word == "Dimension")
    {
      status = scanner.read_index("the dimension", 4, dimension);
      if (status.ok() && dimension < 2)
      {
        status = scanner.error("the dimension must be 2 or 3");
      }
    }
    else if (word == "Vertices")
    {
      status = read_medit_vertices(scanner, bytes, dimension, mesh.points);
    }
    else if (word == "Triangles")
    {
      status = read_elements(scanner, bytes, mesh.triangles);
    }
    else if (word == "Tetrahedra")
    {
      status = read_elements(scanner, bytes, mesh.tets);
    }
    // Any other word is an unknown keyword or one of its numbers, and is skipped.
  }
  return status;
}
} // namespace

Status read_medit(const std::string& path, MeditMesh& mesh)
{
  mesh = MeditMesh();
  std::string text;
  Status status = read_file(path, text);
  if (!status.ok())
  {
    return status;
  }
  TextScanner scanner(path, text);
  std::string_view word;
  Index version = 0;
  if (!scanner.next_word_across_lines(word) || word != "MeshVersionFormatted" ||
    !scanner.read_index("the version", 10, version).ok())
  {
    return scanner.error("an ASCII MEDIT file must begin with MeshVersionFormatted and a number");
  }
  status = read_sections(scanner, text.size(), mesh);
  if (status.ok() && mesh.points.rows() == 0)
  {
    status = scanner.error("the file has no vertices");
  }
  if (status.ok())
  {
    status = check_ids(path, "triangle", mesh.points.rows(), mesh.triangles);
  }
  if (status.ok())
  {
    status = check_ids(path, "tet", mesh.points.rows(), mesh.tets);
  }
  if (!status.ok())
  {
    mesh = MeditMesh();
  }
  return status;
}

namespace
{
template <typename View>
void append_elements(std::string& text, const char* keyword, const View& elements)
{
  if (elements.rows() == 0)
  {
    return;
  }
  text += keyword;
  text += '\n';
  append_index(text, elements.rows());
  text += '\n';
  for (Index e = 0; e < elements.rows(); ++e)
  {
    for (Index k = 0; k < elements.cols(); ++k)
    {
      append_index(text, elements(e, k) + 1);
      text += ' ';
    }
    text += "0\n";
  }
}
} // namespace

Status write_medit(
  const std::string& path, PointsView points, TrianglesView triangles, TetsView tets)
{
  std::string text = "MeshVersionFormatted 2\nDimension 3\nVertices\n";
  append_index(text, points.rows());
  text += '\n';
  for (Index v = 0; v < points.rows(); ++v)
  {
    for (int k = 0; k < 3; ++k)
    {
      append_number(text, points(v, k));
      text += ' ';
    }
    text += "0\n";
  }
  append_elements(text, "Triangles", triangles);
  append_elements(text, "Tetrahedra", tets);
  text += "End\n";
  return write_file(path, text);
}

} // namespace bindpose
