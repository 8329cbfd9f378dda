// Serialization of reports (see report_json.h).
#include "io/report_json.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace bindpose
{

namespace
{
using Json = nlohmann::ordered_json;

template <typename T>
bool has_json_form(const T& value)
{
  if constexpr (std::is_same_v<T, double>)
  {
    return std::isfinite(value);
  }
  return true;
}

/// Return the JSON object that contains the member of a dotted key: for "a.b.c", the object of
/// "a.b". Missing objects are created.
/// @param member_name set to the name of the member ("c").
Json& object_of(Json& root, const std::string& key, std::string& member_name)
{
  Json* node = &root;
  std::size_t begin = 0;
  for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin))
  {
    node = &(*node)[key.substr(begin, dot - begin)];
    begin = dot + 1;
  }
  member_name = key.substr(begin);
  return *node;
}
} // namespace

std::string to_json(const Report& report, int indent)
{
  Json root = Json::object();
  for (const auto& [key, value] : report.entries())
  {
    const std::size_t brackets = key.find("[]");
    std::visit(
      [&, &name = key](const auto& v)
      {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>)
        {
          if (has_json_form(v))
          {
            std::string member_name;
            Json& object = object_of(root, name, member_name);
            object[member_name] = v;
          }
        }
        else
        {
          // `v` is either a list of values (key "h[]" or "h"), or one property of each object in a
          // list (key "h[].x").
          const bool column = brackets != std::string::npos && brackets + 2 < name.size();
          std::string member_name;
          Json& object = object_of(root, name.substr(0, brackets), member_name);
          Json& list = object[member_name];
          if (list.is_null())
          {
            list = Json::array();
          }
          for (std::size_t i = 0; i < v.size(); ++i)
          {
            const bool fits = has_json_form(v[i]);
            if (!column)
            {
              list.push_back(fits ? Json(v[i]) : Json());
              continue;
            }
            if (list.size() <= i)
            {
              list.push_back(Json::object());
            }
            if (fits)
            {
              list[i][name.substr(brackets + 3)] = v[i];
            }
          }
        }
      },
      value);
  }
  return root.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace bindpose
