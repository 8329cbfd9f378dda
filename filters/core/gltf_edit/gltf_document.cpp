#include "gltf_edit/gltf_document.h"

#include "gltf/gltf_images.h"
#include "gltf/gltf_model.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace bindpose
{

namespace
{
using Json = GltfDocument::Json;

constexpr std::size_t header_size = 12; // bytes before the first chunk of a .glb file
constexpr std::size_t chunk_header_size = 8;
constexpr std::uint32_t json_chunk = 0x4e4f534a;
constexpr std::uint32_t buffer_chunk = 0x004e4942;

std::uint32_t number_at(std::string_view bytes, std::size_t at)
{
  std::uint32_t number = 0;
  std::memcpy(&number, bytes.data() + at, sizeof(number));
  return number;
}

void append_word(std::string& bytes, std::size_t number)
{
  const auto value = static_cast<std::uint32_t>(number);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

void append_chunk(std::string& bytes, std::uint32_t type, std::string_view chunk, char padding)
{
  const std::size_t padded = (chunk.size() + 3) / 4 * 4;
  append_word(bytes, padded);
  append_word(bytes, type);
  bytes.append(chunk).append(padded - chunk.size(), padding);
}

/// The chunks of a .glb file. The buffer's chunk is not needed, because tinygltf has read it.
struct Chunks
{
  std::string_view text;
  std::string_view further; ///< whole chunks, with their headers
};

Chunks split(const std::string& content)
{
  const std::string_view bytes(content);
  if (bytes.substr(0, 4) != "glTF")
  {
    return { bytes, {} };
  }
  Chunks chunks;
  std::size_t at = header_size;
  for (int k = 0; at + chunk_header_size <= bytes.size(); ++k)
  {
    const std::size_t size = number_at(bytes, at);
    const std::uint32_t type = number_at(bytes, at + 4);
    if (size > bytes.size() - at - chunk_header_size)
    {
      throw GltfError("chunk " + std::to_string(k) + " extends beyond the end of the file");
    }
    if (k == 0)
    {
      chunks.text = bytes.substr(at + chunk_header_size, size);
    }
    else if (k > 1 || type != buffer_chunk)
    {
      chunks.further = bytes.substr(at);
      break;
    }
    at += chunk_header_size + size;
  }
  return chunks;
}

/// Return the MIME type of a picture; empty for a format that glTF does not allow.
std::string mime_type(const std::string& format)
{
  return format == "png"                   ? "image/png"
    : format == "jpg"                      ? "image/jpeg"
    : format == "webp" || format == "ktx2" ? "image/" + format
    : format == "dds"                      ? "image/vnd-ms.dds"
                                           : "";
}

const char* type_name(int components)
{
  switch (components)
  {
    case 1:
      return "SCALAR";
    case 2:
      return "VEC2";
    case 3:
      return "VEC3";
    case 4:
      return "VEC4";
    default:
      return "MAT4";
  }
}

std::string base64(std::string_view bytes)
{
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3)
  {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const bool exists = k + i < bytes.size();
      group = group << 8 | (exists ? static_cast<unsigned char>(bytes[k + i]) : 0U);
    }
    for (std::size_t i = 0; i < 4; ++i)
    {
      text += k + i > bytes.size() ? '=' : digits[group >> (18 - 6 * i) & 63];
    }
  }
  return text;
}
} // namespace

GltfDocument::GltfDocument(ConvertPicture convert) : convert_(std::move(convert))
{
  this->json_["asset"] = { { "version", "2.0" }, { "generator", "Bindpose" } };
}

GltfDocument::GltfDocument(const std::string& content, const tinygltf::Model& model,
  const std::string& folder, std::vector<std::string>& warnings, ConvertPicture convert)
  : convert_(std::move(convert))
{
  const Chunks chunks = split(content);
  this->json_ = Json::parse(chunks.text, nullptr, false);
  if (!this->json_.is_object())
  {
    throw GltfError("the JSON text is not valid");
  }
  this->further_chunks_ = chunks.further;
  this->join_buffers(model);
  this->embed_images(folder, warnings);
}

/// Append the data of all buffers to one buffer, and change the references of the buffer views. The
/// bytes of the first buffer keep their positions.
void GltfDocument::join_buffers(const tinygltf::Model& model)
{
  std::vector<std::size_t> begins;
  for (const tinygltf::Buffer& buffer : model.buffers)
  {
    constexpr std::size_t alignment = 8;
    this->buffer_.resize((this->buffer_.size() + alignment - 1) / alignment * alignment);
    begins.push_back(this->buffer_.size());
    this->buffer_.append(reinterpret_cast<const char*>(buffer.data.data()), buffer.data.size());
  }
  // Extensions that compress a view, such as EXT_meshopt_compression, also refer to a buffer.
  const auto redirect = [&begins](Json& view)
  {
    if (!view.is_object() || !view.contains("buffer") || !view["buffer"].is_number_unsigned())
    {
      return;
    }
    const auto id = view["buffer"].get<std::size_t>();
    if (id > 0 && id < begins.size())
    {
      view["byteOffset"] = begins[id] + view.value("byteOffset", std::size_t(0));
      view["buffer"] = 0;
    }
  };
  if (begins.size() < 2)
  {
    return;
  }
  for (Json& view : this->list("bufferViews"))
  {
    redirect(view);
    if (view.is_object() && view.contains("extensions") && view["extensions"].is_object())
    {
      for (Json& extension : view["extensions"])
      {
        redirect(extension);
      }
    }
  }
  Json& buffers = this->list("buffers");
  buffers.erase(buffers.begin() + 1, buffers.end());
}

/// Store external images in the buffer.
void GltfDocument::embed_images(const std::string& folder, std::vector<std::string>& warnings)
{
  if (!this->json_.contains("images"))
  {
    return;
  }
  for (std::size_t k = 0; k < this->json_["images"].size(); ++k)
  {
    const Json& old = this->json_["images"][k];
    if (!old.is_object() || !old.contains("uri") || !old["uri"].is_string())
    {
      continue;
    }
    const auto uri = old["uri"].get<std::string>();
    if (is_data_uri(uri))
    {
      continue;
    }
    std::string bytes;
    const Status status = read_picture_bytes(uri, folder, bytes);
    const std::string type = this->use_format(bytes, uri);
    if (!status.ok() || type.empty())
    {
      warnings.push_back("the image '" + sanitize_line(uri) +
        "' is not stored in the file because " +
        (status.ok() ? "it is damaged, or has a format that glTF does not allow" : status.message));
      continue;
    }
    const int view = this->append_view(bytes.data(), bytes.size(), 0);
    Json& image = this->json_["images"][k];
    image.erase("uri");
    image["bufferView"] = view;
    image["mimeType"] = type;
  }
}

Json& GltfDocument::list(const char* name)
{
  Json& found = this->json_[name];
  if (!found.is_array())
  {
    found = Json::array();
  }
  return found;
}

int GltfDocument::append(const char* list, Json element)
{
  Json& elements = this->list(list);
  elements.push_back(std::move(element));
  return static_cast<int>(elements.size()) - 1;
}

int GltfDocument::append_view(const void* bytes, std::size_t size, int target)
{
  this->buffer_.resize((this->buffer_.size() + 3) / 4 * 4);
  Json view{ { "buffer", 0 }, { "byteOffset", this->buffer_.size() }, { "byteLength", size } };
  if (target != 0)
  {
    view["target"] = target;
  }
  this->buffer_.append(static_cast<const char*>(bytes), size);
  if (this->list("buffers").empty())
  {
    this->list("buffers").push_back(Json::object());
  }
  return this->append("bufferViews", std::move(view));
}

int GltfDocument::append_accessor(
  const void* values, std::size_t size, std::size_t count, int components, int type, int target)
{
  const int view = this->append_view(values, size * count, target);
  return this->append("accessors",
    { { "bufferView", view }, { "componentType", type },
      { "count", count / static_cast<std::size_t>(components) },
      { "type", type_name(components) } });
}

/// Convert a picture if necessary.
/// @return its MIME type; empty for a format that glTF does not allow
std::string GltfDocument::use_format(std::string& bytes, const std::string& name) const
{
  std::string format = picture_format(bytes, name);
  if (this->convert_ && is_convertible(format) && this->convert_(format, bytes))
  {
    format = "png";
  }
  return mime_type(format);
}

int GltfDocument::append_image(std::string bytes, const std::string& name)
{
  const std::string type = this->use_format(bytes, name);
  if (type != "image/png" && type != "image/jpeg")
  {
    return -1;
  }
  const int view = this->append_view(bytes.data(), bytes.size(), 0);
  return this->append("images", { { "bufferView", view }, { "mimeType", type } });
}

Status GltfDocument::to_bytes(bool binary, std::string& content) const
{
  Json json = this->json_;
  if (!this->buffer_.empty())
  {
    Json& buffer = json["buffers"][0];
    buffer.erase("uri");
    buffer["byteLength"] = this->buffer_.size();
    if (!binary)
    {
      buffer["uri"] = "data:application/octet-stream;base64," + base64(this->buffer_);
    }
  }
  std::string text;
  try
  {
    text = binary ? json.dump() : json.dump(2);
  }
  catch (const Json::exception&)
  {
    return Status::invalid_input("a name is not valid UTF-8");
  }
  if (binary)
  {
    const std::size_t size = header_size + 2 * chunk_header_size + text.size() +
      this->buffer_.size() + this->further_chunks_.size();
    if (size > largest_file)
    {
      return Status::invalid_input("a .glb file can have at most 4 GB, but this file would have " +
        std::to_string(size) + " bytes");
    }
    content = "glTF";
    append_word(content, 2);
    append_word(content, 0); // the size of the file, see below
    append_chunk(content, json_chunk, text, ' ');
    if (!this->buffer_.empty())
    {
      append_chunk(content, buffer_chunk, this->buffer_, '\0');
    }
    content += this->further_chunks_;
    const auto written = static_cast<std::uint32_t>(content.size());
    std::memcpy(content.data() + 8, &written, sizeof(written));
  }
  else
  {
    content = std::move(text);
  }
  return {};
}

Status GltfDocument::write(const std::string& path, bool binary) const
{
  std::string content;
  Status status = this->to_bytes(binary, content);
  if (status.ok())
  {
    status = write_file(path, content);
    status.report.set("file_bytes", content.size());
  }
  return status;
}

Json to_gltf_json(const Vec3& v)
{
  return { v[0], v[1], v[2] };
}

Json to_gltf_json(const Eigen::Quaterniond& q)
{
  return { q.x(), q.y(), q.z(), q.w() };
}

void set_transform(Json& node, const Trs& trs)
{
  node["translation"] = to_gltf_json(trs.translation);
  node["rotation"] = to_gltf_json(trs.rotation);
  node["scale"] = to_gltf_json(trs.scale);
}

} // namespace bindpose
