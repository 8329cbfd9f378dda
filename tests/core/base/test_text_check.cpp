// Checks of names: valid UTF-8 without control characters.
#include "base/text_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
/// Encode a code point as UTF-8 by the table of RFC 3629.
std::string encoded(std::uint32_t code)
{
  const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
  const auto next = [&](int shift) { return byte(0x80 | (code >> shift & 0x3f)); };
  if (code < 0x80)
  {
    return { byte(code) };
  }
  if (code < 0x800)
  {
    return { byte(0xc0 | code >> 6), next(0) };
  }
  if (code < 0x10000)
  {
    return { byte(0xe0 | code >> 12), next(6), next(0) };
  }
  return { byte(0xf0 | code >> 18), next(12), next(6), next(0) };
}
} // namespace

TEST(TextCheck, AllCodePointsExceptSurrogatesAndControlsAreValid)
{
  for (std::uint32_t code = 0; code < 0x110000; ++code)
  {
    const bool is_control = code < 0x20 || (code >= 0x7f && code < 0xa0);
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    const bool is_no_character = code == 0xfffe || code == 0xffff;
    ASSERT_EQ(find_text_error("a" + encoded(code) + "b").empty(),
      !is_control && !is_surrogate && !is_no_character)
      << std::hex << code;
  }
}

TEST(TextCheck, NamesTheFirstInvalidByteAndItsPosition)
{
  EXPECT_EQ(find_text_error(""), "");
  EXPECT_EQ(find_text_error("left_arm & <\"é\">"), "");
  EXPECT_EQ(find_text_error("ab\xff"), "bytes that are not UTF-8 (0xff at position 2)");
  EXPECT_EQ(find_text_error("é\n"), "the control character U+000A at position 2");
  EXPECT_EQ(find_text_error(std::string("a\0b", 3)), "the control character U+0000 at position 1");
  for (const char* bytes : { "\x80", "\xc3", "\xc3(", "\xe2\x82", "\xf0\x9f\x98", "\xc0\xaf",
         "\xe0\x80\xaf", "\xf0\x80\x80\xaf", "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80" })
  {
    EXPECT_THAT(find_text_error(bytes), HasSubstr("not UTF-8")) << bytes;
  }
}
