// Reader and writer of PLY files (see ply.h). A text header lists elements and their properties.
// The values of the elements follow, as text or as raw numbers. All values are parsed, but only x,
// y, z and the lists of vertex ids are stored.
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

/// How the reader uses the values of a property.
enum class Role
{
  skipped,
  x,
  y,
  z,
  corners
};

Role role_of(const Element& element, const Property& property)
{
  if (element.name == "vertex" && !property.list && property.name.size() == 1)
  {
    const std::size_t axis = std::string("xyz").find(property.name);
    constexpr Role axes[] = { Role::x, Role::y, Role::z };
    return axis < 3 ? axes[axis] : Role::skipped;
  }
  if (element.name == "face" && property.list &&
    (property.name == "vertex_indices" || property.name == "vertex_index"))
  {
    return Role::corners;
  }
  return Role::skipped;
}

Status read_list(const std::string& path, ValueReader& values, const Property& property, Role role,
  Index vertices, PolygonMesh& mesh)
{
  double count = 0;
  if (!values.next(property.count_type, count) || !(count >= 0) || count != std::floor(count))
  {
    return values.error(path, "the file is truncated or corrupt: expected the length of a list");
  }
  const std::size_t begin = mesh.corners.size();
  for (double k = 0; k < count; ++k)
  {
    double id = 0;
    if (!values.next(property.type, id))
    {
      return values.error(path, "the file is truncated or corrupt: expected a value of a list");
    }
    if (role != Role::corners)
    {
      continue;
    }
    if (!(id >= 0) || id >= static_cast<double>(vertices) || id != std::floor(id))
    {
      return values.error(path,
        "face " + std::to_string(mesh.polygon_count() + mesh.skipped) +
          " references a vertex that does not exist (there are " + std::to_string(vertices) +
          " vertices)");
    }
    mesh.corners.push_back(static_cast<Index>(id));
  }
  if (role == Role::corners && mesh.corners.size() < begin + 3)
  {
    mesh.corners.resize(begin);
    mesh.skipped += 1;
  }
  else if (role == Role::corners)
  {
    mesh.end_polygon();
  }
  return {};
}

Status read_element(const std::string& path, ValueReader& values, const Element& element,
  Index vertices, PolygonMesh& mesh)
{
  std::vector<Role> roles;
  for (const Property& property : element.properties)
  {
    roles.push_back(role_of(element, property));
  }
  for (Index i = 0; i < element.count; ++i)
  {
    for (std::size_t p = 0; p < roles.size(); ++p)
    {
      if (element.properties[p].list)
      {
        Status status = read_list(path, values, element.properties[p], roles[p], vertices, mesh);
        if (!status.ok())
        {
          return status;
        }
        continue;
      }
      double value = 0;
      if (!values.next(element.properties[p].type, value))
      {
        return values.error(path,
          "the file is truncated or corrupt: " + element.name + " " + std::to_string(i) +
            " has no value of property " + element.properties[p].name);
      }
      if (roles[p] == Role::skipped)
      {
        continue;
      }
      if (!std::isfinite(value))
      {
        return values.error(
          path, "vertex " + std::to_string(i) + " has a coordinate that is not a finite number");
      }
      mesh.points(i, static_cast<int>(roles[p]) - static_cast<int>(Role::x)) = value;
    }
  }
  return {};
}
} // namespace

Status read_ply(const std::string& path, PolygonMesh& mesh)
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
  bool has_faces = false;
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
      int axes = 0;
      for (const Property& property : element.properties)
      {
        axes += role_of(element, property) != Role::skipped;
      }
      if (axes != 3)
      {
        return scanner.error("the element vertex must have the properties x, y and z");
      }
    }
    for (const Property& property : element.properties)
    {
      has_faces = has_faces || role_of(element, property) == Role::corners;
    }
  }
  if (vertices < 0 || !has_faces)
  {
    return scanner.error("the header must have the elements vertex and face");
  }
  mesh.points.setZero(vertices, 3);
  ValueReader values(scanner, text, header.encoding);
  for (const Element& element : header.elements)
  {
    status = read_element(path, values, element, vertices, mesh);
    if (!status.ok())
    {
      mesh = PolygonMesh();
      return status;
    }
  }
  return {};
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
