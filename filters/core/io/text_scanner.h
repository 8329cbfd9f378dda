#ifndef bindpose_io_text_scanner_h
#define bindpose_io_text_scanner_h

#include "geometry/mesh.h"

#include <string>
#include <string_view>

namespace bindpose
{

/// Maximum count of vertices, elements or values in a file. A larger count means an invalid file;
/// the limit also prevents integer overflow of ids.
constexpr Index largest_count = Index(1) << 40;

/// Read a whole file. Return invalid_input if the file is missing, a directory, unreadable or
/// empty.
Status read_file(const std::string& path, std::string& content);

/// Write a whole file. If that fails, return invalid_input with the system's reason.
Status write_file(const std::string& path, std::string_view content);

/// Parse a text that consists of one number, independent of the locale. Return false for any other
/// text. "nan" and "inf" are accepted, so callers that require finite numbers must check.
bool parse_number(std::string_view text, double& value);
bool parse_index(std::string_view text, Index& value);

/// Append the shortest text from which parse_number() returns the same double.
void append_number(std::string& text, double value);
void append_index(std::string& text, Index value);

/// Splits a text into words, line by line. Blanks separate words. A comment extends from the
/// comment character to the end of the line. A byte order mark of UTF-8 at the beginning is
/// skipped. Lines end with LF or CR LF; if the text has no LF, lines end with CR. The text must
/// outlive the scanner.
class TextScanner
{
public:
  /// Scan `text`. `comment` is the character that begins a comment, or 0 if there are no comments.
  /// `path` is used in error messages only; it is empty if the text is not from a file.
  TextScanner(std::string path, std::string_view text, char comment = '#');

  /// Advance to the next line with a word. Return false at the end of the text.
  bool next_line();
  /// Get the next word of the current line. Return false at the end of the line.
  bool next_word(std::string_view& word);
  /// Get the next word of the current line or of a later line. Return false at the end of the text.
  bool next_word_across_lines(std::string_view& word);
  /// Return the unread rest of the current line, without surrounding blanks and without its
  /// comment.
  std::string_view rest_of_line();

  /// Read the next word of the text. The word must be an index in [0, limit) for read_index(), or a
  /// finite number for read_number(). Otherwise return invalid_input with a message that contains
  /// `expected`, the expected item ("a vertex id"), and the word that was found.
  Status read_index(const char* expected, Index limit, Index& value);
  Status read_number(const char* expected, double& value);

  /// Return the number of bytes up to the next line, for reading binary data after a text header.
  std::size_t position() const { return this->next_; }
  /// Return the number of the current line, from 1.
  Index line() const { return this->line_number_; }
  /// Return invalid_input with the message "PATH, line N: SENTENCE", or "line N: SENTENCE" if there
  /// is no path.
  Status error(const std::string& sentence) const;

private:
  std::string path_;
  std::string_view text_;
  char comment_;
  char line_end_ = '\n';
  std::string_view line_; // unread part of the current line
  std::size_t next_ = 0; // start of the next line
  Index line_number_ = 0;
};

} // namespace bindpose

#endif
