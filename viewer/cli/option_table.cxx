// The table of options as Markdown.
#include "cli/option_table.h"

namespace bindpose::cli
{

std::string Option::key() const
{
  const std::string names = this->name;
  const std::size_t dashes = names.rfind("--");
  return dashes == std::string::npos ? names : names.substr(dashes + 2);
}

namespace
{
std::string row(const Option& option)
{
  std::string text = "| `";
  const std::string names = option.name;
  const std::size_t comma = names.find(',');
  text += comma == std::string::npos ? names : names.substr(0, comma);
  if (option.repeated)
  {
    text += "…";
  }
  text += option.value[0] ? std::string(" ") + option.value + "`" : "`";
  text += " | ";
  text += option.values;
  if (option.kind == OptionKind::choice)
  {
    std::string choices = option.choices;
    for (std::size_t at = choices.find('|'); at != std::string::npos; at = choices.find('|', at))
    {
      choices.replace(at, 1, ", ");
    }
    text += choices;
  }
  text += " | ";
  text += option.required && !option.unless[0] ? "required" : option.fallback;
  return text + " | " + option.help + " |\n";
}

const char* const table_head = "| option | values | default | meaning |\n|---|---|---|---|\n";
} // namespace

std::string option_table_markdown()
{
  std::string text;
  for (const Verb& verb : verbs())
  {
    text += std::string("### `bindpose ") + verb.name + "`: " + verb.summary + "\n\n" + table_head;
    for (const Option& option : verb.options)
    {
      text += row(option);
    }
    text += '\n';
  }
  text += std::string("### Every verb\n\n") + table_head;
  for (const Option& option : common_options())
  {
    text += row(option);
  }
  return text;
}

} // namespace bindpose::cli
