// Text files are read word by word (see text_scanner.h). Numbers are parsed by std::from_chars,
// which is fast and expects a decimal point in every locale.
#include "io/text_scanner.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

#include <sys/stat.h>

namespace bindpose
{

namespace
{
constexpr bool is_blank(char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n');
}

/// Return the index of the first blank if `blank` is true, else of the first character that is not
/// a blank. Return text.size() if there is none. This function is several times faster than
/// find_first_of() with a list of blanks.
template <bool blank>
std::size_t find_first(std::string_view text)
{
  std::size_t at = 0;
  while (at < text.size() && is_blank(text[at]) != blank)
  {
    ++at;
  }
  return at;
}

std::string system_reason()
{
  return std::strerror(errno); // strerror() never returns a null pointer
}

struct CloseFile
{
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePointer = std::unique_ptr<std::FILE, CloseFile>;

std::string_view without_plus(std::string_view text)
{
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+')
  {
    text.remove_prefix(1);
  }
  return text;
}

template <typename T>
bool parse(std::string_view text, T& value)
{
  text = without_plus(text);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end && !text.empty();
}

/// Return a word for an error message: shortened, and printable for any file content.
std::string quoted(std::string_view word)
{
  std::string text = "'";
  for (const char c : word.substr(0, 32))
  {
    text += c >= ' ' && c <= '~' ? c : '?';
  }
  return text + (word.size() > 32 ? "…'" : "'");
}
} // namespace

Status read_file(const std::string& path, std::string& content)
{
  content.clear();
  struct stat info = {};
  if (stat(path.c_str(), &info) != 0)
  {
    return Status::invalid_input("cannot open " + path + ": " + system_reason());
  }
  if (S_ISDIR(info.st_mode))
  {
    return Status::invalid_input("cannot read " + path + ": it is a directory");
  }
  const FilePointer file(std::fopen(path.c_str(), "rb"));
  if (!file)
  {
    return Status::invalid_input("cannot open " + path + ": " + system_reason());
  }
  content.reserve(static_cast<std::size_t>(info.st_size) + 1);
  char block[1 << 16];
  for (;;)
  {
    const std::size_t count = std::fread(block, 1, sizeof(block), file.get());
    content.append(block, count);
    if (count < sizeof(block))
    {
      break;
    }
  }
  if (std::ferror(file.get()))
  {
    return Status::invalid_input("cannot read " + path + ": " + system_reason());
  }
  if (content.empty())
  {
    return Status::invalid_input(path + " is empty");
  }
  return {};
}

Status write_file(const std::string& path, std::string_view content)
{
  FilePointer file(std::fopen(path.c_str(), "wb"));
  if (!file)
  {
    return Status::invalid_input("cannot write " + path + ": " + system_reason());
  }
  const bool written = std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
  // Closing writes the buffer, so a full disk may be reported only here.
  if (std::fclose(file.release()) != 0 || !written)
  {
    return Status::invalid_input("cannot write " + path + ": " + system_reason());
  }
  return {};
}

bool parse_number(std::string_view text, double& value)
{
  text = without_plus(text);
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ptr != end || text.empty())
  {
    return false;
  }
  if (result.ec == std::errc::result_out_of_range)
  {
    // The absolute value is too large for a double (1e400) or too small (1e-400). It is too small
    // if the decimal exponent of the first nonzero digit is negative.
    const std::size_t e = std::min(text.find_first_of("eE"), text.size());
    const std::string_view digits = text.substr(0, e);
    const std::size_t point = std::min(digits.find('.'), digits.size());
    const std::size_t first = digits.find_first_of("123456789");
    double exponent = 0.0;
    if (e < text.size())
    {
      const std::string_view written = without_plus(text.substr(e + 1));
      std::from_chars(written.data(), written.data() + written.size(), exponent);
    }
    const bool tiny = static_cast<double>(point) - static_cast<double>(first) + exponent < 0.0;
    const double magnitude = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    value = text[0] == '-' ? -magnitude : magnitude;
    return true;
  }
  return result.ec == std::errc();
}

bool parse_index(std::string_view text, Index& value)
{
  return parse(text, value);
}

void append_number(std::string& text, double value)
{
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof(digits), value);
  text.append(digits, result.ptr);
}

void append_index(std::string& text, Index value)
{
  char digits[24];
  const auto result = std::to_chars(digits, digits + sizeof(digits), value);
  text.append(digits, result.ptr);
}

TextScanner::TextScanner(std::string path, std::string_view text, char comment)
  : path_(std::move(path)), text_(text), comment_(comment)
{
  // Some editors begin text files with a byte order mark.
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.substr(0, byte_order_mark.size()) == byte_order_mark)
  {
    this->next_ = byte_order_mark.size();
  }
  if (text.find('\n') == std::string_view::npos)
  {
    this->line_end_ = '\r'; // some old programs end lines with CR only
  }
}

bool TextScanner::next_line()
{
  while (this->next_ < this->text_.size())
  {
    const std::size_t end =
      std::min(this->text_.find(this->line_end_, this->next_), this->text_.size());
    this->line_ = this->text_.substr(this->next_, end - this->next_);
    this->next_ = std::min(end + 1, this->text_.size());
    this->line_number_ += 1;
    if (this->comment_)
    {
      this->line_ = this->line_.substr(0, this->line_.find(this->comment_));
    }
    if (find_first<false>(this->line_) < this->line_.size())
    {
      return true;
    }
  }
  this->line_ = {};
  return false;
}

bool TextScanner::next_word(std::string_view& word)
{
  this->line_.remove_prefix(find_first<false>(this->line_));
  if (this->line_.empty())
  {
    return false;
  }
  const std::size_t end = find_first<true>(this->line_);
  word = this->line_.substr(0, end);
  this->line_.remove_prefix(end);
  return true;
}

bool TextScanner::next_word_across_lines(std::string_view& word)
{
  while (!this->next_word(word))
  {
    if (!this->next_line())
    {
      return false;
    }
  }
  return true;
}

std::string_view TextScanner::rest_of_line()
{
  std::string_view rest = this->line_;
  this->line_ = {};
  rest.remove_prefix(find_first<false>(rest));
  while (!rest.empty() && is_blank(rest.back()))
  {
    rest.remove_suffix(1);
  }
  return rest;
}

Status TextScanner::read_index(const char* expected, Index limit, Index& value)
{
  std::string_view word;
  if (!this->next_word_across_lines(word))
  {
    return this->error(std::string("unexpected end of file: expected ") + expected);
  }
  if (!parse_index(word, value))
  {
    return this->error(std::string("expected ") + expected + ", got " + quoted(word));
  }
  if (value < 0 || value >= limit)
  {
    return this->error(std::string(expected) + " is out of range: " + quoted(word) + " (limit " +
      std::to_string(limit) + ")");
  }
  return {};
}

Status TextScanner::read_number(const char* expected, double& value)
{
  std::string_view word;
  if (!this->next_word_across_lines(word))
  {
    return this->error(std::string("unexpected end of file: expected ") + expected);
  }
  if (!parse_number(word, value))
  {
    return this->error(std::string("expected ") + expected + ", got " + quoted(word));
  }
  if (!std::isfinite(value))
  {
    return this->error(std::string(expected) + " is not a finite number: " + quoted(word));
  }
  return {};
}

Status TextScanner::error(const std::string& sentence) const
{
  const std::string source = this->path_.empty() ? "" : this->path_ + ", ";
  return Status::invalid_input(
    source + "line " + std::to_string(this->line_number_) + ": " + sentence);
}

} // namespace bindpose
