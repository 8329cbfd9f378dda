#ifndef bindpose_gltf_picture_size_h
#define bindpose_gltf_picture_size_h

#include <cstdint>
#include <string>
#include <string_view>

namespace bindpose
{

/// Width and height of a picture in pixels.
struct PictureSize
{
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// Largest width and height of a picture, in pixels. Textures of common graphics drivers are not
/// larger.
constexpr std::int64_t largest_picture_side = 32768;

/// Return the size that the header of a picture states, without decoding the picture. It is 0 x 0
/// if the header is incomplete, and for TIFF files, whose header can be anywhere.
/// @param format the result of picture_format()
PictureSize picture_size(std::string_view bytes, const std::string& format);

/// Throw GltfError if the header of a picture states more than `largest_picture_side` pixels along
/// a side.
/// @param name the picture's name or URI; identifies TGA files; also used in the message
void check_picture_header(std::string_view bytes, const std::string& name);

} // namespace bindpose

#endif
