#ifndef bindpose_cli_arguments_h
#define bindpose_cli_arguments_h

#include <map>
#include <set>
#include <string>
#include <vector>

namespace bindpose::cli
{

/// The parsed command line: the values of the options as text, by option key (see Option::key()).
/// An option that was not typed has its default value, if it has one.
class Arguments
{
public:
  std::string verb;
  /// The original command line without the program's name.
  std::vector<std::string> command_line;
  std::map<std::string, std::vector<std::string>> values;
  /// Keys of the options that were typed.
  std::set<std::string> typed_keys;

  /// Report whether the option has a value: the typed value or the default value.
  bool has(const std::string& key) const { return this->values.count(key) > 0; }
  bool is_typed(const std::string& key) const { return this->typed_keys.count(key) > 0; }
  /// Return the value; empty if the option was not typed and has no default.
  std::string text(const std::string& key) const;
  const std::vector<std::string>& list(const std::string& key) const;
  int integer(const std::string& key) const { return std::stoi(this->text(key)); }
  double number(const std::string& key) const { return std::stod(this->text(key)); }
  /// Return the numbers in the value of an option such as "X,Y,Z".
  std::vector<double> numbers(const std::string& key) const;
  /// Return the integer that `values_of_words` assigns to the value of the option. The parser has
  /// checked that the value is an allowed word.
  int choice(const std::string& key, const std::map<std::string, int>& values_of_words) const
  {
    return values_of_words.at(this->text(key));
  }
};

/// Parse the command line with the option table. A usage error prints one line on the standard
/// error.
/// @return -1 to continue with the arguments, otherwise the exit code: 0 after --help or --version,
///   1 after a usage error
int parse_arguments(int argc, char** argv, Arguments& arguments);

} // namespace bindpose::cli

#endif
