// One table per group, in the order of app/window_keys.h, from which the window itself gets its
// keys.
#include "cli/key_table.h"

#include "app/window_keys.h"

#include <cctype>

namespace bindpose::cli
{

std::string key_table_markdown()
{
  std::string text;
  for (const KeyGroup& group : all_keys())
  {
    std::string when = group.when;
    when[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(when[0])));
    text += "| " + when + " | what it does |\n|---|---|\n";
    for (const auto& [input, what] : group.rows)
    {
      text += "| " + input + " | " + what + " |\n";
    }
    text += '\n';
  }
  text.pop_back();
  return text;
}

} // namespace bindpose::cli
