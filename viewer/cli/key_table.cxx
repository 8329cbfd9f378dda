// Writes the keys of the window as Markdown, one table per group. The groups and keys are read from
// app/parts/window_keys.h, which the window itself uses.
#include "cli/key_table.h"

#include "app/parts/window_keys.h"

#include <cctype>

namespace bindpose::cli
{

std::string key_table_markdown()
{
  std::string text;
  for (const app::parts::KeyGroup& group : app::parts::all_keys())
  {
    std::string heading = group.heading;
    heading[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(heading[0])));
    text += "| " + heading + " | what it does |\n|---|---|\n";
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
