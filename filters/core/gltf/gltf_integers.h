#ifndef bindpose_gltf_gltf_integers_h
#define bindpose_gltf_gltf_integers_h

#include "base/status.h"

#include <string_view>

namespace bindpose
{

/// Check the offsets, lengths and counts in the JSON text of a glTF file. tinygltf truncates larger
/// integers to 32 bits, and ignores negative ones. Return invalid_input, naming the property, for a
/// number of `byteOffset`, `byteLength`, `byteStride` or `count` that is not an integer from 0 to
/// 2^32 - 1. Extras and extensions may contain any number. Other errors of the text are not
/// detected.
Status check_gltf_integers(std::string_view text);

} // namespace bindpose

#endif
