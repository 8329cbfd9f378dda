// Reader and writer of PLY files (see ply.h). A text header lists elements and their properties.
// The values of the elements follow, as text or as raw numbers. All values are parsed, but only x,
// y, z, the lists of vertex ids, and the look of the faces are stored.
#include "io/ply.h"

#include "io/text_scanner.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace bindpose
{

namespace
{
enum class Type
{
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  float32,
  float64
};

struct Property
{
  std::string name;
  Type type = Type::float64;
  Type count_type = Type::uint8;
  bool list = false;
};

struct Element
{
  std::string name;
  Index count = 0;
  std::vector<Property> properties;
};

enum class Encoding
{
  ascii,
  little_endian,
  big_endian
};

struct Header
{
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::string picture; ///< the text after "comment TextureFile"
};

bool parse_type(std::string_view word, Type& type)
{
  static const std::pair<const char*, Type> names[] = { { "char", Type::int8 },
    { "int8", Type::int8 }, { "uchar", Type::uint8 }, { "uint8", Type::uint8 },
    { "short", Type::int16 }, { "int16", Type::int16 }, { "ushort", Type::uint16 },
    { "uint16", Type::uint16 }, { "int", Type::int32 }, { "int32", Type::int32 },
    { "uint", Type::uint32 }, { "uint32", Type::uint32 }, { "float", Type::float32 },
    { "float32", Type::float32 }, { "double", Type::float64 }, { "float64", Type::float64 } };
  for (const auto& [name, value] : names)
  {
    if (word == name)
    {
      type = value;
      return true;
    }
  }
  return false;
}

std::size_t size_of(Type type)
{
  constexpr std::size_t sizes[] = { 1, 1, 2, 2, 4, 4, 4, 8 };
  return sizes[static_cast<int>(type)];
}

Status read_property(TextScanner& scanner, Header& header)
{
  std::string_view word;
  Property property;
  bool known = scanner.next_word(word) && !header.elements.empty();
  if (known && word == "list")
  {
    property.list = true;
    known =
      scanner.next_word(word) && parse_type(word, property.count_type) && scanner.next_word(word);
  }
  known = known && parse_type(word, property.type) && scanner.next_word(word);
  if (!known)
  {
    return scanner.error("a property must have a known type and a name");
  }
  property.name = std::string(word);
  header.elements.back().properties.push_back(property);
  return {};
}

Status read_header(TextScanner& scanner, Header& header)
{
  std::string_view word;
  if (!scanner.next_line() || !scanner.next_word(word) || word != "ply")
  {
    return scanner.error("a PLY file must begin with the word ply");
  }
  while (scanner.next_line() && scanner.next_word(word))
  {
    Status status;
    if (word == "format")
    {
      scanner.next_word(word);
      if (word == "ascii")
      {
        header.encoding = Encoding::ascii;
      }
      else if (word == "binary_little_endian")
      {
        header.encoding = Encoding::little_endian;
      }
      else if (word == "binary_big_endian")
      {
        header.encoding = Encoding::big_endian;
      }
      else
      {
        return scanner.error(
          "unknown PLY format; expected ascii, binary_little_endian or binary_big_endian");
      }
    }
    else if (word == "element")
    {
      Element element;
      scanner.next_word(word);
      element.name = std::string(word);
      status = scanner.read_index("a number of elements", Index(1) << 40, element.count);
      header.elements.push_back(element);
    }
    else if (word == "comment" && scanner.next_word(word) && word == "TextureFile")
    {
      header.picture = scanner.rest_of_line();
    }
    else if (word == "property")
    {
      status = read_property(scanner, header);
    }
    else if (word == "end_header")
    {
      return {};
    }
    if (!status.ok())
    {
      return status;
    }
  }
  return scanner.error("the header has no line end_header");
}

/// Reads one value after the other, in any of the three encodings.
class ValueReader
{
public:
  ValueReader(TextScanner& scanner, std::string_view text, Encoding encoding)
    : scanner_(scanner), bytes_(text.substr(scanner.position())), encoding_(encoding)
  {
  }

  bool next(Type type, double& value)
  {
    if (this->encoding_ == Encoding::ascii)
    {
      std::string_view word;
      return this->scanner_.next_word_across_lines(word) && parse_number(word, value);
    }
    const std::size_t size = size_of(type);
    if (this->bytes_.size() < size)
    {
      return false;
    }
    char raw[8];
    std::memcpy(raw, this->bytes_.data(), size);
    this->bytes_.remove_prefix(size);
    if (this->encoding_ == Encoding::big_endian)
    {
      std::reverse(raw, raw + size);
    }
    value = decode(type, raw);
    return true;
  }

  std::size_t bytes_left() const { return this->bytes_.size(); }

  Status error(const std::string& path, const std::string& sentence) const
  {
    return this->encoding_ == Encoding::ascii ? this->scanner_.error(sentence)
                                              : Status::invalid_input(path + ": " + sentence);
  }

private:
  template <typename T>
  static double convert(const char* raw)
  {
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return static_cast<double>(value);
  }
  static double decode(Type type, const char* raw)
  {
    switch (type)
    {
      case Type::int8:
        return convert<std::int8_t>(raw);
      case Type::uint8:
        return convert<std::uint8_t>(raw);
      case Type::int16:
        return convert<std::int16_t>(raw);
      case Type::uint16:
        return convert<std::uint16_t>(raw);
      case Type::int32:
        return convert<std::int32_t>(raw);
      case Type::uint32:
        return convert<std::uint32_t>(raw);
      case Type::float32:
        return convert<float>(raw);
      case Type::float64:
        break;
    }
    return convert<double>(raw);
  }

  TextScanner& scanner_;
  std::string_view bytes_;
  Encoding encoding_;
};

/// How the reader uses the values of a property. The values of a vertex are stored in the order of
/// the roles from x to v.
enum class Role
{
  skipped,
  x,
  y,
  z,
  normal_x,
  normal_y,
  normal_z,
  red,
  green,
  blue,
  u,
  v,
  corners,
  corner_texture ///< u and v of the corners of a face
};

constexpr int vertex_roles = static_cast<int>(Role::v); ///< number of values of a vertex

/// The data of vertices and corners besides positions and vertex ids.
struct VertexLook
{
  /// #V x vertex_roles: the values in the order of the roles.
  Eigen::Matrix<double, Eigen::Dynamic, vertex_roles, Eigen::RowMajor> values;
  std::vector<double> corner_texture; ///< u and v of the corners of the faces
  std::vector<Index> corner_ids; ///< per corner: row of corner_texture, or -1
};

Role role_of(const Element& element, const Property& property)
{
  static const std::pair<const char*, Role> vertex_names[] = { { "x", Role::x }, { "y", Role::y },
    { "z", Role::z }, { "nx", Role::normal_x }, { "ny", Role::normal_y }, { "nz", Role::normal_z },
    { "red", Role::red }, { "green", Role::green }, { "blue", Role::blue }, { "s", Role::u },
    { "t", Role::v }, { "u", Role::u }, { "v", Role::v }, { "texture_u", Role::u },
    { "texture_v", Role::v } };
  if (element.name == "vertex" && !property.list)
  {
    for (const auto& [name, role] : vertex_names)
    {
      if (property.name == name)
      {
        return role;
      }
    }
  }
  if (element.name == "face" && property.list)
  {
    const bool are_corners = property.name == "vertex_indices" || property.name == "vertex_index";
    return are_corners              ? Role::corners
      : property.name == "texcoord" ? Role::corner_texture
                                    : Role::skipped;
  }
  return Role::skipped;
}

bool has_role(const Header& header, Role role)
{
  for (const Element& element : header.elements)
  {
    for (const Property& property : element.properties)
    {
      if (role_of(element, property) == role)
      {
        return true;
      }
    }
  }
  return false;
}

/// Return the factor from stored colors to values from 0 to 1.
double color_scale(Type type)
{
  return type == Type::uint8 ? 1.0 / 255.0 : type == Type::uint16 ? 1.0 / 65535.0 : 1.0;
}

/// Read a list. Its values are added to the corners of the mesh or to `texture`, or skipped.
Status read_list(const std::string& path, ValueReader& values, const Property& property, Role role,
  PolygonMesh& mesh, std::vector<double>& texture)
{
  double count = 0;
  if (!values.next(property.count_type, count) || !(count >= 0) || count != std::floor(count))
  {
    return values.error(path, "the file is truncated or corrupt: expected the length of a list");
  }
  const auto vertices = static_cast<double>(mesh.points.rows());
  for (double k = 0; k < count; ++k)
  {
    double value = 0;
    if (!values.next(property.type, value))
    {
      return values.error(path, "the file is truncated or corrupt: expected a value of a list");
    }
    if (role == Role::corner_texture)
    {
      texture.push_back(value);
    }
    if (role != Role::corners)
    {
      continue;
    }
    if (!(value >= 0) || value >= vertices || value != std::floor(value))
    {
      return values.error(path,
        "face " + std::to_string(mesh.polygon_count() + mesh.skipped) +
          " references a vertex that does not exist (there are " +
          std::to_string(mesh.points.rows()) + " vertices)");
    }
    mesh.corners.push_back(static_cast<Index>(value));
  }
  return {};
}

/// End the face whose corners begin at `begin`. Skip it if it has fewer than three corners.
/// @param texture u and v of its corners, in the order of the corners
void end_face(
  std::size_t begin, const std::vector<double>& texture, PolygonMesh& mesh, VertexLook* look)
{
  const std::size_t corners = mesh.corners.size() - begin;
  if (corners < 3)
  {
    mesh.corners.resize(begin);
    mesh.skipped += 1;
    return;
  }
  mesh.end_polygon();
  if (look)
  {
    const bool has_texture = texture.size() == 2 * corners &&
      std::all_of(texture.begin(), texture.end(), [](double x) { return std::isfinite(x); });
    for (std::size_t k = 0; k < corners; ++k)
    {
      look->corner_ids.push_back(
        has_texture ? static_cast<Index>(look->corner_texture.size() / 2 + k) : -1);
    }
    if (has_texture)
    {
      look->corner_texture.insert(look->corner_texture.end(), texture.begin(), texture.end());
    }
  }
}

Status read_element(const std::string& path, ValueReader& values, const Element& element,
  PolygonMesh& mesh, VertexLook* look)
{
  std::vector<Role> roles;
  for (const Property& property : element.properties)
  {
    roles.push_back(role_of(element, property));
  }
  const bool has_corners = std::find(roles.begin(), roles.end(), Role::corners) != roles.end();
  std::vector<double> texture;
  for (Index i = 0; i < element.count; ++i)
  {
    const std::size_t begin = mesh.corners.size();
    texture.clear();
    for (std::size_t p = 0; p < roles.size(); ++p)
    {
      if (element.properties[p].list)
      {
        Status status = read_list(path, values, element.properties[p], roles[p], mesh, texture);
        if (!status.ok())
        {
          return status;
        }
        continue;
      }
      double value = 0;
      const Type type = element.properties[p].type;
      if (!values.next(type, value))
      {
        return values.error(path,
          "the file is truncated or corrupt: " + element.name + " " + std::to_string(i) +
            " has no value of property " + element.properties[p].name);
      }
      const Role role = roles[p];
      if (role >= Role::x && role <= Role::z)
      {
        if (!std::isfinite(value))
        {
          return values.error(
            path, "vertex " + std::to_string(i) + " has a coordinate that is not a finite number");
        }
        mesh.points(i, static_cast<int>(role) - static_cast<int>(Role::x)) = value;
      }
      else if (role != Role::skipped && look)
      {
        const bool is_color = role >= Role::red && role <= Role::blue;
        look->values(i, static_cast<int>(role) - static_cast<int>(Role::x)) =
          std::isfinite(value) ? value * (is_color ? color_scale(type) : 1.0) : 0.0;
      }
    }
    if (has_corners)
    {
      end_face(begin, texture, mesh, look);
    }
  }
  return {};
}

/// Convert the data of vertices and corners to a look.
void make_look(
  const Header& header, const PolygonMesh& mesh, const VertexLook& vertices, MeshLook& look)
{
  look = MeshLook();
  const auto columns = [&vertices](Role first, int count) {
    return vertices.values.middleCols(static_cast<int>(first) - static_cast<int>(Role::x), count);
  };
  const std::size_t corners = mesh.corners.size();
  look.texture_ids.assign(corners, -1);
  look.normal_ids.assign(corners, -1);
  if (has_role(header, Role::normal_x) && has_role(header, Role::normal_y) &&
    has_role(header, Role::normal_z))
  {
    look.normals = columns(Role::normal_x, 3);
    look.normal_ids = mesh.corners;
  }
  if (has_role(header, Role::red) && has_role(header, Role::green) && has_role(header, Role::blue))
  {
    look.colors = columns(Role::red, 3);
  }
  if (!vertices.corner_texture.empty())
  {
    look.texture = Eigen::Map<const decltype(MeshLook::texture)>(
      vertices.corner_texture.data(), static_cast<Index>(vertices.corner_texture.size() / 2), 2);
    look.texture_ids = vertices.corner_ids;
  }
  else if (has_role(header, Role::u) && has_role(header, Role::v))
  {
    look.texture = columns(Role::u, 2);
    look.texture_ids = mesh.corners;
  }
  const auto polygons = static_cast<std::size_t>(mesh.polygon_count());
  look.parts.assign(polygons, 0);
  look.part_names = { "" };
  look.picture = header.picture;
  look.materials.assign(polygons, look.picture.empty() ? -1 : 0);
  look.material_names.assign(look.picture.empty() ? 0 : 1, "texture");
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
  TextScanner scanner(path, text, 0);
  Header header;
  status = read_header(scanner, header);
  if (!status.ok())
  {
    return status;
  }
  Index vertices = -1;
  for (const Element& element : header.elements)
  {
    if (static_cast<std::size_t>(element.count) > text.size())
    {
      return scanner.error("the file is truncated: it is too short for " +
        std::to_string(element.count) + " elements '" + element.name + "'");
    }
    if (element.name == "vertex" && vertices >= 0)
    {
      return scanner.error("the header has two elements vertex");
    }
    if (element.name == "vertex")
    {
      vertices = element.count;
    }
  }
  if (vertices < 0 || !has_role(header, Role::corners))
  {
    return scanner.error("the header must have the elements vertex and face");
  }
  if (!has_role(header, Role::x) || !has_role(header, Role::y) || !has_role(header, Role::z))
  {
    return scanner.error("the element vertex must have the properties x, y and z");
  }
  mesh.points.setZero(vertices, 3);
  VertexLook vertex_look;
  if (look)
  {
    vertex_look.values.setZero(vertices, vertex_roles);
  }
  ValueReader values(scanner, text, header.encoding);
  for (const Element& element : header.elements)
  {
    status = read_element(path, values, element, mesh, look ? &vertex_look : nullptr);
    if (!status.ok())
    {
      mesh = PolygonMesh();
      return status;
    }
  }
  if (look)
  {
    make_look(header, mesh, vertex_look, *look);
  }
  return {};
}
} // namespace

Status read_ply(const std::string& path, PolygonMesh& mesh)
{
  return read(path, mesh, nullptr);
}

Status read_ply(const std::string& path, PolygonMesh& mesh, MeshLook& look)
{
  return read(path, mesh, &look);
}

Status write_ply(const std::string& path, const PolygonMesh& mesh)
{
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
    std::to_string(mesh.points.rows()) +
    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
    std::to_string(mesh.polygon_count()) + "\nproperty list int int vertex_indices\nend_header\n";
  const auto append = [&text](auto value)
  {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    text.append(raw, sizeof(value));
  };
  for (Index k = 0; k < mesh.points.size(); ++k)
  {
    append(mesh.points.data()[k]);
  }
  for (Index f = 0; f < mesh.polygon_count(); ++f)
  {
    append(static_cast<std::int32_t>(mesh.offsets[f + 1] - mesh.offsets[f]));
    for (Index c = mesh.offsets[f]; c < mesh.offsets[f + 1]; ++c)
    {
      append(static_cast<std::int32_t>(mesh.corners[c]));
    }
  }
  return write_file(path, text);
}

} // namespace bindpose
