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
  integer,
  number,
  integers, ///< `length` integers with commas between
  numbers ///< `length` numbers with commas between
};

/// Limits of a number.
struct Range
{
  double lowest;
  bool above; ///< the lowest value itself is not allowed
  double highest;
  bool below; ///< the highest value itself is not allowed

  bool contains(double value) const
  {
    return (this->above ? value > this->lowest : value >= this->lowest) &&
      (this->below ? value < this->highest : value <= this->highest);
  }
};

/// One row of the table: an option "--name" or, without dashes, a positional argument.
struct Option
{
  const char* name; ///< "--resolution", "-o,--output" or "SURFACE"
  const char* value; ///< the word for the value in --help; empty for flags and positional arguments
  OptionKind kind;
  const char* fallback; ///< default, as typed; empty if there is none
  const char* choices; ///< "auto|exact"
  const char* help;
  const char* values; ///< unit and range: "degrees, 0 to 20"
  const char* methods; ///< choices of --method that use the option: "cdt|wrap"; empty if all do
  bool required;
  bool repeated; ///< takes one or more values
  const char* unless; ///< flag that makes a required option optional
  Range range;
  int length; ///< count of integers or numbers

  bool positional() const { return this->name[0] != '-'; }
  /// Return the name that Arguments uses: "resolution", "output", "SURFACE".
  std::string key() const
  {
    const std::string names = this->name;
    const std::size_t dashes = names.rfind("--");
    return dashes == std::string::npos ? names : names.substr(dashes + 2);
  }
};

struct Verb
{
  const char* name;
  const char* summary;
  std::vector<Option> options; ///< without the common ones
};

/// Return every verb with its options: the table from which parsing, --help and the documentation
/// are made. It is generated from the descriptions of options, see filters/options/README.md.
const std::vector<Verb>& verbs();
/// Return the options that every verb has.
const std::vector<Option>& common_options();

} // namespace bindpose::cli

#endif
