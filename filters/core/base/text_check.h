#ifndef bindpose_base_text_check_h
#define bindpose_base_text_check_h

#include <string>
#include <string_view>

namespace bindpose
{

/// Check that a text is valid UTF-8 and has no control characters (U+0000 to U+001F, U+007F, U+0080
/// to U+009F). Return an empty string, or a phrase that names the first invalid byte, such as "the
/// control character U+000A at position 3" or "bytes that are not UTF-8 (0xff at position 0)".
/// Surrogates, overlong encodings, code points above U+10FFFF, and U+FFFE and U+FFFF, which XML
/// cannot store, are not valid.
std::string find_text_error(std::string_view text);

} // namespace bindpose

#endif
