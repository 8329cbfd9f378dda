#include "gltf/gltf_images.h"

#include "gltf/gltf_model.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <system_error>

namespace bindpose
{

std::string decode_uri(const std::string& uri)
{
  std::string path;
  for (std::size_t k = 0; k < uri.size(); ++k)
  {
    const bool escaped = uri[k] == '%' && k + 2 < uri.size() &&
      std::isxdigit(static_cast<unsigned char>(uri[k + 1])) != 0 &&
      std::isxdigit(static_cast<unsigned char>(uri[k + 2])) != 0;
    path += escaped ? static_cast<char>(std::stoi(uri.substr(k + 1, 2), nullptr, 16)) : uri[k];
    k += escaped ? 2 : 0;
  }
  return path;
}

std::string picture_format(std::string_view bytes, const std::string& name)
{
  using namespace std::string_view_literals;
  if (bytes.size() < longest_picture_signature)
  {
    return "";
  }
  const auto begins_with = [&](std::string_view signature)
  { return bytes.substr(0, signature.size()) == signature; };
  const auto ends_with = [&](const std::string& extension)
  {
    return name.size() > extension.size() &&
      std::equal(extension.begin(), extension.end(),
        name.end() - static_cast<int>(extension.size()),
        [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
  };
  return begins_with("\x89PNG\r\n\x1a\n"sv)                   ? "png"
    : begins_with("\xff\xd8\xff"sv)                           ? "jpg"
    : begins_with("RIFF"sv) && bytes.substr(8, 4) == "WEBP"sv ? "webp"
    : bytes.substr(1, 6) == "KTX 20"sv                        ? "ktx2"
    : begins_with("DDS "sv)                                   ? "dds"
    : begins_with("BM"sv)                                     ? "bmp"
    : begins_with("II*\0"sv) || begins_with("MM\0*"sv)        ? "tif"
    : ends_with(".tga")                                       ? "tga"
                                                              : "";
}

bool is_data_uri(const std::string& uri)
{
  return uri.compare(0, 5, "data:") == 0;
}

std::string to_data_uri(std::string_view bytes)
{
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = "data:application/octet-stream;base64,";
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
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

bool is_convertible(const std::string& format)
{
  return format == "bmp" || format == "tif" || format == "tga";
}

namespace
{
/// Report whether a path leaves the folder to which it is relative. The answer depends on its text
/// only, not on whether a file outside of the folder exists.
bool leaves_folder(const std::string& name, const std::string& folder)
{
  std::error_code error;
  const auto root = (std::filesystem::absolute(folder, error) / "").lexically_normal();
  const auto file = (root / name).lexically_normal();
  const auto end = std::prev(root.end()); // the last part is empty
  return std::mismatch(root.begin(), end, file.begin(), file.end()).first != end;
}
} // namespace

Status read_picture_bytes(const std::string& uri, const std::string& folder, std::string& bytes)
{
  const std::string name = decode_uri(uri);
  const std::string path = folder + "/" + name;
  std::error_code error;
  if (leaves_folder(name, folder) ||
    (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error) &&
      !is_in_folder(path, folder)))
  {
    throw GltfError("the image '" + sanitize_line(uri) + "' is not in the folder of the file");
  }
  return read_file(path, bytes);
}

std::string_view embedded_image(const tinygltf::Model& model, int image)
{
  const tinygltf::Image& from = gltf_element(model.images, image, "image");
  if (from.bufferView >= 0)
  {
    const tinygltf::BufferView& view =
      gltf_element(model.bufferViews, from.bufferView, "buffer view");
    const std::vector<unsigned char>& data =
      gltf_element(model.buffers, view.buffer, "buffer").data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    {
      throw GltfError("image " + std::to_string(image) + " extends beyond the end of its buffer");
    }
    return { reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength };
  }
  // parse_gltf() decoded a data URI.
  return { reinterpret_cast<const char*>(from.image.data()), from.image.size() };
}

Status read_gltf_image(
  const tinygltf::Model& model, int image, const std::string& folder, std::string& bytes)
{
  bytes = embedded_image(model, image);
  const tinygltf::Image& from = model.images[static_cast<std::size_t>(image)];
  if (from.bufferView >= 0)
  {
    if (picture_format(bytes, "") == "png")
    {
      // Some programs pad views with zeros. A PNG file does not end with a zero.
      bytes.erase(bytes.find_last_not_of('\0') + 1);
    }
    return {};
  }
  return !bytes.empty() || is_data_uri(from.uri) ? Status()
                                                 : read_picture_bytes(from.uri, folder, bytes);
}

} // namespace bindpose
