// Sizes of pictures from their headers, which are made here from the definitions of the formats.
#include "gltf/gltf_images.h"
#include "gltf/gltf_model.h"
#include "gltf/picture_size.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// Return an integer of `count` bytes, the lowest first.
std::string lowest_first(std::uint64_t value, int count)
{
  std::string bytes;
  for (int k = 0; k < count; ++k)
  {
    bytes += static_cast<char>(value >> (8 * k) & 255);
  }
  return bytes;
}

std::string highest_first(std::uint64_t value, int count)
{
  const std::string bytes = lowest_first(value, count);
  return { bytes.rbegin(), bytes.rend() };
}

std::string segment(unsigned char marker, const std::string& content)
{
  return std::string("\xff") + static_cast<char>(marker) + highest_first(content.size() + 2, 2) +
    content;
}

struct Picture
{
  const char* format;
  std::string bytes; ///< as far as the end of the size
};

/// Return pictures of 40,001 x 3 pixels in all formats whose size is read.
std::vector<Picture> pictures()
{
  constexpr std::uint64_t width = 40001, height = 3;
  const std::string exif(60000, '\xc0'); // contains bytes like those of markers
  return {
    { "png",
      "\x89PNG\r\n\x1a\n" + highest_first(13, 4) + "IHDR" + highest_first(width, 4) +
        highest_first(height, 4) },
    { "jpg",
      "\xff\xd8" + segment(0xe1, exif) + "\xff" + segment(0xc4, "tables") +
        segment(0xc2, "\x08" + highest_first(height, 2) + highest_first(width, 2)) },
    { "webp",
      "RIFF" + lowest_first(100, 4) + "WEBPVP8X" + lowest_first(10, 4) + lowest_first(0, 4) +
        lowest_first(width - 1, 3) + lowest_first(height - 1, 3) },
    { "ktx2",
      "\xabKTX 20\xbb\r\n\x1a\n" + lowest_first(0, 8) + lowest_first(width, 4) +
        lowest_first(height, 4) },
    { "dds",
      "DDS " + lowest_first(124, 4) + lowest_first(0, 4) + lowest_first(height, 4) +
        lowest_first(width, 4) },
    { "bmp",
      "BM" + lowest_first(0, 12) + lowest_first(40, 4) + lowest_first(width, 4) +
        lowest_first(static_cast<std::uint64_t>(-3), 4) }, // the first row is at the top
    { "tga",
      lowest_first(0x20000, 4) + lowest_first(0, 8) + lowest_first(width, 2) +
        lowest_first(height, 2) },
  };
}
} // namespace

TEST(PictureSize, IsReadFromTheHeader)
{
  for (const Picture& picture : pictures())
  {
    ASSERT_EQ(picture_format(picture.bytes, "picture.tga"), picture.format);
    const PictureSize size = picture_size(picture.bytes, picture.format);
    EXPECT_EQ(size.width, 40001) << picture.format;
    EXPECT_EQ(size.height, 3) << picture.format;
  }
}

TEST(PictureSize, OfTheFirstVersionOfBmp)
{
  const std::string bytes = "BM" + lowest_first(0, 12) + lowest_first(12, 4) + lowest_first(64, 2) +
    lowest_first(65535, 2) + lowest_first(0x180001, 4);
  const PictureSize size = picture_size(bytes, "bmp");
  EXPECT_EQ(size.width, 64);
  EXPECT_EQ(size.height, 65535);
}

TEST(PictureSize, IsUnknownIfTheHeaderIsIncomplete)
{
  for (const Picture& picture : pictures())
  {
    for (std::size_t length = 0; length < picture.bytes.size(); ++length)
    {
      const PictureSize size = picture_size(picture.bytes.substr(0, length), picture.format);
      ASSERT_EQ(size.width, 0) << picture.format << " of " << length << " bytes";
      ASSERT_EQ(size.height, 0) << picture.format << " of " << length << " bytes";
    }
  }
}

TEST(PictureSize, HasALimit)
{
  for (const Picture& picture : pictures())
  {
    try
    {
      check_picture_header(picture.bytes, "skin.tga");
      ADD_FAILURE() << picture.format;
    }
    catch (const GltfError& error)
    {
      EXPECT_EQ(error.sentence,
        "the picture 'skin.tga' has 40001 x 3 pixels, and at most 32768 along a side are allowed");
    }
  }
  const auto png = [](std::uint64_t width)
  {
    return "\x89PNG\r\n\x1a\n" + highest_first(13, 4) + "IHDR" + highest_first(width, 4) +
      highest_first(1, 4);
  };
  EXPECT_NO_THROW(check_picture_header(png(32768), ""));
  EXPECT_THROW(check_picture_header(png(32769), ""), GltfError);
  EXPECT_NO_THROW(check_picture_header("no picture at all", ""));
}
