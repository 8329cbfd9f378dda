#ifndef bindpose_gltf_gltf_images_h
#define bindpose_gltf_gltf_images_h

// The pictures of a glTF file, as the bytes of PNG, JPEG or other files.

#include "base/status.h"
#include "gltf/tiny_gltf.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace bindpose
{

/// Number of bytes that picture_format() needs.
constexpr std::size_t longest_picture_signature = 12;

/// Return the format of a picture, as a file name extension: png, jpg, webp, ktx2, dds, bmp, tif or
/// tga; empty: unknown. TGA files have no signature, so they are recognized by their names.
std::string picture_format(std::string_view bytes, const std::string& name);

/// Report whether Bindpose can convert a format, which glTF does not allow, to PNG.
bool is_convertible(const std::string& format);
/// Converts a picture to PNG; see is_convertible(). Returns false if it cannot be read.
using ConvertPicture = std::function<bool(const std::string& format, std::string& bytes)>;

/// Return the relative path that a URI names: each %XX is replaced by the byte with this
/// hexadecimal number.
std::string decode_uri(const std::string& uri);

/// Report whether a URI contains its data.
bool is_data_uri(const std::string& uri);
/// Return a URI that contains bytes as base64.
std::string to_data_uri(std::string_view bytes);

/// Read the picture file that a URI names, relative to a folder. Throw GltfError for a file outside
/// of the folder. Return invalid_input if the file cannot be read.
Status read_picture_bytes(const std::string& uri, const std::string& folder, std::string& bytes);

/// Return the bytes of an image that is in a buffer or in the JSON text. They are empty if it is in
/// a file, and for a data URI of an unknown type. Throw GltfError if the image does not exist, and
/// for a range outside of a buffer.
std::string_view embedded_image(const tinygltf::Model& model, int image);

/// Read the bytes of an image, which is in a buffer, in the JSON text or in a file. Throw GltfError
/// if the image does not exist, for a range outside of a buffer, and for a file outside of the
/// folder. Return invalid_input if its file cannot be read. The bytes are empty for a data URI of
/// an unknown type.
/// @param folder the folder of the glTF file
Status read_gltf_image(
  const tinygltf::Model& model, int image, const std::string& folder, std::string& bytes);

} // namespace bindpose

#endif
