// Reader and writer of OBJ files (see obj.h). Vertices are lines "v x y z", faces are lines "f a b
// c …". Vertex ids begin at 1, and each corner has the form "a", "a/t", "a//n" or "a/t/n".
// Polylines "l a b …" are used only if there is no face. A line that ends with a backslash
// continues on the next line.
#include "io/obj.h"

#include "io/text_scanner.h"

#include <map>
#include <utility>

namespace bindpose
{

namespace
{
/// Read the numbers of a line: a vertex, texture coordinates or a normal.
Status read_numbers(TextScanner& scanner, const char* item_name, int count, double* numbers)
{
  for (int k = 0; k < count; ++k)
  {
    Status status = scanner.read_number(item_name, numbers[k]);
    if (!status.ok())
    {
      return status;
    }
  }
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
/// @param words is set to the words of the corners, if it is not null
Status read_entry(TextScanner& scanner, Index vertices, const std::string& element_name,
  std::size_t minimum_vertices, std::vector<Index>& corners, std::vector<Index>& offsets,
  Index& skipped, std::vector<std::string_view>* words = nullptr)
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
    if (words)
    {
      words->push_back(word);
    }
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

/// Collects the look of the faces.
class LookReader
{
public:
  LookReader(TextScanner& scanner, MeshLook& look) : scanner_(scanner), look_(look) {}

  /// Read a line that begins with `word`.
  Status read(std::string_view word)
  {
    if (word == "vt")
    {
      double uv[2] = { 0.0, 0.0 };
      Status status = read_numbers(this->scanner_, "a texture coordinate", 1, uv);
      std::string_view second; // a texture may have one dimension
      if (status.ok() && this->scanner_.next_word(second) && !parse_number(second, uv[1]))
      {
        status = this->scanner_.error("expected a texture coordinate");
      }
      this->texture_.insert(this->texture_.end(), uv, uv + 2);
      return status;
    }
    if (word == "vn")
    {
      double normal[3];
      Status status = read_numbers(this->scanner_, "a coordinate of a normal", 3, normal);
      this->normals_.insert(this->normals_.end(), normal, normal + 3);
      return status;
    }
    const std::string text(this->scanner_.rest_of_line());
    if (word == "usemtl")
    {
      this->material_ = find_or_add(text, this->material_ids_, this->look_.material_names);
    }
    else if (word == "mtllib")
    {
      this->look_.libraries.push_back(text);
    }
    else if (word == "o" || word == "g")
    {
      (word == "o" ? this->object_ : this->group_) = text;
      this->part_ = -1;
    }
    return {};
  }

  /// Read the color after the coordinates of a vertex.
  void end_vertex()
  {
    double color[3];
    std::string_view word;
    int count = 0;
    while (this->scanner_.next_word(word) && count < 3 && parse_number(word, color[count]))
    {
      count += 1;
    }
    if (count == 3)
    {
      this->colors_.insert(this->colors_.end(), color, color + 3);
    }
  }

  /// Add a face with the words of its corners, such as "3/5/1".
  void add_face(const std::vector<std::string_view>& words)
  {
    if (this->part_ < 0)
    {
      const bool both = !this->object_.empty() && !this->group_.empty();
      this->part_ = find_or_add(
        this->object_ + (both ? " " : "") + this->group_, this->part_ids_, this->look_.part_names);
    }
    this->look_.parts.push_back(this->part_);
    this->look_.materials.push_back(this->material_);
    for (const std::string_view word : words)
    {
      const std::size_t first = word.find('/');
      const std::size_t second = first == word.npos ? word.npos : word.find('/', first + 1);
      this->look_.texture_ids.push_back(first == word.npos
          ? -1
          : to_row(word.substr(first + 1, second - first - 1), this->texture_.size() / 2));
      this->look_.normal_ids.push_back(
        second == word.npos ? -1 : to_row(word.substr(second + 1), this->normals_.size() / 3));
    }
  }

  /// Complete the look after the last line.
  void end(Index vertices, Status& status)
  {
    const auto texture = static_cast<Index>(this->texture_.size() / 2);
    const auto normals = static_cast<Index>(this->normals_.size() / 3);
    this->look_.texture =
      Eigen::Map<const decltype(MeshLook::texture)>(this->texture_.data(), texture, 2);
    this->look_.normals = Eigen::Map<const Points>(this->normals_.data(), normals, 3);
    if (static_cast<Index>(this->colors_.size()) == 3 * vertices)
    {
      this->look_.colors = Eigen::Map<const Points>(this->colors_.data(), vertices, 3);
    }
    // Ids may precede their rows.
    const Index wrong = erase_unknown(this->look_.texture_ids, texture) +
      erase_unknown(this->look_.normal_ids, normals);
    if (wrong > 0)
    {
      status.warnings.push_back(std::to_string(wrong) +
        " corners of faces reference texture coordinates or normals that do not exist");
    }
  }

private:
  static constexpr Index unknown = -2; ///< an id that does not exist

  static Index find_or_add(
    const std::string& name, std::map<std::string, Index>& ids, std::vector<std::string>& names)
  {
    const auto [entry, is_new] = ids.insert({ name, static_cast<Index>(names.size()) });
    if (is_new)
    {
      names.push_back(name);
    }
    return entry->second;
  }

  /// Return the row of an id, -1 for an empty word.
  static Index to_row(std::string_view word, std::size_t rows)
  {
    Index id = 0;
    if (word.empty())
    {
      return -1;
    }
    if (!parse_index(word, id) || id == 0 || id < -static_cast<Index>(rows))
    {
      return unknown;
    }
    return id < 0 ? static_cast<Index>(rows) + id : id - 1;
  }

  static Index erase_unknown(std::vector<Index>& ids, Index rows)
  {
    Index wrong = 0;
    for (Index& id : ids)
    {
      if (id == unknown || id >= rows)
      {
        id = -1;
        wrong += 1;
      }
    }
    return wrong;
  }

  TextScanner& scanner_;
  MeshLook& look_;
  std::vector<double> texture_, normals_, colors_;
  std::map<std::string, Index> material_ids_, part_ids_;
  std::string object_, group_;
  Index material_ = -1;
  Index part_ = -1; ///< part of the next face; -1: find it by the names of object and group
};

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
/// @param look is not read if it is null
Status read(const std::string& path, PolygonMesh& mesh, MeshLook* look)
{
  mesh = PolygonMesh();
  std::string text;
  Status status = read_file(path, text);
  if (!status.ok())
  {
    return status;
  }
  TextScanner scanner(path, text);
  MeshLook found;
  LookReader look_reader(scanner, found);
  std::vector<Vec3> points;
  std::vector<std::string_view> words; // corners of a face
  while (status.ok() && scanner.next_line())
  {
    std::string_view word;
    scanner.next_word(word);
    if (word == "v")
    {
      Vec3 p;
      status = read_numbers(scanner, "a vertex coordinate", 3, p.data());
      points.push_back(p);
      if (look)
      {
        look_reader.end_vertex();
      }
    }
    else if (word == "f")
    {
      words.clear();
      const Index faces = mesh.polygon_count();
      status = read_entry(scanner, static_cast<Index>(points.size()), "face", 3, mesh.corners,
        mesh.offsets, mesh.skipped, look ? &words : nullptr);
      if (look && mesh.polygon_count() > faces)
      {
        look_reader.add_face(words);
      }
    }
    else if (word == "l")
    {
      Index skipped = 0;
      status = read_entry(scanner, static_cast<Index>(points.size()), "line", 2, mesh.line_corners,
        mesh.line_offsets, skipped);
    }
    else if (look)
    {
      status = look_reader.read(word);
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
  if (look)
  {
    look_reader.end(count, status);
    *look = std::move(found);
  }
  mesh.points.resize(static_cast<Index>(points.size()), 3);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points.row(v) = points[v].transpose();
  }
  return status;
}
} // namespace

Status read_obj(const std::string& path, PolygonMesh& mesh)
{
  return read(path, mesh, nullptr);
}

Status read_obj(const std::string& path, PolygonMesh& mesh, MeshLook& look)
{
  return read(path, mesh, &look);
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
