// Parsing of glTF files (see gltf_model.h). tinygltf reads buffers through a callback, and no files
// of images.
#include "gltf/gltf_model.h"

#include "gltf/gltf_integers.h"
#include "io/json_depth.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <new>
#include <numeric>
#include <string_view>

namespace bindpose
{

namespace
{
bool is_buffer_file(const std::string& path, void* files)
{
  return is_in_folder(path, static_cast<GltfBufferFiles*>(files)->folder);
}

std::string keep_path(const std::string& path, void*)
{
  return path;
}

bool read_bytes(
  std::vector<unsigned char>* bytes, std::string* reason, const std::string& path, void* files)
{
  static_cast<GltfBufferFiles*>(files)->paths.push_back(path);
  std::string content;
  const Status status = read_file(path, content);
  bytes->assign(content.begin(), content.end());
  *reason = status.message;
  return status.ok();
}

/// Keep the bytes of an image that is in the JSON text. Other images are read by
/// read_gltf_image().
bool keep_image(tinygltf::Image* image, int, std::string*, std::string*, int, int,
  const unsigned char* bytes, int size, void*)
{
  if (image->bufferView < 0)
  {
    image->image.assign(bytes, bytes + size);
  }
  return true;
}

template <typename T>
double number_at(const unsigned char* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double component_at(const unsigned char* bytes, int type)
{
  switch (type)
  {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return number_at<std::int8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return number_at<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return number_at<std::int16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return number_at<std::uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return number_at<std::uint32_t>(bytes);
    default:
      return number_at<float>(bytes);
  }
}

std::size_t component_size(int type)
{
  switch (type)
  {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      throw GltfError("an accessor has an unknown component type");
  }
}

/// Return the divisor of normalized integers: the largest value of the component type.
double normalization_divisor(int type)
{
  switch (type)
  {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return 127.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 255.0;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return 32767.0;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 65535.0;
    default:
      return 1.0;
  }
}

template <int Size>
bool read_vector(const std::vector<double>& from, Eigen::Matrix<double, Size, 1>& to)
{
  if (from.empty())
  {
    return true;
  }
  if (from.size() != Size)
  {
    return false;
  }
  to = Eigen::Map<const Eigen::Matrix<double, Size, 1>>(from.data());
  return to.allFinite();
}

} // namespace

bool is_in_folder(const std::string& path, const std::string& folder)
{
  std::error_code error;
  const auto file = std::filesystem::canonical(path, error);
  if (error || !std::filesystem::is_regular_file(file, error))
  {
    return false;
  }
  const auto root = std::filesystem::canonical(folder, error);
  return !error &&
    std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first == root.end();
}

tinygltf::Model parse_gltf(const std::string& content, GltfBufferFiles& files)
{
  const bool binary = content.compare(0, 4, "glTF") == 0;
  if (content.size() > 0xffffffffULL)
  {
    throw GltfError("the file is larger than 4 GB, which is not supported");
  }
  std::string_view text(content);
  if (binary)
  {
    std::uint32_t length = 0;
    if (content.size() >= 20)
    {
      std::memcpy(&length, content.data() + 12, sizeof(length));
    }
    text = text.substr(std::min<std::size_t>(20, text.size()), length);
  }
  const Status depth = check_json_depth(text);
  const Status checked = depth.ok() ? check_gltf_integers(text) : depth;
  if (!checked.ok())
  {
    throw GltfError("the file is not valid: " + checked.message);
  }
  tinygltf::Model model;
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(keep_image, nullptr);
  std::string errors;
  std::string warnings;
  const auto size = static_cast<unsigned int>(content.size());
  parser.SetFsCallbacks({ is_buffer_file, keep_path, read_bytes, nullptr, &files });
  bool parsed = false;
  try
  {
    parsed = binary
      ? parser.LoadBinaryFromMemory(&model, &errors, &warnings,
          reinterpret_cast<const unsigned char*>(content.data()), size, files.folder)
      : parser.LoadASCIIFromString(&model, &errors, &warnings, content.data(), size, files.folder);
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception& error) // thrown for JSON values of a wrong type
  {
    errors = error.what();
  }
  if (!parsed)
  {
    const std::string first = errors.substr(0, errors.find('\n')).substr(0, 200);
    throw GltfError(first.empty() ? "not a glTF file" : "the file is not valid: " + first);
  }
  if (model.asset.version.compare(0, 2, "2.") != 0)
  {
    throw GltfError(
      "glTF " + model.asset.version.substr(0, 20) + " is not supported; expected 2.0");
  }
  for (const std::string& extension : model.extensionsRequired)
  {
    // Accept extensions for materials, textures and lights, and other number types of attributes.
    // All other extensions can change the geometry of a mesh or a node.
    const auto begins_with = [&](const char* name) { return extension.rfind(name, 0) == 0; };
    if (!begins_with("KHR_materials_") && !begins_with("KHR_texture_") &&
      !begins_with("EXT_texture_") && !begins_with("KHR_lights_") &&
      extension != "KHR_mesh_quantization")
    {
      throw GltfError("the required extension " + extension.substr(0, 100) + " is not supported");
    }
  }
  return model;
}

GltfAccessors::GltfAccessors(const tinygltf::Model& model, std::size_t file_size) : model_(model)
{
  for (const tinygltf::Buffer& buffer : model.buffers)
  {
    this->bytes_ += buffer.data.size();
  }
  this->bytes_ = std::max(this->bytes_, file_size);
}

Index GltfAccessors::count(int id, const char* item_name) const
{
  // A sparse accessor stores no bytes for zeros. As a sanity check, the number of its elements must
  // not exceed the number of bytes in the file.
  const std::size_t count = gltf_element(this->model_.accessors, id, "accessor").count;
  if (count == 0 || count > this->bytes_)
  {
    throw GltfError(std::string(item_name) + ": the number of elements is " +
      std::to_string(count) + "; it must be at least 1 and fit into the file");
  }
  return static_cast<Index>(count);
}

GltfNumbers GltfAccessors::read(int id, int type, const char* item_name) const
{
  const tinygltf::Accessor& accessor = gltf_element(this->model_.accessors, id, "accessor");
  if (accessor.type != type)
  {
    throw GltfError(std::string(item_name) + ": unexpected number of components");
  }
  const int columns = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
  const std::size_t size = component_size(accessor.componentType);
  const Index count = this->count(id, item_name);
  if (accessor.bufferView < 0 && !accessor.sparse.isSparse)
  {
    throw GltfError(std::string(item_name) + ": no data");
  }
  GltfNumbers numbers;
  if (accessor.bufferView >= 0)
  {
    const View view = this->view(
      accessor.bufferView, accessor.byteOffset, accessor.count, columns * size, item_name);
    numbers.resize(count, columns);
    for (Index r = 0; r < count; ++r)
    {
      for (int c = 0; c < columns; ++c)
      {
        numbers(r, c) =
          component_at(view.data + r * view.stride + c * size, accessor.componentType);
      }
    }
  }
  else
  {
    numbers.setZero(count, columns);
  }
  if (accessor.sparse.isSparse)
  {
    this->replace(accessor, columns, size, item_name, numbers);
  }
  if (accessor.normalized)
  {
    numbers /= normalization_divisor(accessor.componentType);
    numbers = numbers.cwiseMax(-1.0);
  }
  return numbers;
}

GltfNumbers GltfAccessors::read_finite(int id, int type, const char* item_name) const
{
  GltfNumbers numbers = this->read(id, type, item_name);
  if (!numbers.allFinite())
  {
    throw GltfError(std::string(item_name) + ": a value is not finite");
  }
  return numbers;
}

GltfNumbers GltfAccessors::read_ids(int id, int type, const char* item_name) const
{
  const int component = gltf_element(this->model_.accessors, id, "accessor").componentType;
  if (component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
    component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
    component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
  {
    throw GltfError(std::string(item_name) + ": expected unsigned integers");
  }
  return this->read(id, type, item_name);
}

GltfAccessors::View GltfAccessors::view(
  int id, std::size_t offset, std::size_t count, std::size_t size, const char* item_name) const
{
  const tinygltf::BufferView& view = gltf_element(this->model_.bufferViews, id, "buffer view");
  const tinygltf::Buffer& buffer = gltf_element(this->model_.buffers, view.buffer, "buffer");
  const std::size_t stride = view.byteStride > 0 ? view.byteStride : size;
  const std::size_t all = buffer.data.size();
  if (view.byteOffset > all || view.byteLength > all - view.byteOffset ||
    offset > view.byteLength || stride > all || size > view.byteLength - offset || stride < size ||
    (count - 1) > (view.byteLength - offset - size) / stride)
  {
    throw GltfError(std::string(item_name) + ": the data extend beyond the end of the buffer");
  }
  return { buffer.data.data() + view.byteOffset + offset, stride };
}

void GltfAccessors::replace(const tinygltf::Accessor& accessor, int columns, std::size_t size,
  const char* item_name, GltfNumbers& numbers) const
{
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || sparse.count > numbers.rows() || sparse.indices.byteOffset < 0 ||
    sparse.values.byteOffset < 0)
  {
    throw GltfError(std::string(item_name) + ": the sparse values are out of range");
  }
  if (sparse.count == 0)
  {
    return;
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  const std::size_t id_size = component_size(sparse.indices.componentType);
  const View ids =
    this->view(sparse.indices.bufferView, sparse.indices.byteOffset, count, id_size, item_name);
  const View values = this->view(
    sparse.values.bufferView, sparse.values.byteOffset, count, columns * size, item_name);
  for (std::size_t k = 0; k < count; ++k)
  {
    const double row = component_at(ids.data + k * ids.stride, sparse.indices.componentType);
    if (!(row >= 0.0 && row < static_cast<double>(numbers.rows())) || row != std::floor(row))
    {
      throw GltfError(std::string(item_name) + ": the sparse values are out of range");
    }
    for (int c = 0; c < columns; ++c)
    {
      numbers(static_cast<Index>(row), c) =
        component_at(values.data + k * values.stride + c * size, accessor.componentType);
    }
  }
}

namespace
{
int mode_of(const tinygltf::Primitive& primitive)
{
  return primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
}

/// Return the vertices of the corners of all triangles, in order.
std::vector<Index> read_corners(
  const GltfAccessors& accessors, const tinygltf::Primitive& primitive, Index vertices)
{
  std::vector<Index> corners;
  if (primitive.indices < 0)
  {
    corners.resize(static_cast<std::size_t>(vertices));
    std::iota(corners.begin(), corners.end(), Index(0));
    return corners;
  }
  const GltfNumbers ids = accessors.read_ids(primitive.indices, TINYGLTF_TYPE_SCALAR, "indices");
  for (Index k = 0; k < ids.rows(); ++k)
  {
    if (ids(k, 0) >= static_cast<double>(vertices))
    {
      throw GltfError("a triangle references vertex " +
        std::to_string(static_cast<Index>(ids(k, 0))) + ", but there are " +
        std::to_string(vertices) + " vertices");
    }
    corners.push_back(static_cast<Index>(ids(k, 0)));
  }
  return corners;
}
} // namespace

GltfNumbers read_gltf_attribute(const GltfAccessors& accessors,
  const tinygltf::Primitive& primitive, const char* name, int type, Index vertices, bool ids)
{
  const auto entry = primitive.attributes.find(name);
  if (entry == primitive.attributes.end())
  {
    return {};
  }
  GltfNumbers numbers = ids ? accessors.read_ids(entry->second, type, name)
                            : accessors.read_finite(entry->second, type, name);
  if (vertices >= 0 && numbers.rows() != vertices)
  {
    throw GltfError(std::string(name) + " has " + std::to_string(numbers.rows()) +
      " elements for " + std::to_string(vertices) + " vertices");
  }
  return numbers;
}

int gltf_color_type(const tinygltf::Model& model, const tinygltf::Primitive& primitive)
{
  const auto entry = primitive.attributes.find("COLOR_0");
  const bool has_three = entry != primitive.attributes.end() &&
    gltf_element(model.accessors, entry->second, "accessor").type == TINYGLTF_TYPE_VEC3;
  return has_three ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_VEC4;
}

std::vector<Eigen::Affine3d> read_inverse_binds(
  const GltfAccessors& accessors, const tinygltf::Skin& skin)
{
  std::vector<Eigen::Affine3d> inverse_binds(skin.joints.size(), Eigen::Affine3d::Identity());
  if (skin.inverseBindMatrices < 0)
  {
    return inverse_binds;
  }
  const GltfNumbers rows =
    accessors.read_finite(skin.inverseBindMatrices, TINYGLTF_TYPE_MAT4, "inverse bind matrices");
  if (rows.rows() < static_cast<Index>(skin.joints.size()))
  {
    throw GltfError("the skin has fewer inverse bind matrices than joints");
  }
  for (std::size_t j = 0; j < inverse_binds.size(); ++j)
  {
    inverse_binds[j].matrix() =
      Eigen::Map<const Eigen::Matrix4d>(rows.data() + 16 * static_cast<Index>(j));
    inverse_binds[j].makeAffine();
  }
  return inverse_binds;
}

bool has_triangles(const tinygltf::Primitive& primitive)
{
  const int mode = mode_of(primitive);
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
    mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

std::vector<std::array<Index, 3>> read_gltf_triangles(
  const GltfAccessors& accessors, const tinygltf::Primitive& primitive, Index vertices)
{
  const int mode = mode_of(primitive);
  const std::vector<Index> corners = read_corners(accessors, primitive, vertices);
  const std::size_t count = corners.size();
  if (count < 3 || (mode == TINYGLTF_MODE_TRIANGLES && count % 3 != 0))
  {
    throw GltfError("a mesh has " + std::to_string(count) +
      " triangle corners; expected at least 3, and a multiple of 3 for a triangle list");
  }
  std::vector<std::array<Index, 3>> triangles;
  for (std::size_t k = 0; k + 2 < count; k += mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1)
  {
    const std::size_t flip = mode == TINYGLTF_MODE_TRIANGLE_STRIP ? k % 2 : 0;
    triangles.push_back({ corners[mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : k],
      corners[k + 1 + flip], corners[k + 2 - flip] });
  }
  return triangles;
}

Triangles to_matrix(const std::vector<std::array<Index, 3>>& triangles)
{
  Triangles matrix(static_cast<Index>(triangles.size()), 3);
  for (Index t = 0; t < matrix.rows(); ++t)
  {
    matrix.row(t) << triangles[t][0], triangles[t][1], triangles[t][2];
  }
  return matrix;
}

void set_rotation(const Eigen::Vector4d& q, Trs& trs)
{
  if (!(q.norm() > 1e-12))
  {
    throw GltfError("a rotation has length zero");
  }
  trs.rotation.coeffs() = q.normalized();
}

namespace
{
GltfNodeTransform read_node_transform(const tinygltf::Node& node)
{
  GltfNodeTransform result;
  Eigen::Matrix<double, 16, 1> columns = Eigen::Matrix<double, 16, 1>::Zero();
  Eigen::Vector4d rotation = Eigen::Vector4d::UnitW();
  if (!read_vector<16>(node.matrix, columns) ||
    !read_vector<3>(node.translation, result.trs.translation) ||
    !read_vector<4>(node.rotation, rotation) || !read_vector<3>(node.scale, result.trs.scale))
  {
    throw GltfError("the transform of a node is not valid: expected finite numbers, 16 for the "
                    "matrix, 3 for the translation and scale, and 4 for the rotation");
  }
  set_rotation(rotation, result.trs);
  if (!node.matrix.empty())
  {
    result.has_matrix = true;
    result.matrix.matrix() = Eigen::Map<const Eigen::Matrix4d>(columns.data());
    result.matrix.makeAffine();
  }
  return result;
}

} // namespace

std::vector<Eigen::Affine3d> GltfNodes::scene_transforms() const
{
  std::vector<Eigen::Affine3d> global(this->node_transforms.size());
  for (const int id : this->order)
  {
    const Eigen::Affine3d local_transform = this->node_transforms[id].affine();
    global[id] =
      this->parents[id] < 0 ? local_transform : global[this->parents[id]] * local_transform;
  }
  return global;
}

GltfNodes read_gltf_nodes(const tinygltf::Model& model)
{
  GltfNodes nodes;
  nodes.parents.assign(model.nodes.size(), -1);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
  {
    nodes.node_transforms.push_back(read_node_transform(model.nodes[n]));
    for (const int child : model.nodes[n].children)
    {
      gltf_element(model.nodes, child, "node");
      if (nodes.parents[child] >= 0)
      {
        throw GltfError("node " + std::to_string(child) + " has more than one parent");
      }
      nodes.parents[child] = static_cast<int>(n);
    }
  }
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
  {
    if (nodes.parents[n] < 0)
    {
      nodes.order.push_back(static_cast<int>(n));
    }
  }
  for (std::size_t k = 0; k < nodes.order.size(); ++k)
  {
    const auto& children = model.nodes[nodes.order[k]].children;
    nodes.order.insert(nodes.order.end(), children.begin(), children.end());
  }
  if (nodes.order.size() != model.nodes.size())
  {
    throw GltfError("the hierarchy of the nodes contains a cycle");
  }
  return nodes;
}

} // namespace bindpose
