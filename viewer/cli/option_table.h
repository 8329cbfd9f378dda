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
  choice, ///< one of the words in `choices`
  integer,
  number,
  integers, ///< `length` integers, separated by commas
  numbers ///< `length` numbers, separated by commas
};

/// The range of a number.
struct Range
{
  double lowest;
  bool excludes_lowest; ///< true: `lowest` itself is not allowed
  double highest;
  bool excludes_highest; ///< true: `highest` itself is not allowed

  bool contains(double value) const
  {
    return (this->excludes_lowest ? value > this->lowest : value >= this->lowest) &&
      (this->excludes_highest ? value < this->highest : value <= this->highest);
  }
};

/// One row of the table: an option "--name" or, without dashes, a positional argument.
struct Option
{
  const char* name; ///< "--resolution", "-o,--output" or "SURFACE"
  /// Placeholder of the value in --help. Empty for flags and positional arguments.
  const char* value;
  OptionKind kind;
  const char* default_value; ///< default value, as typed; empty if there is none
  const char* choices; ///< allowed words, such as "auto|exact"
  const char* help;
  const char* values; ///< unit and range, such as "degrees, 0 to 20"
  /// Values of --method that use the option, such as "cdt|wrap". Empty if all methods use it.
  const char* methods;
  bool required;
  bool repeated; ///< true: the option takes one or more values
  const char* optional_if; ///< key of the flag that makes this required option optional
  Range range;
  int length; ///< number of values in a list of integers or numbers

  bool positional() const { return this->name[0] != '-'; }
  /// Return the key of the option in Arguments: "resolution", "output", "SURFACE".
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
  std::vector<Option> options; ///< options of this verb, without the common options
};

/// Return every verb with its options. Parsing, --help and the documentation use this table. The
/// table is generated from the descriptions of options; see filters/options/README.md.
const std::vector<Verb>& verbs();
/// Return the options that every verb has.
const std::vector<Option>& common_options();

} // namespace bindpose::cli

#endif
