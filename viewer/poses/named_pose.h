#ifndef bindpose_poses_named_pose_h
#define bindpose_poses_named_pose_h

#include "pose/pose.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace bindpose
{

/// A stored pose. It identifies handles by name, so that it is still usable after handles were
/// added, removed or reordered.
class NamedPose
{
public:
  NamedPose() = default;
  NamedPose(const Handles& handles, Pose pose);

  /// Return the pose of these handles. A handle without an entry follows its parent: its transform
  /// relative to the parent is the same as in `base`. The result has as many entries as `base`.
  Pose for_handles(const Handles& handles, const Pose& base) const;
  bool empty() const { return this->names_.empty(); }
  /// Rename a handle. If the pose has an entry with the new name, that entry is removed.
  void rename(const std::string& from, const std::string& to);

private:
  friend nlohmann::ordered_json to_json(const NamedPose& pose);
  friend Status from_json(const nlohmann::ordered_json& json, NamedPose& pose);

  std::vector<std::string> names_;
  Pose pose_;
};

/// Return {NAME: {"mode": "full", "transform": [12 numbers, 3x4 row by row], "stretch": 1, "twist":
/// [0, 0]}}. Numbers are written with full precision, unlike in a pose file. A reader gives a
/// missing field its value at rest.
nlohmann::ordered_json to_json(const NamedPose& pose);
Status from_json(const nlohmann::ordered_json& json, NamedPose& pose);

} // namespace bindpose

#endif
