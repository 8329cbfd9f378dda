#ifndef bindpose_io_text_scanner_h
#define bindpose_io_text_scanner_h

#include "base/mesh.h"

#include <string>
#include <string_view>

namespace bindpose
{

/// The whole file. invalid_input when it is missing, a directory, unreadable or empty.
Status read_file(const std::string& path, std::string& content);

/// Writes the whole file. invalid_input with the system's reason when it cannot be written.
Status write_file(const std::string& path, std::string_view content);

/// The number that all of the text spells, in any locale; false for anything else. "nan" and
/// "inf" are numbers here: whoever needs finite ones asks.
bool parse_number(std::string_view text, double& value);
bool parse_index(std::string_view text, Index& value);

/// Appends the shortest spelling that reads back as the same double.
void append_number(std::string& text, double value);
void append_index(std::string& text, Index value);

/// Words of a text, line by line. Words are parted by blanks; a comment runs from its sign to the
/// end of the line. The text must outlive the scanner.
class TextScanner
{
public:
  /// comment: the sign that begins a comment, 0 for none. The path is for error texts only.
  TextScanner(std::string path, std::string_view text, char comment = '#');

  /// Goes to the next line that has a word; false at the end of the text.
  bool next_line();
  /// The next word of this line; false at its end.
  bool next_word(std::string_view& word);
  /// The next word of this or a later line; false at the end of the text.
  bool next_word_of_text(std::string_view& word);
  /// What is left of this line, without blanks around it and without its comment.
  std::string_view rest_of_line();

  /// The next word of the text must be an index in [0, limit) resp. a finite number; the status
  /// says what was expected ("a vertex id") and what stood there.
  Status read_index(const char* what, Index limit, Index& value);
  Status read_number(const char* what, double& value);

  /// Bytes that are read so far, to go on behind a text header of a binary file.
  std::size_t position() const { return this->next_; }
  /// Number of the current line, from 1.
  Index line() const { return this->line_number_; }
  /// invalid_input: "PATH, line N: sentence".
  Status error(const std::string& sentence) const;

private:
  std::string path_;
  std::string_view text_;
  char comment_;
  std::string_view line_; // what is left of the current line
  std::size_t next_ = 0; // where the next line begins
  Index line_number_ = 0;
};

} // namespace bindpose

#endif
