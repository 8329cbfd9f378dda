#include "gltf/picture_size.h"

#include "gltf/gltf_images.h"
#include "gltf/gltf_model.h"
#include "io/text_scanner.h"

#include <cstdlib>

namespace bindpose
{

namespace
{
/// Return an unsigned integer of `count` bytes, or 0 if it extends beyond the end.
std::int64_t integer_at(std::string_view bytes, std::size_t begin, int count, bool little_endian)
{
  if (begin + static_cast<std::size_t>(count) > bytes.size())
  {
    return 0;
  }
  std::int64_t value = 0;
  for (int k = 0; k < count; ++k)
  {
    const int from = little_endian ? count - 1 - k : k;
    value = value << 8 | static_cast<unsigned char>(bytes[begin + static_cast<std::size_t>(from)]);
  }
  return value;
}

/// Return the size in the first chunk of a PNG file.
PictureSize png_size(std::string_view bytes)
{
  return bytes.substr(12, 4) == "IHDR"
    ? PictureSize{ integer_at(bytes, 16, 4, false), integer_at(bytes, 20, 4, false) }
    : PictureSize{};
}

/// Return the size in the frame header of a JPEG file, which follows other segments.
PictureSize jpeg_size(std::string_view bytes)
{
  std::size_t at = 2; // after the marker of the start
  while (at + 4 <= bytes.size() && static_cast<unsigned char>(bytes[at]) == 0xff)
  {
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xff) // a byte between segments
    {
      ++at;
      continue;
    }
    // Four of these markers are tables and a reserved one.
    if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
    {
      return { integer_at(bytes, at + 7, 2, false), integer_at(bytes, at + 5, 2, false) };
    }
    at += 2 + static_cast<std::size_t>(integer_at(bytes, at + 2, 2, false));
  }
  return {};
}

/// Return the size of the canvas of a WebP file with the extended header. Others have at most
/// 16,384 pixels along a side, so their size is not read.
PictureSize webp_size(std::string_view bytes)
{
  constexpr std::size_t header = 30;
  return bytes.size() >= header && bytes.substr(12, 4) == "VP8X"
    ? PictureSize{ integer_at(bytes, 24, 3, true) + 1, integer_at(bytes, 27, 3, true) + 1 }
    : PictureSize{};
}

/// Return the absolute value of a signed integer of four bytes. The height of a BMP file is
/// negative if its first row is at the top.
std::int64_t magnitude_at(std::string_view bytes, std::size_t begin)
{
  return std::abs(
    static_cast<std::int64_t>(static_cast<std::int32_t>(integer_at(bytes, begin, 4, true))));
}

/// Return the size of a BMP file. The first version of the format has 16-bit integers.
PictureSize bmp_size(std::string_view bytes)
{
  constexpr std::int64_t first_header = 12; // bytes
  return integer_at(bytes, 14, 4, true) == first_header
    ? PictureSize{ integer_at(bytes, 18, 2, true), integer_at(bytes, 20, 2, true) }
    : PictureSize{ magnitude_at(bytes, 18), magnitude_at(bytes, 22) };
}
} // namespace

PictureSize picture_size(std::string_view bytes, const std::string& format)
{
  PictureSize size;
  if (bytes.size() < longest_picture_signature)
  {
    return size;
  }
  if (format == "png")
  {
    size = png_size(bytes);
  }
  else if (format == "jpg")
  {
    size = jpeg_size(bytes);
  }
  else if (format == "webp")
  {
    size = webp_size(bytes);
  }
  else if (format == "ktx2")
  {
    size = { integer_at(bytes, 20, 4, true), integer_at(bytes, 24, 4, true) };
  }
  else if (format == "dds")
  {
    size = { integer_at(bytes, 16, 4, true), integer_at(bytes, 12, 4, true) };
  }
  else if (format == "bmp")
  {
    size = bmp_size(bytes);
  }
  else if (format == "tga")
  {
    size = { integer_at(bytes, 12, 2, true), integer_at(bytes, 14, 2, true) };
  }
  return size.width > 0 && size.height > 0 ? size : PictureSize{};
}

void check_picture_header(std::string_view bytes, const std::string& name)
{
  const PictureSize size = picture_size(bytes, picture_format(bytes, name));
  if (size.width > largest_picture_side || size.height > largest_picture_side)
  {
    throw GltfError("the picture " + (name.empty() ? "" : "'" + sanitize_line(name) + "' ") +
      "has " + std::to_string(size.width) + " x " + std::to_string(size.height) +
      " pixels, and at most " + std::to_string(largest_picture_side) + " along a side are allowed");
  }
}

} // namespace bindpose
