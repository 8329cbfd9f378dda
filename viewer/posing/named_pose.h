#ifndef bindpose_posing_named_pose_h
#define bindpose_posing_named_pose_h

#include "pose/pose.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace bindpose
{

/// A stored pose. It identifies handles by name, so that it still fits after handles were added,
/// removed or reordered.
class NamedPose
{
public:
  NamedPose() = default;
  NamedPose(const Handles& handles, Pose pose);

  /// Return the pose of these handles. A handle that has no entry follows its parent from the base
  /// pose. The result has the size of the base pose.
  Pose of(const Handles& handles, const Pose& base) const;
  bool empty() const { return this->names_.empty(); }
  /// Rename a handle. An older entry with the new name is removed.
  void rename(const std::string& from, const std::string& to);

private:
  friend nlohmann::ordered_json to_json(const NamedPose& pose);
  friend Status from_json(const nlohmann::ordered_json& json, NamedPose& pose);

  std::vector<std::string> names_;
  Pose pose_;
};

/// {NAME: {"mode": "full", "transform": [12 numbers, 3x4 row by row], "stretch": 1, "twist": [0,
/// 0]}}. Unlike in a pose file, the numbers are exact. Missing fields have their rest values.
nlohmann::ordered_json to_json(const NamedPose& pose);
Status from_json(const nlohmann::ordered_json& json, NamedPose& pose);

} // namespace bindpose

#endif
