// Reader and writer of STL files, which contain a triangle soup (see stl.h). A binary file contains
// 80 bytes, a count, and 50 bytes per triangle. A text file contains the words "vertex x y z"
// between other words. Both formats may begin with the word "solid". Therefore a file is read as
// binary if its size is 84 bytes plus 50 bytes times its triangle count.
#include "io/stl.h"

#include "io/text_scanner.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <unordered_map>

namespace bindpose
{

namespace
{
constexpr std::size_t header_size = 84;
constexpr std::size_t triangle_size = 50;

/// Assigns vertex ids: points with equal coordinates get the same id. Ids are in the order of first
/// appearance.
class Welder
{
public:
  Index id_of(const Vec3& p)
  {
    const Key key{ p.x() + 0.0, p.y() + 0.0, p.z() + 0.0 }; // -0 + 0 is +0
    const auto [entry, inserted] =
      this->ids_.insert({ key, static_cast<Index>(this->points_.size()) });
    if (inserted)
    {
      this->points_.push_back(p);
    }
    return entry->second;
  }
  const std::vector<Vec3>& points() const { return this->points_; }

private:
  using Key = std::array<double, 3>;
  struct Hash
  {
    std::size_t operator()(const Key& key) const
    {
      std::uint64_t hash = 0;
      for (const double x : key)
      {
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof(bits));
        hash = (hash ^ (bits >> 29) ^ bits) * 0x9e3779b97f4a7c15ull;
      }
      return hash ^ (hash >> 32);
    }
  };
  // Used for lookups only. The map is never iterated, because its order is not deterministic.
  std::unordered_map<Key, Index, Hash> ids_;
  std::vector<Vec3> points_;
};

Status read_binary(
  const std::string& path, const std::string& text, Index count, Welder& welder, PolygonMesh& mesh)
{
  const char* at = text.data() + header_size;
  for (Index t = 0; t < count; ++t, at += triangle_size)
  {
    float values[12]; // components of the normal, then of the three corners
    std::memcpy(values, at, sizeof(values));
    for (int corner = 1; corner < 4; ++corner)
    {
      const Vec3 p(values[3 * corner], values[3 * corner + 1], values[3 * corner + 2]);
      if (!p.allFinite())
      {
        return Status::invalid_input(path + ": triangle " + std::to_string(t) +
          " has a coordinate that is not a finite number");
      }
      mesh.corners.push_back(welder.id_of(p));
    }
    mesh.end_polygon();
  }
  return {};
}

/// Report whether a word equals a keyword in lower or upper case.
bool is_keyword(std::string_view word, std::string_view keyword)
{
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

Status read_text(
  const std::string& path, const std::string& text, Welder& welder, PolygonMesh& mesh)
{
  TextScanner scanner(path, text, 0);
  std::string_view word;
  bool ended = false;
  while (scanner.next_word_across_lines(word))
  {
    ended = is_keyword(word, "endsolid");
    if (ended || is_keyword(word, "solid"))
    {
      scanner.rest_of_line(); // skip the name of the solid, which may be any word
    }
    if (!is_keyword(word, "vertex"))
    {
      continue;
    }
    Vec3 p;
    for (int k = 0; k < 3; ++k)
    {
      Status status = scanner.read_number("a vertex coordinate", p[k]);
      if (!status.ok())
      {
        return status;
      }
    }
    mesh.corners.push_back(welder.id_of(p));
    if (mesh.corners.size() % 3 == 0)
    {
      mesh.end_polygon();
    }
  }
  if (!ended || mesh.corners.size() % 3 != 0)
  {
    return scanner.error("the file is truncated: expected the word endsolid");
  }
  return {};
}
} // namespace

Status read_stl(const std::string& path, PolygonMesh& mesh)
{
  mesh = PolygonMesh();
  std::string text;
  Status status = read_file(path, text);
  if (!status.ok())
  {
    return status;
  }
  std::uint32_t count = 0;
  if (text.size() >= header_size)
  {
    std::memcpy(&count, text.data() + header_size - sizeof(count), sizeof(count));
  }
  Welder welder;
  const std::size_t binary_size = header_size + static_cast<std::size_t>(count) * triangle_size;
  std::string_view first_word;
  TextScanner(path, text, 0).next_word_across_lines(first_word);
  const bool begins_as_text = is_keyword(first_word, "solid");
  // Some programs append bytes to a binary file.
  if (text.size() == binary_size || (!begins_as_text && text.size() > binary_size && count > 0))
  {
    status = read_binary(path, text, count, welder, mesh);
  }
  else if (begins_as_text)
  {
    status = read_text(path, text, welder, mesh);
  }
  else
  {
    status = Status::invalid_input(path + " is not a valid STL file: it has " +
      std::to_string(text.size()) + " bytes; expected a text that begins with the word solid, or " +
      std::to_string(binary_size) + " bytes for its " + std::to_string(count) + " triangles");
  }
  if (status.ok() && mesh.corners.empty())
  {
    status = Status::invalid_input(path + " contains no triangles");
  }
  if (!status.ok())
  {
    mesh = PolygonMesh();
    return status;
  }
  mesh.points.resize(static_cast<Index>(welder.points().size()), 3);
  for (Index v = 0; v < mesh.points.rows(); ++v)
  {
    mesh.points.row(v) = welder.points()[v].transpose();
  }
  return status;
}

Status write_stl(const std::string& path, const PolygonMesh& mesh)
{
  Status status = check_float_range(mesh.points);
  if (!status.ok())
  {
    status.message = "an .stl file cannot store the shape: " + status.message;
    return status;
  }
  const Triangles triangles = fan_triangles(mesh);
  std::string text = "binary STL, triangles only";
  text.resize(header_size - sizeof(std::uint32_t), ' ');
  const auto append = [&text](auto value)
  {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    text.append(raw, sizeof(value));
  };
  append(static_cast<std::uint32_t>(triangles.rows()));
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    const Vec3 a = mesh.points.row(triangles(t, 0));
    const Vec3 b = mesh.points.row(triangles(t, 1));
    const Vec3 c = mesh.points.row(triangles(t, 2));
    const Vec3 normal = (b - a).cross(c - a).stableNormalized();
    for (const Vec3& v : { normal, a, b, c })
    {
      for (int k = 0; k < 3; ++k)
      {
        append(static_cast<float>(v[k]));
      }
    }
    append(std::uint16_t(0));
  }
  return write_file(path, text);
}

} // namespace bindpose
