#include "fuzz/mutation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <vector>

namespace bindpose::test
{

namespace
{
std::size_t random_index(Random& random, std::size_t size)
{
  return static_cast<std::size_t>(random.below(static_cast<Index>(size)));
}

std::string bytes(Random& random, Index most)
{
  std::string result(static_cast<std::size_t>(1 + random.below(most)), ' ');
  const Index kind = random.below(3);
  for (char& c : result)
  {
    const char* blanks = "\n\r\t \0#\"{}[]/-";
    c = kind == 0 ? static_cast<char>(random.below(256))
      : kind == 1 ? static_cast<char>(32 + random.below(95))
                  : blanks[random.below(14)];
  }
  return result;
}

/// Return the positions of the line starts, and the end of the text.
std::vector<std::size_t> line_begins(const std::string& text)
{
  std::vector<std::size_t> begins{ 0 };
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (text[i] == '\n' && i + 1 < text.size())
    {
      begins.push_back(i + 1);
    }
  }
  begins.push_back(text.size());
  return begins;
}

/// Replace one number of the text by a random text: an invalid, too large, negative or ordinary
/// number.
void replace_number(Random& random, std::string& text)
{
  static const char* const others[] = { "nan", "inf", "-inf", "-1", "0", "1", "2", "-0", "1e400",
    "-1e400", "1e-400", "1e308", "-1.7e308", "5e-324", "127", "256", "65536", "2147483647",
    "2147483648", "-2147483648", "4294967295", "4294967296", "1099511627775", "1099511627776",
    "4611686018427387904", "9223372036854775807", "-9223372036854775808", "18446744073709551616",
    "99999999999999999999999999", "0x10", "1.5", "1e3", "+", "-", "1,5", "" };
  const std::size_t from = text.find_first_of("0123456789", random_index(random, text.size()));
  if (from == std::string::npos)
  {
    return;
  }
  const std::size_t begin = text.find_last_not_of("0123456789+-.eE", from) + 1;
  const std::size_t end = std::min(text.find_first_not_of("0123456789+-.eE", from), text.size());
  text.replace(begin, end - begin, others[random.below(std::size(others))]);
}

/// Replace one raw number of a binary file by an invalid, too large, negative or ordinary number.
void replace_binary(Random& random, std::string& text)
{
  const double reals[] = { std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300, -1.0, 0.0, 1e-310 };
  const float floats[] = { std::nanf(""), HUGE_VALF, -HUGE_VALF, 3e38f, -1.0f, 1e9f, 1e-40f };
  const std::int32_t integers[] = { -1, 0, 1, 2147483647, -2147483647 - 1, 8, 1 << 24 };
  const Index kind = random.below(3), which = random.below(7);
  char raw[8] = {};
  const std::size_t size = kind == 0 ? 8 : 4;
  std::memcpy(raw,
    kind == 0     ? static_cast<const void*>(&reals[which])
      : kind == 1 ? static_cast<const void*>(&floats[which])
                  : static_cast<const void*>(&integers[which]),
    size);
  if (text.size() >= size)
  {
    text.replace(random_index(random, text.size() - size + 1), size, raw, size);
  }
}

void damage_lines(Random& random, std::string& text)
{
  const std::vector<std::size_t> begins = line_begins(text);
  const std::size_t lines = begins.size() - 1;
  const auto line = [&](std::size_t i)
  { return text.substr(begins[i], begins[i + 1] - begins[i]); };
  const std::size_t a = random_index(random, lines), b = random_index(random, lines);
  const std::string at_a = line(a), at_b = line(b);
  switch (random.below(3))
  {
    case 0:
      text.erase(begins[a], at_a.size());
      break;
    case 1:
      text.insert(begins[b], at_a);
      break;
    default:
      text.replace(begins[std::max(a, b)], line(std::max(a, b)).size(), line(std::min(a, b)));
      text.replace(begins[std::min(a, b)], line(std::min(a, b)).size(), a < b ? at_b : at_a);
  }
}
} // namespace

std::string damaged_file(Random& random, std::string text)
{
  const Index count = 1 + random.below(4);
  for (Index k = 0; k < count && !text.empty(); ++k)
  {
    const std::size_t at = random_index(random, text.size());
    switch (random.below(9))
    {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << random.below(8)));
        break;
      case 1:
        text[at] = static_cast<char>(random.below(256));
        break;
      case 2:
        text.resize(at);
        break;
      case 3:
        text.insert(at, bytes(random, 12));
        break;
      case 4:
        text.erase(at, static_cast<std::size_t>(1 + random.below(20)));
        break;
      case 5:
        replace_binary(random, text);
        break;
      case 6:
        damage_lines(random, text);
        break;
      default:
        replace_number(random, text);
    }
  }
  return text;
}

} // namespace bindpose::test
