// Reader and writer of pose files (POSE.json).
//
// The JSON library parses the text. This file rejects everything that the library would accept
// silently (unknown keys, duplicate keys, numbers out of range), because ignoring a part of a pose
// would move the wrong handles. Names of handles are replaced by indices during reading. Transforms
// are computed afterward, parents first, so the order of handles in the file does not matter.
#include "pose/pose_file.h"

#include "base/number_text.h"
#include "io/json_depth.h"
#include "pose/handle_hierarchy.h"
#include "pose/transform_parts.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <stdexcept>

namespace bindpose
{

namespace
{
using Json = nlohmann::ordered_json;

/// An error in the file, with a message of one sentence. parse_pose_file() returns it as
/// invalid_input.
struct PoseFileError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

[[noreturn]] void fail(const std::string& location, const std::string& problem)
{
  throw PoseFileError("the pose file: " + location + problem);
}

const char* describe_type(const Json& value)
{
  switch (value.type())
  {
    case Json::value_t::null:
      return "null";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "a list";
    case Json::value_t::string:
      return "a string";
    case Json::value_t::boolean:
      return "true or false";
    default:
      return "a number";
  }
}

void check_object(
  const Json& value, const std::string& location, std::initializer_list<const char*> known_keys)
{
  if (!value.is_object())
  {
    fail(location, std::string(" is ") + describe_type(value) + "; it must be an object");
  }
  for (const auto& item : value.items())
  {
    bool found = false;
    std::string list;
    for (const char* key : known_keys)
    {
      found = found || item.key() == key;
      list += (list.empty() ? "" : ", ") + std::string(key);
    }
    if (!found)
    {
      fail(location, " has the unknown key '" + item.key() + "' (expected: " + list + ")");
    }
  }
}

double number(const Json& value, const std::string& location)
{
  if (!value.is_number())
  {
    fail(location, std::string(" is ") + describe_type(value) + "; it must be a number");
  }
  const auto x = value.get<double>();
  if (!std::isfinite(x))
  {
    fail(location, " is not a finite number");
  }
  return x;
}

double positive_number(const Json& value, const std::string& location)
{
  const double x = number(value, location);
  if (!(x > 0.0))
  {
    fail(location, " must be greater than 0");
  }
  return x;
}

template <int Size>
Eigen::Matrix<double, Size, 1> numbers(const Json& value, const std::string& location)
{
  if (!value.is_array() || value.size() != Size)
  {
    fail(location, " must be a list of " + std::to_string(Size) + " numbers");
  }
  Eigen::Matrix<double, Size, 1> result;
  for (int i = 0; i < Size; ++i)
  {
    result[i] = number(value[static_cast<std::size_t>(i)], location);
  }
  return result;
}

/// Return the index of a string value in the list of allowed words.
template <std::size_t Count>
std::size_t word(
  const Json& value, const std::string& location, const char* const (&known_words)[Count])
{
  std::string list;
  for (std::size_t k = 0; k < Count; ++k)
  {
    if (value.is_string() && value.get<std::string>() == known_words[k])
    {
      return k;
    }
    list += (k > 0 ? ", " : "") + std::string(known_words[k]);
  }
  fail(location, " must be one of " + list);
}

Eigen::Matrix3d read_rotation(const Json& value, const std::string& location)
{
  check_object(value, location, { "axis", "degrees" });
  if (!value.contains("axis") || !value.contains("degrees"))
  {
    fail(location, " must have both axis and degrees");
  }
  Vec3 axis = numbers<3>(value["axis"], location + ".axis");
  const double degrees = number(value["degrees"], location + ".degrees");
  const double largest = axis.cwiseAbs().maxCoeff();
  if (largest == 0.0)
  {
    fail(location, ".axis has length zero");
  }
  // Divide by the largest coordinate first, because the squares of tiny coordinates would be zero.
  axis = (axis / largest).normalized();
  return Eigen::AngleAxisd(degrees * (EIGEN_PI / 180.0), axis).toRotationMatrix();
}

HandleEdit read_handle(
  const Json& value, const std::string& location, Index index, const Handle& rest, int version)
{
  check_object(value, location,
    { "mode", "translate", "rotate", "scale", "space", "head", "tail", "stretch", "twist" });
  HandleEdit edit;
  edit.handle = index;
  edit.with_parent = version > 1;
  for (const auto& item : value.items())
  {
    const std::string& key = item.key();
    const Json& entry = item.value();
    const std::string entry_path = location + "." + key;
    const bool for_bones = key == "head" || key == "tail" || key == "stretch" || key == "twist";
    if (for_bones && rest.kind != HandleKind::bone)
    {
      fail(entry_path,
        std::string(" can only be used for bones, but the handle is a ") + to_string(rest.kind));
    }
    if (key == "mode")
    {
      edit.mode = static_cast<HandleMode>(word(entry, entry_path, handle_mode_words));
      if (constrains_tail(*edit.mode) && rest.kind != HandleKind::bone)
      {
        fail(entry_path,
          " is '" + std::string(to_string(*edit.mode)) +
            "', which is only for bones, but the handle is a " + std::string(to_string(rest.kind)));
      }
    }
    else if (key == "translate")
    {
      edit.translate = numbers<3>(entry, entry_path);
    }
    else if (key == "rotate")
    {
      edit.rotation = read_rotation(entry, entry_path);
    }
    else if (key == "scale")
    {
      edit.scale = positive_number(entry, entry_path);
    }
    else if (key == "space")
    {
      edit.with_parent = word(entry, entry_path, { "parent", "world" }) == 0;
    }
    else if (key == "head")
    {
      edit.head = numbers<3>(entry, entry_path);
    }
    else if (key == "tail")
    {
      edit.tail = numbers<3>(entry, entry_path);
    }
    else if (key == "stretch")
    {
      edit.stretch = positive_number(entry, entry_path);
    }
    else
    {
      edit.twist = numbers<2>(entry, entry_path);
    }
  }
  if (edit.head || edit.tail)
  {
    if (edit.translate || edit.rotation || edit.scale)
    {
      fail(location, " must not combine head or tail with translate, rotate or scale");
    }
    const bool both_ends_known = (edit.head && edit.tail) || version < 2 || !edit.with_parent;
    if (both_ends_known && edit.head.value_or(rest.head) == edit.tail.value_or(rest.tail))
    {
      fail(location, " must not have length zero in the pose");
    }
  }
  return edit;
}

/// Report whether a value in a handle's entry is an expression. All strings are expressions, except
/// the values of "mode" and "space".
bool is_expression(const std::string& key, const Json& value)
{
  return value.is_string() && key != "mode" && key != "space";
}

/// Evaluates the expressions of a file at one time, and records whether the file has any.
struct Expressions
{
  const PoseExpression& evaluate;
  double time;
  bool found = false;

  /// Replace expressions in a value by numbers.
  void replace(Json& value, const std::string& key, const std::string& location)
  {
    if (is_expression(key, value) && this->evaluate)
    {
      this->found = true;
      const auto text = value.get<std::string>();
      double result = 0.0;
      const Status status = this->evaluate(text, this->time, result);
      if (!status.ok())
      {
        fail(location, " is '" + text + "': " + status.message);
      }
      if (!std::isfinite(result))
      {
        fail(location,
          " is '" + text + "', which is not a finite number at t = " + short_number(this->time));
      }
      value = result;
    }
    else if (value.is_array())
    {
      for (Json& entry : value)
      {
        this->replace(entry, key, location);
      }
    }
    else if (value.is_object())
    {
      for (const auto& item : value.items())
      {
        this->replace(item.value(), item.key(), location + "." + item.key());
      }
    }
  }
};

/// Versions 1 to newest_version can be read; newest_version is written.
constexpr int newest_version = 2;

int read_version(const Json& root)
{
  if (!root.is_object() || !root.contains("version"))
  {
    return 1;
  }
  const Json& version = root["version"];
  for (int version_number = 1; version_number <= newest_version; ++version_number)
  {
    if (version.is_number() && version.get<double>() == version_number)
    {
      return version_number;
    }
  }
  fail("version", " is " + version.dump() + "; expected 1 or 2");
}

PoseEdits read_pose(const Json& value, const std::string& location,
  const std::map<std::string, Index>& index_of, const Handles& handles, Expressions& expressions,
  int version)
{
  if (!value.contains("handles"))
  {
    fail(location, " must have the key 'handles'");
  }
  if (!value["handles"].is_object())
  {
    fail(location, ".handles must be an object whose keys are handle names");
  }
  PoseEdits edits;
  edits.children_follow = version > 1;
  for (const auto& item : value["handles"].items())
  {
    const auto found = index_of.find(item.key());
    if (found == index_of.end())
    {
      fail(location, " refers to the handle '" + item.key() + "', which does not exist");
    }
    const std::string handle = location + " handle '" + item.key() + "'";
    Json entry = item.value();
    expressions.replace(entry, "", handle);
    edits.handles.push_back(read_handle(
      entry, handle, found->second, handles[static_cast<std::size_t>(found->second)], version));
  }
  return edits;
}

/// Report whether version 2 would pose a handle of a version 1 file differently. This is the case
/// if a pose moves a parent and has no "space" for a child.
bool omits_child(const Json& root, const Handles& handles)
{
  const auto pose_omits_child = [&](const Json& pose)
  {
    const Json& handle_entries = pose["handles"];
    return std::any_of(handles.begin(), handles.end(),
      [&](const Handle& child)
      {
        const auto entry = handle_entries.find(child.name);
        return child.parent >= 0 &&
          handle_entries.contains(handles[static_cast<std::size_t>(child.parent)].name) &&
          (entry == handle_entries.end() || !entry->contains("space"));
      });
  };
  if (!root.contains("frames"))
  {
    return pose_omits_child(root);
  }
  return std::any_of(root["frames"].begin(), root["frames"].end(), pose_omits_child);
}

/// Parse JSON and reject duplicate keys. The library alone would silently use the last of several
/// equal keys.
Json parse_without_doubled_keys(const std::string& text)
{
  std::vector<std::set<std::string>> keys;
  const Json::parser_callback_t track_keys = [&](int, Json::parse_event_t event, Json& parsed)
  {
    if (event == Json::parse_event_t::object_start)
    {
      keys.emplace_back();
    }
    else if (event == Json::parse_event_t::object_end)
    {
      keys.pop_back();
    }
    else if (event == Json::parse_event_t::key &&
      !keys.back().insert(parsed.get<std::string>()).second)
    {
      fail("the key '" + parsed.get<std::string>() + "'", " is defined twice");
    }
    return true;
  };
  return Json::parse(text, track_keys);
}
} // namespace

Status parse_pose_file(const std::string& text, const Handles& handles, PoseSequence& sequence,
  const PoseExpression& expression, double time)
{
  sequence = PoseSequence();
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
  {
    return Status::invalid_input("the pose file is empty");
  }
  const Status depth = check_json_depth(text);
  if (!depth.ok())
  {
    return Status::invalid_input("the pose file: " + depth.message);
  }
  std::map<std::string, Index> index_of;
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    index_of[handles[i].name] = static_cast<Index>(i);
  }
  try
  {
    const Json root = parse_without_doubled_keys(text);
    const int version = read_version(root);
    Status status;
    const auto warn_about_children = [&]
    {
      if (!root.contains("version") && omits_child(root, handles))
      {
        status.warnings.push_back(
          "the pose file has no \"version\" and is read as version 1, in which children do not "
          "follow their parents; add \"version\": 2 to let them follow");
      }
    };
    if (!root.is_object() || !root.contains("frames"))
    {
      check_object(root, "the pose", { "version", "handles" });
      Expressions expressions{ expression, time };
      sequence.frames.push_back(
        read_pose(root, "the pose", index_of, handles, expressions, version));
      sequence.has_expressions = expressions.found;
      warn_about_children();
      return status;
    }
    check_object(root, "the sequence", { "version", "frames", "fps" });
    sequence.sequence = true;
    if (root.contains("fps"))
    {
      sequence.frames_per_second = positive_number(root["fps"], "fps");
    }
    if (!root["frames"].is_array() || root["frames"].empty())
    {
      fail("frames", " must be a list of at least one pose");
    }
    for (const Json& frame : root["frames"])
    {
      const std::string location = "frame " + std::to_string(sequence.frames.size());
      Expressions expressions{ expression,
        static_cast<double>(sequence.frames.size()) / sequence.frames_per_second };
      check_object(frame, location, { "handles" });
      sequence.frames.push_back(
        read_pose(frame, location, index_of, handles, expressions, version));
      sequence.has_expressions = sequence.has_expressions || expressions.found;
    }
    warn_about_children();
    return status;
  }
  catch (const PoseFileError& error)
  {
    sequence = PoseSequence();
    return Status::invalid_input(error.what());
  }
  catch (const nlohmann::json::exception& error)
  {
    sequence = PoseSequence();
    // The message of the library begins with the id of the exception, for example
    // "[json.exception.parse_error.101] parse error at line 1, …". Remove the id.
    const std::string problem = error.what();
    const std::size_t end = problem.find("] ");
    return Status::invalid_input("the pose file is not valid JSON: " +
      (end == std::string::npos ? problem : problem.substr(end + 2)));
  }
}

bool read_pose_times(const std::string& text, PoseTimes& times)
{
  times = PoseTimes();
  if (!check_json_depth(text).ok())
  {
    return false;
  }
  const Json root = Json::parse(text, nullptr, false);
  if (!root.is_object())
  {
    return false;
  }
  const auto expressions_in = [](const Json& pose)
  {
    const auto handles = pose.is_object() ? pose.find("handles") : pose.end();
    if (!pose.is_object() || handles == pose.end() || !handles->is_object())
    {
      return false;
    }
    const std::function<bool(const std::string&, const Json&)> any =
      [&any](const std::string& key, const Json& value)
    {
      bool found = is_expression(key, value);
      for (auto item = value.begin(); value.is_structured() && item != value.end(); ++item)
      {
        found = found || any(value.is_object() ? item.key() : key, *item);
      }
      return found;
    };
    return any("", *handles);
  };
  if (!root.contains("frames"))
  {
    times.has_expressions = expressions_in(root);
    return root.contains("handles");
  }
  const Json& frames = root["frames"];
  if (!frames.is_array() || frames.empty())
  {
    return false;
  }
  times.frames = static_cast<Index>(frames.size());
  const auto fps = root.find("fps");
  if (fps != root.end() && fps->is_number() && fps->get<double>() > 0.0)
  {
    times.frames_per_second = fps->get<double>();
  }
  for (const Json& frame : frames)
  {
    times.has_expressions = times.has_expressions || expressions_in(frame);
  }
  return true;
}

namespace
{
bool has_transform(const HandleEdit& edit)
{
  return edit.head || edit.tail || edit.translate || edit.rotation || edit.scale;
}

/// Apply the transform of an edit to a handle that inherits `parent_transform` from its parent.
void place_handle(
  const HandleEdit& edit, const Handle& rest, const Affine& parent_transform, HandlePose& posed)
{
  if (!edit.head && !edit.tail)
  {
    const Eigen::Matrix3d linear =
      edit.scale.value_or(1.0) * edit.rotation.value_or(Eigen::Matrix3d::Identity());
    posed.transform = compose(
      parent_transform, affine_about(rest.head, linear, edit.translate.value_or(Vec3::Zero())));
    return;
  }
  const Vec3 inherited_head = parent_transform * rest.head.homogeneous();
  const Vec3 inherited_tail = parent_transform * rest.tail.homogeneous();
  const Vec3 inherited_vector = inherited_tail - inherited_head;
  const Vec3 head = edit.head.value_or(inherited_head);
  const Vec3 bone = edit.tail.value_or(inherited_tail) - head;
  // If the file gives only one end, the other end moves with the parent, and the two ends may
  // coincide up to round-off. In this case the ends define no direction, and the bone keeps the
  // direction that it inherits.
  constexpr double round_off = 1e-13;
  const double minimum_length =
    edit.head && edit.tail ? 0.0 : round_off * (head.stableNorm() + inherited_vector.stableNorm());
  Eigen::Matrix3d linear = parent_transform.leftCols<3>();
  posed.stretch = 1.0;
  if (inherited_vector != Vec3::Zero() && bone.stableNorm() > minimum_length)
  {
    linear = minimal_rotation(inherited_vector, bone).toRotationMatrix() * linear;
    posed.stretch = bone.stableNorm() / inherited_vector.stableNorm();
  }
  posed.transform = affine_about(rest.head, linear, head - rest.head);
}

/// Pose one handle. The pose of its parent must be final.
void pose_handle(const HandleEdit* edit, bool children_follow, const Handles& handles,
  const Pose& base, Index handle, Pose& pose)
{
  const Handle& rest = handles[static_cast<std::size_t>(handle)];
  HandlePose& posed = pose[static_cast<std::size_t>(handle)];
  const bool with_parent = rest.parent >= 0 && (edit ? edit->with_parent : children_follow);
  if (edit && has_transform(*edit))
  {
    place_handle(*edit, rest,
      with_parent && children_follow ? inherited_transform(handles, pose, handle)
                                     : identity_affine(),
      posed);
  }
  else if (with_parent && children_follow)
  {
    follow_parent(handles, base, handle, pose);
  }
  if (with_parent && !children_follow)
  {
    const auto parent = static_cast<std::size_t>(rest.parent);
    // In version 1, the parent's transform is applied after the handle's own transform.
    posed.transform = compose(pose[parent].transform, posed.transform);
  }
  if (edit)
  {
    // The mode depends on the presence of keys, not on their values, because an expression for a
    // rotation may be zero at this time.
    const bool constrains_rotation =
      edit->rotation || edit->scale || edit->head || edit->tail || edit->stretch || edit->twist;
    const bool full = constrains_rotation && posed.mode == HandleMode::automatic;
    posed.mode = edit->mode.value_or(full ? HandleMode::full : posed.mode);
    posed.stretch = edit->stretch.value_or(posed.stretch);
    posed.twist = edit->twist.value_or(posed.twist);
  }
}
} // namespace

Pose apply_edits(const PoseEdits& edits, const Handles& handles, const Pose& base)
{
  std::vector<const HandleEdit*> edit_of(handles.size(), nullptr);
  for (const HandleEdit& edit : edits.handles)
  {
    edit_of[static_cast<std::size_t>(edit.handle)] = &edit;
  }
  Pose pose = base;
  for (const Index handle : parents_first(handles))
  {
    pose_handle(edit_of[static_cast<std::size_t>(handle)], edits.children_follow, handles, base,
      handle, pose);
  }
  return pose;
}

namespace
{
Json list(const Eigen::VectorXd& values)
{
  Json result = Json::array();
  for (const double value : values)
  {
    result.push_back(value);
  }
  return result;
}

/// The values by which a pose file describes a transform.
struct TransformNumbers
{
  TransformParts parts;
  double scale = 1.0; ///< uniform scale
  /// False if the transform has a shear, a non-uniform scale or a reflection, which a pose file
  /// cannot store.
  bool exact = true;
};

/// The file describes the linear part of a transform by a rotation and a uniform scale. If the
/// linear part differs from this description by at most this relative error, the difference is
/// treated as round-off. Transforms from glTF files are products of single-precision matrices and
/// have a relative error of about 1e-6. At this limit, a vertex at the distance of one bounding-box
/// diagonal from the pivot has an error of 1e-5 diagonals.
constexpr double pose_file_misfit = 1e-5;

TransformNumbers numbers_of(const Affine& transform, const Vec3& pivot)
{
  TransformNumbers numbers;
  numbers.parts = parts_of(transform, pivot);
  const double scale = numbers.parts.scale.trace() / 3.0;
  const Eigen::Matrix3d linear = transform.leftCols<3>();
  const double misfit = (linear - scale * numbers.parts.rotation).norm();
  numbers.exact = misfit <= pose_file_misfit * linear.norm() && scale > 0.0;
  numbers.scale = scale > 0.0 ? scale : 1.0;
  return numbers;
}

/// Return the JSON entry of handle `h`.
/// @param exact is set to false if the transform could only be written as its nearest rotation and
/// scale.
Json format_handle(const Pose& pose, const Handles& handles, std::size_t h, bool& exact)
{
  const HandlePose& posed = pose[h];
  const Handle& rest = handles[h];
  Json entry;
  entry["mode"] = to_string(posed.mode);
  TransformNumbers numbers = numbers_of(posed.transform, rest.head);
  if (rest.parent >= 0)
  {
    Affine parent_inverse;
    TransformNumbers to_parent;
    to_parent.exact =
      invert(inherited_transform(handles, pose, static_cast<Index>(h)), parent_inverse);
    if (to_parent.exact)
    {
      to_parent = numbers_of(compose(parent_inverse, posed.transform), rest.head);
    }
    if (to_parent.exact)
    {
      numbers = to_parent;
    }
    else
    {
      entry["space"] = "world";
    }
  }
  exact = numbers.exact;
  entry["translate"] = list(numbers.parts.translation);
  const Eigen::AngleAxisd angle_axis(numbers.parts.rotation);
  if (angle_axis.angle() != 0.0)
  {
    entry["rotate"] = { { "axis", list(angle_axis.axis()) },
      { "degrees", angle_axis.angle() * (180.0 / EIGEN_PI) } };
  }
  if (std::abs(numbers.scale - 1.0) > 1e-15)
  {
    entry["scale"] = numbers.scale;
  }
  if (posed.stretch != 1.0)
  {
    entry["stretch"] = posed.stretch;
  }
  if (posed.twist != Eigen::Vector2d::Zero())
  {
    entry["twist"] = list(posed.twist);
  }
  return entry;
}

/// Add one warning for all handles and poses that could not be written exactly.
void warn_of_inexact(const Handles& handles, const std::vector<char>& is_exact, Index inexact_poses,
  std::size_t pose_count, Status& status)
{
  std::vector<Index> inexact_handles;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    if (!is_exact[h])
    {
      inexact_handles.push_back(static_cast<Index>(h));
    }
  }
  if (inexact_handles.empty())
  {
    return;
  }
  const bool is_single = inexact_handles.size() == 1;
  const std::string subject = is_single ? "the transform of handle " : "the transforms of ";
  const std::string count = is_single ? "" : std::to_string(inexact_handles.size()) + " handles (";
  const std::string pose_phrase = pose_count == 1
    ? ""
    : " in " + std::to_string(inexact_poses) + " of " + std::to_string(pose_count) + " poses";
  status.warnings.push_back(subject + count + abbreviated_names(handles, inexact_handles) +
    (is_single ? "" : ")") + (is_single ? " has" : " have") +
    " a shear, a non-uniform scale or a reflection, which a pose file cannot store" + pose_phrase +
    "; the nearest rotation and scale were written");
}
} // namespace

namespace
{
/// Return invalid_input if a pose cannot be written as JSON, which has no infinity and no NaN.
Status check_writable(const Pose& pose, const Handles& handles)
{
  if (pose.size() != handles.size())
  {
    return Status::invalid_input("a pose has " + std::to_string(pose.size()) +
      " handles; expected " + std::to_string(handles.size()));
  }
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    const Status status = check_pose_values(handles[h], pose[h]);
    if (!status.ok())
    {
      return status;
    }
    const Vec3 pivot = pose[h].transform * handles[h].head.homogeneous();
    if (!pivot.allFinite())
    {
      return Status::invalid_input("the posed position of handle '" + handles[h].name +
        "' is not finite; reduce its translation or scale");
    }
  }
  return {};
}

Status name_is_not_utf8()
{
  return Status::invalid_input(
    "the name of a handle must be valid UTF-8 to be written to a pose file");
}

/// Report whether two poses of a handle are equal up to round-off.
bool is_same_pose(const HandlePose& a, const HandlePose& b, const Vec3& pivot)
{
  constexpr double round_off = 1e-12;
  const Eigen::Matrix3d linear = a.transform.leftCols<3>();
  const Vec3 translation = a.transform.col(3);
  const double length = translation.norm() + linear.norm() * pivot.norm();
  return a.mode == b.mode && a.stretch == b.stretch && a.twist == b.twist &&
    (linear - b.transform.leftCols<3>()).norm() <= round_off * linear.norm() &&
    (translation - b.transform.col(3)).norm() <= round_off * length;
}
} // namespace

Status format_pose_file(const std::vector<Pose>& poses, double frames_per_second,
  const Handles& handles, std::string& text)
{
  Status status;
  std::vector<char> is_exact(handles.size(), 1);
  Index inexact_poses = 0;
  Json frames = Json::array();
  for (const Pose& pose : poses)
  {
    const Status writable = check_writable(pose, handles);
    if (!writable.ok())
    {
      return writable;
    }
    bool is_exact_pose = true;
    Json frame;
    frame["handles"] = Json::object();
    for (std::size_t h = 0; h < handles.size(); ++h)
    {
      bool exact = true;
      frame["handles"][handles[h].name] = format_handle(pose, handles, h, exact);
      is_exact[h] = is_exact[h] && exact;
      is_exact_pose = is_exact_pose && exact;
    }
    inexact_poses += is_exact_pose ? 0 : 1;
    frames.push_back(std::move(frame));
  }
  if (frames.empty())
  {
    return Status::invalid_input("the sequence has no poses to write");
  }
  warn_of_inexact(handles, is_exact, inexact_poses, poses.size(), status);
  Json root;
  root["version"] = newest_version;
  if (frames.size() == 1)
  {
    root["handles"] = std::move(frames.front()["handles"]);
  }
  else
  {
    root["frames"] = std::move(frames);
    root["fps"] = frames_per_second;
  }
  try
  {
    text = root.dump(2) + "\n";
  }
  catch (const nlohmann::json::type_error&)
  {
    return name_is_not_utf8();
  }
  return status;
}

Status format_pose_changes(
  const Pose& base, const Pose& pose, const Handles& handles, std::string& text)
{
  text.clear();
  for (const Pose* checked : { &base, &pose })
  {
    const Status writable = check_writable(*checked, handles);
    if (!writable.ok())
    {
      return writable;
    }
  }
  Status status;
  std::vector<char> is_exact(handles.size(), 1);
  std::string entries;
  Pose followed = pose;
  try
  {
    for (std::size_t h = 0; h < handles.size(); ++h)
    {
      // Without an entry in the file, the handle gets its base pose, moved by its parent.
      followed[h] = base[h];
      if (handles[h].parent >= 0)
      {
        follow_parent(handles, base, static_cast<Index>(h), followed);
      }
      const bool is_followed = is_same_pose(followed[h], pose[h], handles[h].head);
      followed[h] = pose[h];
      if (!is_followed)
      {
        bool exact = true;
        Json entry = format_handle(pose, handles, h, exact);
        is_exact[h] = exact;
        // format_handle() omits values that equal those at rest. A reader would then take the value
        // of the base pose, so values that differ from the base pose are always written.
        if (pose[h].stretch != base[h].stretch)
        {
          entry["stretch"] = pose[h].stretch;
        }
        if (pose[h].twist != base[h].twist)
        {
          entry["twist"] = list(pose[h].twist);
        }
        entries +=
          (entries.empty() ? "\n  " : ",\n  ") + Json(handles[h].name).dump() + ": " + entry.dump();
      }
    }
  }
  catch (const nlohmann::json::type_error&)
  {
    return name_is_not_utf8();
  }
  if (!entries.empty())
  {
    text =
      "{\"version\": " + std::to_string(newest_version) + ", \"handles\": {" + entries + "\n}}";
  }
  warn_of_inexact(handles, is_exact, 1, 1, status);
  return status;
}

} // namespace bindpose
