#include "decompressed_gltf.h"

#include "draco_mesh.h"
#include "meshopt_view.h"

#include "gltf/gltf_chunks.h"
#include "gltf/gltf_compression.h"
#include "gltf/gltf_images.h"
#include "gltf/gltf_model.h"
#include "gltf_edit/gltf_document.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <vector>

namespace bindpose
{

namespace
{
using Json = nlohmann::ordered_json;

// ---- Values of the JSON text -------------------------------------------------------------------

/// Return a number of an object. Throw GltfError if it is missing or is not an unsigned integer.
std::size_t number(const Json& object, const char* name)
{
  if (!object.is_object() || !object.contains(name) || !object[name].is_number_unsigned())
  {
    throw GltfError(
      std::string("the value '") + name + "' is missing or is not an unsigned integer");
  }
  return object[name].get<std::size_t>();
}

std::size_t number(const Json& object, const char* name, std::size_t fallback)
{
  return object.is_object() && object.contains(name) ? number(object, name) : fallback;
}

/// Return a text of an object; the fallback if it is missing.
std::string word(const Json& object, const char* name, const char* fallback)
{
  return object.contains(name) ? object[name].get<std::string>() : fallback;
}

/// Return an element of a list of the document.
Json& element(Json& document, const char* list, std::size_t id)
{
  if (!document.contains(list) || !document[list].is_array() || id >= document[list].size() ||
    !document[list][id].is_object())
  {
    throw GltfError("element " + std::to_string(id) + " of '" + list + "' does not exist");
  }
  return document[list][id];
}

// ---- Values of accessors -----------------------------------------------------------------------

int component_count(const Json& accessor)
{
  const std::string type = word(accessor, "type", "");
  const int columns = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : 4;
  if (columns == 4 && type != "VEC4")
  {
    throw GltfError("an accessor of a compressed mesh has the type '" + sanitize_line(type) +
      "'; expected SCALAR, VEC2, VEC3 or VEC4");
  }
  return columns;
}

int component_size(int type)
{
  if (type < TINYGLTF_COMPONENT_TYPE_BYTE || type > TINYGLTF_COMPONENT_TYPE_FLOAT ||
    type == TINYGLTF_COMPONENT_TYPE_INT)
  {
    throw GltfError("an accessor of a compressed mesh has an unknown component type");
  }
  return tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
}

template <typename Number>
void set_range(Json& accessor, const std::string& bytes, std::size_t columns)
{
  std::vector<Number> values(bytes.size() / sizeof(Number));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  std::vector<Number> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(columns));
  std::vector<Number> high = low;
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    low[k % columns] = std::min(low[k % columns], values[k]);
    high[k % columns] = std::max(high[k % columns], values[k]);
  }
  accessor["min"] = low;
  accessor["max"] = high;
}

/// Compute the minimum and maximum of an accessor again if it has them.
void update_range(Json& accessor, int type, const std::string& bytes, std::size_t columns)
{
  if (!accessor.contains("min") && !accessor.contains("max"))
  {
    return;
  }
  switch (type)
  {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return set_range<std::int8_t>(accessor, bytes, columns);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return set_range<std::uint8_t>(accessor, bytes, columns);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return set_range<std::int16_t>(accessor, bytes, columns);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return set_range<std::uint16_t>(accessor, bytes, columns);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return set_range<std::uint32_t>(accessor, bytes, columns);
    default:
      return set_range<float>(accessor, bytes, columns);
  }
}

/// Call change(element) for each element of a list of the document. A GltfError gets the name and
/// the index of the element.
void for_each(Json& document, const char* list, const char* name,
  const std::function<void(Json& element)>& change)
{
  if (!document.contains(list))
  {
    return;
  }
  std::size_t k = 0;
  for (Json& element : document[list])
  {
    try
    {
      change(element);
    }
    catch (const GltfError& error)
    {
      throw GltfError(std::string(name) + " " + std::to_string(k) + ": " + error.sentence);
    }
    ++k;
  }
}

/// Return rows of a size that is a multiple of four bytes, which glTF requires of attributes.
std::string pad_rows(const std::string& bytes, std::size_t row, std::size_t padded_row)
{
  if (row == padded_row)
  {
    return bytes;
  }
  std::string padded;
  padded.reserve(bytes.size() / row * padded_row);
  for (std::size_t at = 0; at < bytes.size(); at += row)
  {
    padded.append(bytes, at, row).append(padded_row - row, '\0');
  }
  return padded;
}

// ---- The file ----------------------------------------------------------------------------------

class Decompression
{
public:
  explicit Decompression(const std::string& path)
    : folder_(std::filesystem::path(path).parent_path().string())
  {
    const Status status = read_file(path, this->content_);
    if (!status.ok())
    {
      throw GltfError(status.message);
    }
    this->chunks_ = split_gltf(this->content_);
    this->document_ = parse_gltf_text(this->chunks_.text);
  }

  std::string run()
  {
    for_each(this->document_, "buffers", "buffer",
      [this](Json& buffer) { this->buffers_.push_back(this->read_buffer(buffer)); });
    for_each(this->document_, "bufferViews", "buffer view",
      [this](Json& view) { this->views_.push_back({ this->read_view(view) }); });
    for_each(this->document_, "meshes", "mesh",
      [this](Json& mesh)
      {
        for_each(mesh, "primitives", "primitive",
          [this](Json& primitive) { this->decompress(primitive); });
      });
    remove_compression(this->document_);
    return this->join();
  }

private:
  /// A buffer view of the result.
  struct View
  {
    std::string bytes;
    bool is_taken = false; ///< whether it replaces the view of a compressed mesh
  };

  /// Return the bytes of a buffer. They are empty for a buffer whose values are in compressed
  /// views.
  std::string read_buffer(const Json& buffer) const
  {
    std::string bytes;
    const std::string path = gltf_buffer_path(buffer, this->folder_);
    if (is_fallback_buffer(buffer))
    {
      return bytes;
    }
    if (!path.empty())
    {
      const Status status = is_in_folder(path, this->folder_)
        ? read_file(path, bytes)
        : Status::invalid_input("the file '" + sanitize_line(word(buffer, "uri", "")) +
            "' does not exist in the folder of the file");
      if (!status.ok())
      {
        throw GltfError(status.message);
      }
    }
    else if (buffer.is_object() && buffer.contains("uri"))
    {
      std::vector<unsigned char> data;
      std::string type;
      if (!tinygltf::DecodeDataURI(&data, type, word(buffer, "uri", ""), 0, false))
      {
        throw GltfError("the data URI is not valid");
      }
      bytes.assign(data.begin(), data.end());
    }
    else if (this->buffers_.empty())
    {
      bytes = this->chunks_.buffer;
    }
    return bytes;
  }

  /// Return bytes of a buffer of the file.
  /// @param range the object with buffer, byteOffset and byteLength
  std::string_view bytes_of(const Json& range) const
  {
    const std::size_t id = number(range, "buffer"), offset = number(range, "byteOffset", 0),
                      size = number(range, "byteLength");
    if (id >= this->buffers_.size() || offset > this->buffers_[id].size() ||
      size > this->buffers_[id].size() - offset)
    {
      throw GltfError("the bytes extend beyond the end of the buffer");
    }
    return std::string_view(this->buffers_[id]).substr(offset, size);
  }

  /// Return the bytes of a buffer view, which may be compressed.
  std::string read_view(const Json& view) const
  {
    const Json* compression = gltf_extension(view, meshopt_extension);
    if (!compression)
    {
      return std::string(this->bytes_of(view));
    }
    const MeshoptView properties{ number(*compression, "count"), number(*compression, "byteStride"),
      word(*compression, "mode", ""), word(*compression, "filter", "NONE") };
    std::string bytes = decode_meshopt_view(this->bytes_of(*compression), properties);
    if (bytes.size() != number(view, "byteLength") ||
      number(view, "byteStride", properties.stride) != properties.stride)
    {
      throw GltfError("byteLength and byteStride differ from those of the compressed data");
    }
    return bytes;
  }

  /// Decompress the mesh of a primitive.
  void decompress(Json& primitive)
  {
    const Json* found = gltf_extension(primitive, draco_extension);
    if (!found)
    {
      return;
    }
    const Json compression = *found;
    const std::size_t view = number(compression, "bufferView");
    const Json ids = compression.value("attributes", Json::object());
    element(this->document_, "accessors", 0); // check that the list exists
    std::vector<DracoAttribute> requests;
    for (const auto& entry : ids.items())
    {
      const Json& accessor = this->accessor(primitive["attributes"], entry.key().c_str());
      requests.push_back({ static_cast<std::uint32_t>(number(ids, entry.key().c_str())),
        static_cast<int>(number(accessor, "componentType")), component_count(accessor) });
      component_size(requests.back().component_type); // check it
    }
    const std::string_view data = this->bytes_of(element(this->document_, "bufferViews", view));
    const DracoMesh mesh = decode_draco_mesh(data, requests);
    if (mesh.vertex_count == 0 || mesh.corners.empty())
    {
      throw GltfError("the compressed mesh has no triangles");
    }
    std::size_t k = 0;
    for (const auto& entry : ids.items())
    {
      this->set_attribute(primitive["attributes"][entry.key()], requests[k], mesh.values[k], view);
      ++k;
    }
    this->set_corners(primitive, mesh.corners, view);
    primitive.erase("mode"); // a strip is decompressed to single triangles
  }

  /// Return the accessor of a property, such as an attribute of a primitive.
  Json& accessor(const Json& owner, const char* name)
  {
    return element(this->document_, "accessors", number(owner, name));
  }

  /// Set the values of an accessor. An accessor that has values may also belong to a mesh that is
  /// not compressed, so it is replaced by a copy.
  /// @param id the accessor; changed if it is replaced
  /// @param compressed_view the view of the compressed mesh
  Json& set_values(Json& id, std::size_t count, std::string bytes, std::size_t compressed_view)
  {
    Json& accessors = this->document_["accessors"];
    if (accessors[id.get<std::size_t>()].contains("bufferView"))
    {
      Json copy = accessors[id.get<std::size_t>()];
      id = accessors.size();
      accessors.push_back(std::move(copy));
    }
    Json& accessor = accessors[id.get<std::size_t>()];
    accessor["bufferView"] = this->place(std::move(bytes), compressed_view);
    accessor.erase("byteOffset");
    accessor.erase("sparse");
    accessor["count"] = count;
    return accessor;
  }

  void set_attribute(
    Json& id, const DracoAttribute& type, const std::string& bytes, std::size_t compressed_view)
  {
    const auto columns = static_cast<std::size_t>(type.columns);
    const std::size_t row = columns * static_cast<std::size_t>(component_size(type.component_type));
    const std::size_t padded_row = (row + 3) / 4 * 4;
    Json& accessor =
      this->set_values(id, bytes.size() / row, pad_rows(bytes, row, padded_row), compressed_view);
    update_range(accessor, type.component_type, bytes, columns);
    Json& view = this->document_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    view["target"] = TINYGLTF_TARGET_ARRAY_BUFFER;
    if (padded_row != row)
    {
      view["byteStride"] = padded_row;
    }
  }

  void set_corners(
    Json& primitive, const std::vector<std::uint32_t>& corners, std::size_t compressed_view)
  {
    if (!primitive.contains("indices"))
    {
      primitive["indices"] = this->document_["accessors"].size();
      this->document_["accessors"].push_back({ { "type", "SCALAR" } });
    }
    this->accessor(primitive, "indices"); // check that it exists
    const std::string bytes(
      reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(std::uint32_t));
    Json& accessor = this->set_values(primitive["indices"], corners.size(), bytes, compressed_view);
    accessor["componentType"] = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.erase("min");
    accessor.erase("max");
    this->document_["bufferViews"][accessor["bufferView"].get<std::size_t>()]["target"] =
      TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
  }

  /// Store bytes in the view of a compressed mesh if it still has the compressed data, otherwise in
  /// a new view.
  /// @return the id of the view
  std::size_t place(std::string bytes, std::size_t view)
  {
    if (this->views_[view].is_taken)
    {
      view = this->views_.size();
      this->views_.emplace_back();
      this->document_["bufferViews"].push_back(Json::object());
    }
    this->document_["bufferViews"][view].erase("byteStride");
    this->views_[view] = { std::move(bytes), true };
    return view;
  }

  /// Write the views to one buffer.
  std::string join()
  {
    std::string buffer;
    for (std::size_t k = 0; k < this->views_.size(); ++k)
    {
      constexpr std::size_t alignment = 8;
      buffer.resize((buffer.size() + alignment - 1) / alignment * alignment);
      Json& view = this->document_["bufferViews"][k];
      view["buffer"] = 0;
      view["byteOffset"] = buffer.size();
      view["byteLength"] = this->views_[k].bytes.size();
      buffer += this->views_[k].bytes;
      this->views_[k].bytes = std::string();
    }
    this->document_.erase("buffers");
    if (!buffer.empty())
    {
      this->document_["buffers"] = { { { "byteLength", buffer.size() } } };
    }
    const std::string text = this->document_.dump();
    if (text.size() + buffer.size() + this->chunks_.further.size() > GltfDocument::largest_file)
    {
      throw GltfError("the decompressed file has more than 4 GB, which is not supported");
    }
    return join_glb({ text, buffer, this->chunks_.further });
  }

  std::string folder_;
  std::string content_;
  GltfChunks chunks_; ///< parts of content_
  Json document_;
  std::vector<std::string> buffers_; ///< of the file
  std::vector<View> views_;
};
} // namespace

std::string decompress_gltf(const std::string& path)
{
  try
  {
    return Decompression(path).run();
  }
  catch (const Json::exception&)
  {
    throw GltfError("the JSON text has a value of a wrong type");
  }
}

} // namespace bindpose
