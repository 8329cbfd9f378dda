#include "io/json_depth.h"

#include <string>

namespace bindpose
{

Status check_json_depth(std::string_view text)
{
  int depth = 0, line = 1;
  bool in_string = false;
  for (std::size_t k = 0; k < text.size(); ++k)
  {
    const char c = text[k];
    line += c == '\n' ? 1 : 0;
    if (in_string)
    {
      k += c == '\\' ? 1 : 0; // skip the escaped character
      in_string = c != '"';
      continue;
    }
    in_string = c == '"';
    depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
    if (depth > maximum_json_depth)
    {
      return Status::invalid_input("arrays and objects are nested deeper than the allowed " +
        std::to_string(maximum_json_depth) + " levels (line " + std::to_string(line) + ")");
    }
  }
  return {};
}

} // namespace bindpose
