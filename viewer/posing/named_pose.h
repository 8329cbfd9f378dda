#ifndef bindpose_posing_named_pose_h
#define bindpose_posing_named_pose_h

#include "pose/pose.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace bindpose
{

/// A pose that is kept: it knows its handles by their names, so that it still fits when handles
/// were added, removed or put in another order.
class NamedPose
{
public:
  NamedPose() = default;
  NamedPose(const Handles& handles, Pose pose);

  /// Return the pose of these handles. Handles that it does not know follow their parents from the
  /// base pose. The result has the size of the base pose.
  Pose of(const Handles& handles, const Pose& base) const;
  bool empty() const { return this->names_.empty(); }
  /// The handle has another name now. What the pose knows of a handle that had it before goes.
  void rename(const std::string& from, const std::string& to);

private:
  friend nlohmann::ordered_json to_json(const NamedPose& pose);
  friend Status from_json(const nlohmann::ordered_json& json, NamedPose& pose);

  std::vector<std::string> names_;
  Pose pose_;
};

/// {NAME: {"mode": "full", "transform": [12 numbers, 3x4 row by row], "stretch": 1, "twist": [0,
/// 0]}}: exact, what a pose file is not. What is missing is rest.
nlohmann::ordered_json to_json(const NamedPose& pose);
Status from_json(const nlohmann::ordered_json& json, NamedPose& pose);

} // namespace bindpose

#endif
