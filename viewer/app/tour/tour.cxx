// Reads tours, the scripted demonstrations of the window. A step is a JSON object. The key of one
// member is the verb, the value of this member is the verb's argument, and the other members are
// fields that the verb allows. A table lists verbs and fields; all other words are errors, so that
// a misspelled word is not ignored.
#include "app/tour/tour.h"

#include "io/json_depth.h"
#include "pictures/window_picture.h"
#include "poses/json_fields.h"
#include "widgets/gizmo.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

namespace app::tour
{

using namespace bindpose;

namespace
{
constexpr int schema = 1;
constexpr std::size_t maximum_steps = 10000;
constexpr std::size_t maximum_bytes = 16 << 20;
constexpr double unlimited = std::numeric_limits<double>::max();
const char* const buttons[] = { "left", "middle", "right" };

/// The type of the argument of a verb.
enum class ArgumentType
{
  text,
  mouse_position,
  wait,
  seconds,
  size
};

struct VerbInfo
{
  TourVerb verb;
  const char* word;
  ArgumentType argument_type;
  const char* fields; ///< allowed fields, in addition to "say"
};
const VerbInfo verb_table[] = {
  { TourVerb::open, "open", ArgumentType::text, "" },
  { TourVerb::action, "action", ArgumentType::text, "answer" },
  { TourVerb::push, "push", ArgumentType::text, "answer" },
  { TourVerb::option, "option", ArgumentType::text, "value" },
  { TourVerb::panel, "panel", ArgumentType::text, "" },
  { TourVerb::select, "select", ArgumentType::text, "" },
  { TourVerb::type, "type", ArgumentType::text, "into" },
  { TourVerb::mode, "mode", ArgumentType::text, "" },
  { TourVerb::click, "click", ArgumentType::mouse_position, "button held" },
  { TourVerb::double_click, "double_click", ArgumentType::mouse_position, "button held" },
  { TourVerb::press, "press", ArgumentType::mouse_position, "button held" },
  { TourVerb::move, "move", ArgumentType::mouse_position, "held" },
  { TourVerb::release, "release", ArgumentType::mouse_position, "button held" },
  { TourVerb::drag, "drag", ArgumentType::mouse_position, "to moves button held" },
  { TourVerb::wheel, "wheel", ArgumentType::mouse_position, "turns held" },
  { TourVerb::scrub, "scrub", ArgumentType::seconds, "" },
  { TourVerb::key, "key", ArgumentType::text, "" },
  { TourVerb::resize, "resize", ArgumentType::size, "" },
  { TourVerb::wait, "wait", ArgumentType::wait, "" },
  { TourVerb::film, "film", ArgumentType::text, "of width" },
  { TourVerb::screenshot, "screenshot", ArgumentType::text, "of width scale transparent" },
  { TourVerb::check, "check", ArgumentType::text, "is at_least at_most as_at tolerance" },
};

const VerbInfo* find_verb(const std::string& word)
{
  const auto* found = std::find_if(std::begin(verb_table), std::end(verb_table),
    [&](const VerbInfo& info) { return word == info.word; });
  return found == std::end(verb_table) ? nullptr : found;
}

bool has_word(const std::string& words, const std::string& word)
{
  std::istringstream list(words);
  for (std::string item; list >> item;)
  {
    if (item == word)
    {
      return true;
    }
  }
  return false;
}

bool finite_number(const Json& json)
{
  return json.is_number() && std::isfinite(json.get<double>());
}

/// Read two numbers. Return false if the value is not a list of two numbers.
bool read_pair(const Json& json, std::array<double, 2>& pair)
{
  if (!json.is_array() || json.size() != 2 || !finite_number(json[0]) || !finite_number(json[1]))
  {
    return false;
  }
  pair = { json[0].get<double>(), json[1].get<double>() };
  return true;
}

Status read_position(const Json& json, const std::string& prefix, TourPosition& mouse_position)
{
  if (json.is_array())
  {
    return read_pair(json, mouse_position.position)
      ? Status()
      : Status::invalid_input(
          prefix + ": a position must be two fractions of the view size, for example [0.5, 0.5]");
  }
  const bool is_gizmo_part = json.is_object() && json.contains("gizmo");
  if (!is_gizmo_part && (!json.is_object() || !json.contains("handle")))
  {
    return Status::invalid_input(prefix +
      ": a position must be [0.5, 0.5], {\"handle\": \"NAME\", \"offset\": [0, 0]} or {\"gizmo\": "
      "\"move_x\", \"offset\": [0, 0]}");
  }
  for (const auto& [key, value] : json.items())
  {
    if (!has_word(is_gizmo_part ? "gizmo offset" : "handle along offset", key))
    {
      return Status::invalid_input(prefix + ": a position cannot have the field \"" + key + "\"");
    }
  }
  JsonFields fields(json, prefix);
  fields.read("handle", mouse_position.handle);
  fields.read("along", mouse_position.bone_fraction, -unlimited, unlimited);
  fields.read("offset", mouse_position.position.data(), 2);
  std::string part;
  fields.read("gizmo", part);
  if (!fields.status().ok())
  {
    return fields.status();
  }
  for (const GizmoPartWord& each : gizmo_part_words)
  {
    mouse_position.gizmo_part = part == each.word ? each.part : mouse_position.gizmo_part;
  }
  if (is_gizmo_part && mouse_position.gizmo_part == no_part)
  {
    return Status::invalid_input(prefix + ": unknown gizmo part \"" + part + "\"");
  }
  return !is_gizmo_part && mouse_position.handle.empty()
    ? Status::invalid_input(prefix + ": \"handle\" is empty; expected the name of a handle")
    : Status();
}

/// Read the new value of an option, or the expected value of a check: a number, a list of numbers,
/// a word, or true or false.
Status read_expected(const Json& json, const std::string& prefix, TourStep& step)
{
  if (json.is_string())
  {
    step.expects_text = true;
    step.expected_text = json.get<std::string>();
    return {};
  }
  if (json.is_boolean())
  {
    step.expects_bool = true;
    step.expected = { json.get<bool>() ? 1.0 : 0.0 };
    return {};
  }
  const Json list = json.is_array() ? json : Json::array({ json });
  for (const Json& number : list)
  {
    if (!finite_number(number))
    {
      return Status::invalid_input(
        prefix + ": a value must be a number, a list of numbers, a word, true or false");
    }
    step.expected.push_back(number.get<double>());
  }
  return step.expected.empty()
    ? Status::invalid_input(prefix + ": the list of numbers must not be empty")
    : Status();
}

Status read_check(const Json& json, const std::string& prefix, TourStep& step)
{
  int relations = 0;
  for (const auto& [word, relation] :
    { std::pair("is", TourRelation::is), std::pair("at_least", TourRelation::at_least),
      std::pair("at_most", TourRelation::at_most), std::pair("as_at", TourRelation::as_at) })
  {
    if (json.contains(word))
    {
      ++relations;
      step.relation = relation;
      if (const Status status = read_expected(json[word], prefix, step); !status.ok())
      {
        return status;
      }
    }
  }
  if (relations != 1)
  {
    return Status::invalid_input(
      prefix + ": a check must have exactly one of \"is\", \"at_least\", \"at_most\", \"as_at\"");
  }
  const bool bound =
    step.relation == TourRelation::at_least || step.relation == TourRelation::at_most;
  if (bound && (step.expected.size() != 1 || step.expects_bool))
  {
    return Status::invalid_input(prefix + ": \"at_least\" and \"at_most\" must be numbers");
  }
  if (step.relation == TourRelation::as_at && !step.expects_text)
  {
    return Status::invalid_input(prefix + ": \"as_at\" must be the name of a screenshot");
  }
  return {};
}

Status read_argument(
  const Json& value, ArgumentType argument_type, const std::string& prefix, TourStep& step)
{
  switch (argument_type)
  {
    case ArgumentType::text:
      if (!value.is_string() || value.get<std::string>().empty())
      {
        return Status::invalid_input(prefix + ": the value of the verb must be a nonempty string");
      }
      step.text = value.get<std::string>();
      return {};
    case ArgumentType::mouse_position:
      return read_position(value, prefix, step.mouse_position);
    case ArgumentType::size:
    {
      std::array<double, 2> size{};
      if (!read_pair(value, size) || !(size[0] >= 200 && size[0] <= 8000) ||
        !(size[1] >= 200 && size[1] <= 8000))
      {
        return Status::invalid_input(prefix + ": a size must be two numbers from 200 to 8000");
      }
      step.size = { static_cast<int>(size[0]), static_cast<int>(size[1]) };
      return {};
    }
    default:
      if (argument_type == ArgumentType::wait && value.is_string() &&
        (value == "bind" || value == "idle"))
      {
        step.text = value.get<std::string>();
        return {};
      }
      if (finite_number(value) && value.get<double>() >= 0.0 && value.get<double>() <= 3600.0)
      {
        step.seconds = value.get<double>();
        return {};
      }
      return Status::invalid_input(prefix +
        (argument_type == ArgumentType::wait ? ": expected \"bind\", \"idle\" or 0 to 3600 seconds"
                                             : ": expected 0 to 3600 seconds"));
  }
}

constexpr const char* plain_names =
  " must be 1 to 60 letters, digits, '_', '-' and '.', and must not start with '.'";

/// Report whether a name is allowed for a file that the tour writes.
bool is_plain_name(const std::string& name)
{
  return name.size() <= 60 && name.find_first_not_of('.') == 0 &&
    std::all_of(name.begin(), name.end(),
      [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '.'; });
}

Status read_step(const Json& json, std::size_t index, TourStep& step)
{
  std::string prefix = "step " + std::to_string(index + 1);
  if (!json.is_object())
  {
    return Status::invalid_input(prefix + " must be a JSON object");
  }
  const VerbInfo* info = nullptr;
  for (const auto& [key, value] : json.items())
  {
    if (const VerbInfo* verb = find_verb(key))
    {
      if (info)
      {
        return Status::invalid_input(
          prefix + " has two verbs, \"" + info->word + "\" and \"" + verb->word + "\"");
      }
      info = verb;
    }
  }
  if (!info)
  {
    const std::string first = json.empty() ? std::string() : json.begin().key();
    return Status::invalid_input(
      prefix + (json.empty() ? " is empty" : " must have a verb: \"" + first + "\" is not a verb"));
  }
  step.verb = info->verb;
  prefix = step_name(index, step);
  for (const auto& [key, value] : json.items())
  {
    if (key != info->word && key != "say" && !has_word(info->fields, key))
    {
      return Status::invalid_input(prefix + ": the verb cannot have the field \"" + key + "\"");
    }
  }
  if (const Status status = read_argument(json[info->word], info->argument_type, prefix, step);
      !status.ok())
  {
    return status;
  }
  JsonFields fields(json, prefix);
  fields.read("say", step.narration);
  fields.read("into", step.field);
  fields.read("answer", step.answer);
  fields.read("button", step.button, buttons);
  fields.read("moves", step.moves, 1, 1000);
  fields.read("turns", step.turns, -100.0, 100.0);
  fields.read("tolerance", step.tolerance, 0.0, unlimited);
  fields.read("width", step.width, 16, 8000);
  const char* const parts[] = { "window", "view", "dialog" };
  fields.read("of", step.part, parts);
  fields.read("scale", step.scale, 1, largest_scale_factor);
  fields.read("transparent", step.transparent);
  if (!fields.status().ok())
  {
    return fields.status();
  }
  if (step.part != TourPart::view && (step.scale > 1 || step.transparent))
  {
    return Status::invalid_input(
      prefix + ": \"scale\" and \"transparent\" require \"of\": \"view\"");
  }
  if (json.contains("held"))
  {
    for (const Json& key : json["held"].is_array() ? json["held"] : Json::array({ json["held"] }))
    {
      step.shift = step.shift || key == "shift";
      step.ctrl = step.ctrl || key == "ctrl";
      step.alt = step.alt || key == "alt";
      if (key != "shift" && key != "ctrl" && key != "alt")
      {
        return Status::invalid_input(
          prefix + ": \"held\" must be shift, ctrl or alt, or a list of these");
      }
    }
  }
  if (json.contains("answer") && !is_plain_name(step.answer))
  {
    return Status::invalid_input(prefix + ": the answer" + plain_names);
  }
  switch (step.verb)
  {
    case TourVerb::type:
      return step.field.empty() ? Status::invalid_input(prefix + ": \"into\" is missing")
                                : Status();
    case TourVerb::drag:
      return json.contains("to") ? read_position(json["to"], prefix, step.to)
                                 : Status::invalid_input(prefix + ": \"to\" is missing");
    case TourVerb::wheel:
      return json.contains("turns") ? Status()
                                    : Status::invalid_input(prefix + ": \"turns\" is missing");
    case TourVerb::option:
      return json.contains("value") ? read_expected(json["value"], prefix, step)
                                    : Status::invalid_input(prefix + ": \"value\" is missing");
    case TourVerb::check:
      return read_check(json, prefix, step);
    case TourVerb::screenshot:
    case TourVerb::film:
      return is_plain_name(step.text) ? Status()
                                      : Status::invalid_input(prefix + ": a name" + plain_names);
    default:
      return {};
  }
}

/// Check that screenshots have unique names, and that `as_at` names an earlier screenshot.
Status check_names(const Tour& tour)
{
  std::vector<std::string> names;
  bool filming = false;
  for (std::size_t k = 0; k < tour.steps.size(); ++k)
  {
    const TourStep& step = tour.steps[k];
    const auto known = [&](const std::string& name)
    { return std::find(names.begin(), names.end(), name) != names.end(); };
    const std::string prefix = step_name(k, step);
    if (step.verb == TourVerb::film)
    {
      if (filming != (step.text == "end"))
      {
        return Status::invalid_input(
          prefix + (filming ? ": the previous film must end first" : ": no film was started"));
      }
      filming = !filming;
    }
    const bool writes_named_file =
      step.verb == TourVerb::screenshot || (step.verb == TourVerb::film && filming);
    if (writes_named_file && known(step.text))
    {
      return Status::invalid_input(
        prefix + ": the name \"" + step.text + "\" is already used by an earlier step");
    }
    if (writes_named_file)
    {
      names.push_back(step.text);
    }
    if (step.verb == TourVerb::check && step.relation == TourRelation::as_at &&
      !known(step.expected_text))
    {
      return Status::invalid_input(
        prefix + ": no earlier screenshot is named \"" + step.expected_text + "\"");
    }
  }
  return filming ? Status::invalid_input("the last film must end: add the step {\"film\": \"end\"}")
                 : Status();
}
} // namespace

const char* to_string(TourVerb verb)
{
  return verb_table[static_cast<std::size_t>(verb)].word;
}

std::string step_name(std::size_t index, const TourStep& step)
{
  return "step " + std::to_string(index + 1) + " (" + to_string(step.verb) + ")";
}

Status parse_tour(const std::string& text, Tour& tour)
{
  tour = {};
  Status depth = check_json_depth(text);
  if (!depth.ok())
  {
    return depth;
  }
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object())
  {
    return Status::invalid_input("expected a JSON object");
  }
  if (!json.contains("tour") || !json["tour"].is_object())
  {
    return Status::invalid_input("expected a tour: {\"tour\": {\"schema\": 1}, \"steps\": […]}");
  }
  for (const auto& [key, value] : json.items())
  {
    if (!has_word("tour steps", key))
    {
      return Status::invalid_input("a tour cannot have the field \"" + key + "\"");
    }
  }
  const Json& head = json["tour"];
  for (const auto& [key, value] : head.items())
  {
    if (!has_word("schema name size view seconds", key))
    {
      return Status::invalid_input("the object \"tour\" cannot have the field \"" + key + "\"");
    }
  }
  int found = 0;
  JsonFields fields(head, "the object \"tour\"");
  fields.read("schema", found, 0, 1000000);
  fields.read("name", tour.name);
  fields.read("seconds", tour.seconds, 0.001, 86400.0);
  if (!fields.status().ok())
  {
    return fields.status();
  }
  if (found != schema)
  {
    return Status::invalid_input("the schema of the tour is " + std::to_string(found) +
      "; expected " + std::to_string(schema));
  }
  for (const auto& [key, size] : { std::pair("size", &tour.size), { "view", &tour.view } })
  {
    if (head.contains(key))
    {
      TourStep read;
      const Status status =
        read_argument(head[key], ArgumentType::size, "the object \"tour\"", read);
      if (!status.ok())
      {
        return status;
      }
      *size = read.size;
    }
  }
  if (!json.contains("steps") || !json["steps"].is_array() || json["steps"].empty() ||
    json["steps"].size() > maximum_steps)
  {
    return Status::invalid_input("\"steps\" must be a list of 1 to 10000 steps");
  }
  tour.steps.resize(json["steps"].size());
  for (std::size_t k = 0; k < tour.steps.size(); ++k)
  {
    if (const Status status = read_step(json["steps"][k], k, tour.steps[k]); !status.ok())
    {
      return status;
    }
  }
  return check_names(tour);
}

Status read_tour(const std::string& path, Tour& tour)
{
  std::ifstream file(path, std::ios::binary);
  std::string text;
  text.resize(maximum_bytes);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.gcount() == 0 || !file.eof())
  {
    return Status::invalid_input("tour '" + path + "' cannot be read");
  }
  text.resize(static_cast<std::size_t>(file.gcount()));
  Status status = parse_tour(text, tour);
  if (!status.ok())
  {
    status = Status::invalid_input("tour '" + path + "': " + status.message);
  }
  if (tour.name.empty())
  {
    const std::size_t slash = path.find_last_of('/');
    tour.name = path.substr(slash == std::string::npos ? 0 : slash + 1);
    tour.name = tour.name.substr(0, tour.name.rfind('.'));
  }
  return status;
}

} // namespace app::tour
