#include "gltf/gltf_chunks.h"

#include "gltf/gltf_model.h"

#include <cstdint>
#include <cstring>

namespace bindpose
{

namespace
{
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
} // namespace

GltfChunks split_gltf(std::string_view content)
{
  if (content.substr(0, 4) != "glTF")
  {
    return { content, {}, {} };
  }
  GltfChunks chunks;
  std::size_t at = header_size;
  for (int k = 0; at + chunk_header_size <= content.size(); ++k)
  {
    const std::size_t size = number_at(content, at);
    const std::uint32_t type = number_at(content, at + 4);
    if (size > content.size() - at - chunk_header_size)
    {
      throw GltfError("chunk " + std::to_string(k) + " extends beyond the end of the file");
    }
    const std::string_view chunk = content.substr(at + chunk_header_size, size);
    if (k == 0)
    {
      chunks.text = chunk;
    }
    else if (k == 1 && type == buffer_chunk)
    {
      chunks.buffer = chunk;
    }
    else
    {
      chunks.further = content.substr(at);
      break;
    }
    at += chunk_header_size + size;
  }
  return chunks;
}

std::string join_glb(const GltfChunks& chunks)
{
  std::string content = "glTF";
  append_word(content, 2);
  append_word(content, 0); // the size of the file, see below
  append_chunk(content, json_chunk, chunks.text, ' ');
  if (!chunks.buffer.empty())
  {
    append_chunk(content, buffer_chunk, chunks.buffer, '\0');
  }
  content += chunks.further;
  const auto size = static_cast<std::uint32_t>(content.size());
  std::memcpy(content.data() + 8, &size, sizeof(size));
  return content;
}

} // namespace bindpose
