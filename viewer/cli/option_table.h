#ifndef bindpose_cli_option_table_h
#define bindpose_cli_option_table_h

#include <string>
#include <vector>

namespace bindpose::cli
{

enum class OptionKind
{
  flag,
  text,
  choice, ///< one of the words in choices
  integer, ///< at least minimum
  number
};

/// One row of the table: an option "--name" or, without dashes, a positional argument.
struct Option
{
  const char* name; ///< "--grid", "-o,--output" or "SURFACE"
  const char* value; ///< what help calls the value; empty for flags and positional arguments
  OptionKind kind;
  const char* fallback; ///< default, as typed; empty: none
  const char* choices; ///< "auto|exact"
  const char* help;
  bool required = false;
  bool repeated = false; ///< takes one or more values
  int minimum = 0; ///< of an integer
  const char* unless = ""; ///< the flag that makes a required option needless

  bool positional() const { return this->name[0] != '-'; }
  /// The name that Arguments knows it by: "grid", "output", "SURFACE".
  std::string key() const;
};

struct Verb
{
  const char* name;
  const char* summary;
  std::vector<Option> options; ///< without the common ones
};

/// Every verb with its options: the one table that parsing, --help and the documentation read.
const std::vector<Verb>& verbs();
/// What every verb takes.
const std::vector<Option>& common_options();

/// The table as Markdown, as it stands in viewer/command_line.md.
std::string option_table_markdown();

} // namespace bindpose::cli

#endif
