#include "gltf_edit/gltf_document.h"

#include "gltf/gltf_chunks.h"
#include "gltf/gltf_compression.h"
#include "gltf/gltf_images.h"
#include "gltf/gltf_model.h"
#include "gltf/picture_size.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <string_view>

namespace bindpose
{

namespace
{
using Json = GltfDocument::Json;

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
} // namespace

GltfDocument::GltfDocument(ConvertPicture convert) : convert_(std::move(convert))
{
  this->json_["asset"] = { { "version", "2.0" }, { "generator", "Bindpose" } };
}

GltfDocument::GltfDocument(const std::string& content, const tinygltf::Model& model,
  const std::string& folder, std::vector<std::string>& warnings, ConvertPicture convert)
  : convert_(std::move(convert))
{
  const GltfChunks chunks = split_gltf(content);
  this->json_ = parse_gltf_text(chunks.text);
  this->further_chunks_ = chunks.further;
  remove_compression(this->json_);
  this->join_buffers(model);
  this->embed_images(model, folder, warnings);
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
  // An extension of a view that Bindpose does not know may also refer to a buffer.
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

/// Store images in the buffer that are external, or that need to be converted.
void GltfDocument::embed_images(
  const tinygltf::Model& model, const std::string& folder, std::vector<std::string>& warnings)
{
  std::vector<std::size_t> damaged;
  for (std::size_t k = 0; k < model.images.size(); ++k)
  {
    const tinygltf::Image& old = model.images[k];
    const bool has_data = !old.image.empty(); // parse_gltf() decoded a data URI
    const std::string& name = has_data ? old.name : old.uri;
    std::string bytes(old.image.begin(), old.image.end());
    check_picture_header(embedded_image(model, static_cast<int>(k)), name);
    if (has_data ? !is_convertible(picture_format(bytes, name))
                 : old.uri.empty() || is_data_uri(old.uri))
    {
      continue;
    }
    const Status status = has_data ? Status() : read_picture_bytes(name, folder, bytes);
    check_picture_header(bytes, name);
    const std::string type = this->use_format(bytes, name);
    if (has_data && type.empty())
    {
      warnings.push_back(
        "the image '" + sanitize_line(name) + "' is left out because it is damaged");
      damaged.push_back(k);
      continue;
    }
    if (!status.ok() || type.empty())
    {
      warnings.push_back("the image '" + sanitize_line(name) +
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
  this->remove_images(damaged);
}

/// Remove images, whose ids are sorted, and the references of textures to them.
void GltfDocument::remove_images(const std::vector<std::size_t>& ids)
{
  if (ids.empty())
  {
    return;
  }
  const auto update = [&](Json& owner)
  {
    if (!owner.is_object() || !owner.contains("source") || !owner["source"].is_number_unsigned())
    {
      return;
    }
    const auto source = owner["source"].get<std::size_t>();
    const auto next = std::lower_bound(ids.begin(), ids.end(), source);
    if (next != ids.end() && *next == source)
    {
      owner.erase("source");
    }
    else
    {
      owner["source"] = source - static_cast<std::size_t>(next - ids.begin());
    }
  };
  for (Json& texture : this->list("textures"))
  {
    update(texture);
    if (texture.is_object() && texture.contains("extensions"))
    {
      for (Json& extension : texture["extensions"])
      {
        update(extension);
      }
    }
  }
  Json& images = this->list("images");
  std::for_each(ids.rbegin(), ids.rend(), [&](std::size_t id) { images.erase(id); });
  if (images.empty())
  {
    this->json_.erase("images");
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
      buffer["uri"] = to_data_uri(this->buffer_);
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
    // The three headers have at most 28 bytes.
    const std::size_t size = text.size() + this->buffer_.size() + this->further_chunks_.size() + 28;
    if (size > largest_file)
    {
      return Status::invalid_input("a .glb file can have at most 4 GB, but this file would have " +
        std::to_string(size) + " bytes");
    }
    content = join_glb({ text, this->buffer_, this->further_chunks_ });
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
