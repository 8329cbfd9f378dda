// Converts the option table to a CLI11 parser, and the parsed values to Arguments.
#include "cli/arguments.h"

#include "cli/option_table.h"
#include "cli/suggestion.h"
#include "io/text_scanner.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <limits>

namespace bindpose::cli
{

namespace
{
std::vector<std::string> split(const std::string& text, char separator)
{
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, separator);)
  {
    words.push_back(word);
  }
  return words;
}

/// Parse a list such as "1,2,3".
/// @param integers  true: accept only integers
/// @return the numbers; empty if an entry of the list is not accepted
std::vector<double> parse_numbers(const std::string& text, bool integers)
{
  std::vector<double> numbers;
  for (const std::string& word : split(text, ','))
  {
    double value = 0;
    Index integer = 0;
    const bool is_valid = integers
      ? parse_index(word, integer) && std::abs(integer) <= std::numeric_limits<int>::max()
      : parse_number(word, value) && std::isfinite(value);
    if (!is_valid)
    {
      return {};
    }
    numbers.push_back(integers ? static_cast<double>(integer) : value);
  }
  return numbers;
}

/// Return the allowed values of a numeric option as a phrase: "an integer, at least 2", "3 numbers
/// with commas between".
std::string expected_numbers(const Option& option)
{
  const bool integers = option.kind == OptionKind::integer || option.kind == OptionKind::integers;
  std::string text = option.length == 1 ? (integers ? "an integer" : "a finite number")
                                        : std::to_string(option.length) +
      (integers ? " integers" : " numbers") + " separated by commas";
  return text + (option.values[0] ? std::string(" (") + option.values + ")" : "");
}

/// Check a word as the value of a numeric option.
/// @return the error sentence if the option does not allow the word; empty if it is valid
std::string number_error(const Option& option, const std::string& word)
{
  const bool integers = option.kind == OptionKind::integer || option.kind == OptionKind::integers;
  const std::vector<double> numbers = parse_numbers(word, integers);
  bool is_valid = static_cast<int>(numbers.size()) == option.length;
  for (const double number : numbers)
  {
    is_valid = is_valid && option.range.contains(number);
  }
  return is_valid ? std::string()
                  : "'" + word + "' is not valid: expected " + expected_numbers(option);
}

void add_check(CLI::Option* parsed, const Option& option)
{
  if (option.kind == OptionKind::choice)
  {
    parsed->check(
      [choices = split(option.choices, '|'), &option](const std::string& word)
      {
        const bool known = std::find(choices.begin(), choices.end(), word) != choices.end();
        return known
          ? std::string()
          : "'" + word + "' is not valid: expected " + option.choices + suggestion(word, choices);
      });
  }
  else if (option.kind != OptionKind::flag && option.kind != OptionKind::text)
  {
    parsed->check([&option](const std::string& word) { return number_error(option, word); });
  }
}

void add_option(CLI::App& app, const Option& option, Arguments& arguments)
{
  if (option.kind == OptionKind::flag)
  {
    app.add_flag_callback(
      option.name, [&arguments, &option]() { arguments.values[option.key()] = { "on" }; },
      option.help);
    return;
  }
  std::string help = option.help;
  if (option.kind == OptionKind::choice)
  {
    help += std::string(" {") + option.choices + "}";
  }
  if (option.values[0])
  {
    help += std::string(" [") + option.values + "]";
  }
  if (option.default_value[0])
  {
    help += std::string(" (default: ") + option.default_value + ")";
  }
  CLI::Option* parsed = nullptr;
  if (option.repeated)
  {
    parsed = app.add_option_function<std::vector<std::string>>(
      option.name,
      [&arguments, &option](const std::vector<std::string>& words)
      { arguments.values[option.key()] = words; },
      help);
  }
  else
  {
    parsed = app.add_option_function<std::string>(
      option.name,
      [&arguments, &option](const std::string& word) { arguments.values[option.key()] = { word }; },
      help);
    parsed->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  }
  parsed->type_name(option.value)->required(option.required && !option.optional_if[0]);
  add_check(parsed, option);
}

/// Return the first required option that is missing; empty if there is none.
std::string missing_option(const std::vector<Option>& options, const Arguments& arguments)
{
  for (const Option& option : options)
  {
    if (option.required && !arguments.has(option.key()) &&
      !(option.optional_if[0] && arguments.has(option.optional_if)))
    {
      return option.name;
    }
  }
  return "";
}

std::vector<std::string> verb_names()
{
  std::vector<std::string> names;
  for (const Verb& verb : verbs())
  {
    names.emplace_back(verb.name);
  }
  return names;
}

/// Return the error message for the first unknown option of the verb; empty if there is none.
std::string unknown_option(const Verb& verb, const std::vector<std::string>& command_line)
{
  std::vector<std::string> known{ "--help" };
  for (const std::vector<Option>* options : { &verb.options, &common_options() })
  {
    for (const Option& option : *options)
    {
      const std::vector<std::string> names = split(option.name, ',');
      known.push_back(names.back());
    }
  }
  for (const std::string& word : command_line)
  {
    const std::string name = word.substr(0, word.find('='));
    if (name.size() > 2 && name.compare(0, 2, "--") == 0 &&
      std::find(known.begin(), known.end(), name) == known.end())
    {
      return "unknown option '" + name + "'" + suggestion(name, known);
    }
  }
  return {};
}

/// Return the error message for unexpected arguments.
/// @param unexpected  typed arguments that are neither options nor positional arguments of the
/// verb; not empty
std::string unexpected_argument(const Verb& verb, const std::vector<std::string>& unexpected)
{
  std::string files;
  for (const Option& option : verb.options)
  {
    if (option.name[0] != '-')
    {
      files += (files.empty() ? "" : " and ") + std::string(option.name);
    }
  }
  return "unexpected argument '" + unexpected.front() +
    "'; expected positional arguments: " + files;
}

/// Check that the selected method uses all options that were typed.
/// @return the error sentence for the first typed option that the method does not use; empty if
/// there is none
std::string unused_option(const Verb& verb, const Arguments& arguments)
{
  // With --dynamics, every method also uses options of the as-rigid-as-possible methods.
  // Option::methods does not list this use, so the options are not checked.
  if (!arguments.has("method") || arguments.has("dynamics"))
  {
    return {};
  }
  const std::string method = arguments.text("method");
  for (const Option& option : verb.options)
  {
    const std::vector<std::string> using_methods = split(option.methods, '|');
    if (arguments.is_typed(option.key()) && !using_methods.empty() &&
      std::find(using_methods.begin(), using_methods.end(), method) == using_methods.end())
    {
      return std::string(option.name) + " is not used by --method " + method + "; it is used by " +
        option.methods;
    }
  }
  return {};
}

void fill_defaults(const std::vector<Option>& options, Arguments& arguments)
{
  for (const Option& option : options)
  {
    if (arguments.has(option.key()))
    {
      arguments.typed_keys.insert(option.key());
    }
    if (option.default_value[0] && !arguments.has(option.key()))
    {
      arguments.values[option.key()] = { option.default_value };
    }
  }
}
} // namespace

std::string Arguments::text(const std::string& key) const
{
  const auto entry = this->values.find(key);
  return entry == this->values.end() || entry->second.empty() ? "" : entry->second.front();
}

const std::vector<std::string>& Arguments::list(const std::string& key) const
{
  static const std::vector<std::string> none;
  const auto entry = this->values.find(key);
  return entry == this->values.end() ? none : entry->second;
}

std::vector<double> Arguments::numbers(const std::string& key) const
{
  return parse_numbers(this->text(key), false);
}

int parse_arguments(int argc, char** argv, Arguments& arguments)
{
  CLI::App app(
    "Turn triangle meshes into deformable shapes: winding numbers, tets, weights and poses.");
  app.name("bindpose");
  app.set_version_flag("--version", BINDPOSE_VERSION);
  app.require_subcommand(1);
  app.footer("Run bindpose VERB --help for the options of a verb.");
  for (const Verb& verb : verbs())
  {
    CLI::App* sub = app.add_subcommand(verb.name, verb.summary);
    sub->callback([&arguments, &verb]() { arguments.verb = verb.name; });
    for (const Option& option : verb.options)
    {
      add_option(*sub, option, arguments);
    }
    for (const Option& option : common_options())
    {
      add_option(*sub, option, arguments);
    }
  }
  app
    .add_subcommand(
      "key-table", "print the keyboard and mouse shortcuts of the window as a Markdown table")
    ->group("")
    ->callback([&arguments]() { arguments.verb = "key-table"; });
  if (argc < 2)
  {
    std::string list;
    for (const std::string& name : verb_names())
    {
      list += (list.empty() ? "" : ", ") + name;
    }
    std::cerr << "bindpose: no verb is given; expected one of " << list
              << " (see bindpose --help)\n";
    return 1;
  }
  if (argv[1][0] != '-' &&
    app.get_subcommands([&](const CLI::App* sub) { return sub->get_name() == argv[1]; }).empty())
  {
    std::cerr << "bindpose: '" << argv[1] << "' is not a verb" << suggestion(argv[1], verb_names())
              << " (see bindpose --help)\n";
    return 1;
  }
  arguments.command_line.assign(argv + 1, argv + argc);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success& success) // --help or --version was typed
  {
    return app.exit(success);
  }
  catch (const CLI::ParseError& error)
  {
    std::string command_name = "bindpose";
    for (const CLI::App* sub : app.get_subcommands())
    {
      command_name += " " + sub->get_name();
    }
    std::string sentence = error.what();
    for (const Verb& verb : verbs())
    {
      if (argv[1] == std::string(verb.name))
      {
        std::string better_message = unknown_option(verb, arguments.command_line);
        if (better_message.empty() && dynamic_cast<const CLI::ExtrasError*>(&error))
        {
          better_message = unexpected_argument(verb, app.remaining(true));
        }
        sentence = better_message.empty() ? sentence : better_message;
      }
    }
    std::replace(sentence.begin(), sentence.end(), '\n', ' ');
    std::cerr << command_name << ": " << sentence << " (see " << command_name << " --help)\n";
    return 1;
  }
  for (const Verb& verb : verbs())
  {
    if (arguments.verb == verb.name)
    {
      const std::string missing = missing_option(verb.options, arguments);
      if (!missing.empty())
      {
        std::cerr << "bindpose " << verb.name << ": " << missing << " is required (see bindpose "
                  << verb.name << " --help)\n";
        return 1;
      }
      fill_defaults(verb.options, arguments);
      const std::string unused = unused_option(verb, arguments);
      if (!unused.empty())
      {
        std::cerr << "bindpose " << verb.name << ": " << unused << '\n';
        return 1;
      }
    }
  }
  fill_defaults(common_options(), arguments);
  return -1;
}

} // namespace bindpose::cli
