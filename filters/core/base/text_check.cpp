#include "base/text_check.h"

#include <cstdint>

namespace bindpose
{

namespace
{
/// Return the number of bytes of the character that starts at a position, or 0 if it is not UTF-8.
/// `code` is set to the code point.
std::size_t character_length(std::string_view text, std::size_t at, std::uint32_t& code)
{
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t length = first < 0x80 ? 1
    : (first & 0xe0) == 0xc0              ? 2
    : (first & 0xf0) == 0xe0              ? 3
    : (first & 0xf8) == 0xf0              ? 4
                                          : 0;
  if (length == 0 || at + length > text.size())
  {
    return 0;
  }
  code = length == 1 ? first : first & (0x7fU >> length);
  for (std::size_t k = 1; k < length; ++k)
  {
    const auto next = static_cast<unsigned char>(text[at + k]);
    if ((next & 0xc0) != 0x80)
    {
      return 0;
    }
    code = code << 6 | (next & 0x3fU);
  }
  constexpr std::uint32_t smallest[5] = { 0, 0, 0x80, 0x800, 0x10000 };
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  return code < smallest[length] || code > 0x10ffff || is_surrogate ? 0 : length;
}

/// Return a code point below 256 in the form "U+0085".
std::string code_point(std::uint32_t code)
{
  constexpr char digits[] = "0123456789ABCDEF";
  return std::string("U+00") + digits[code >> 4 & 15] + digits[code & 15];
}

std::string byte_at(std::string_view text, std::size_t at)
{
  constexpr char digits[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(text[at]);
  return std::string("0x") + digits[byte >> 4] + digits[byte & 15] + " at position " +
    std::to_string(at);
}
} // namespace

std::string find_text_error(std::string_view text)
{
  for (std::size_t at = 0; at < text.size();)
  {
    std::uint32_t code = 0;
    const std::size_t length = character_length(text, at, code);
    if (length == 0)
    {
      return "bytes that are not UTF-8 (" + byte_at(text, at) + ")";
    }
    if (code == 0xfffe || code == 0xffff)
    {
      return "the code point U+FFF" + std::string(code == 0xfffe ? "E" : "F") +
        ", which is not a character, at position " + std::to_string(at);
    }
    if (code < 0x20 || (code >= 0x7f && code < 0xa0))
    {
      return "the control character " + code_point(code) + " at position " + std::to_string(at);
    }
    at += length;
  }
  return {};
}

} // namespace bindpose
