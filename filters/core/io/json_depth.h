#ifndef bindpose_io_json_depth_h
#define bindpose_io_json_depth_h

#include "base/status.h"

#include <string_view>

namespace bindpose
{

/// Maximum nesting depth of arrays and objects in a JSON text.
constexpr int maximum_json_depth = 100;

/// Check the depth of a JSON text before it is parsed. A deeply nested text could overflow the
/// stack, because parsers and functions that visit values are recursive. Return invalid_input,
/// naming the line, if the text has more than maximum_json_depth levels. Other errors of the text
/// are not detected.
Status check_json_depth(std::string_view text);

} // namespace bindpose

#endif
