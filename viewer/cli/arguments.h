#ifndef bindpose_cli_arguments_h
#define bindpose_cli_arguments_h

#include <map>
#include <string>
#include <vector>

namespace bindpose::cli
{

/// What was typed, by the keys of the option table, defaults filled in.
class Arguments
{
public:
  std::string verb;
  /// The command line as it was typed, without the program's name.
  std::vector<std::string> words;
  std::map<std::string, std::vector<std::string>> values;

  bool has(const std::string& key) const { return this->values.count(key) > 0; }
  /// Empty when neither typed nor with a default.
  std::string text(const std::string& key) const;
  const std::vector<std::string>& list(const std::string& key) const;
  int integer(const std::string& key) const { return std::stoi(this->text(key)); }
  double number(const std::string& key) const { return std::stod(this->text(key)); }
  /// What --certificate asks of relative gap and residual.
  double certificate_tolerance() const
  {
    return this->text("certificate") == "tight" ? 1e-9 : 1e-6;
  }
};

/// Parses the command line by the option table.
/// @return -1 to go on with the arguments, else the exit code: 0 after --help or --version, 1 after
/// a usage error, which is told in one line on the standard error.
int parse_arguments(int argc, char** argv, Arguments& arguments);

} // namespace bindpose::cli

#endif
