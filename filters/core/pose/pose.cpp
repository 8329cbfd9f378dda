#include "pose/pose.h"

#include <algorithm>

namespace bindpose
{

const char* to_string(HandleMode mode)
{
  switch (mode)
  {
    case HandleMode::position:
      return "position";
    case HandleMode::free:
      return "free";
    case HandleMode::full:
      break;
  }
  return "full";
}

Status check_pose(const Handles& handles, const Pose& pose)
{
  if (pose.size() != handles.size() || pose.empty())
  {
    return Status::invalid_input("the pose has " + std::to_string(pose.size()) +
      " handles, but there are " + std::to_string(handles.size()));
  }
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    if (!pose[h].transform.allFinite())
    {
      return Status::invalid_input(
        "the transform of handle '" + handles[h].name + "' has a number that is not finite");
    }
  }
  return {};
}

bool same_modes(const std::vector<HandleMode>& modes, const Pose& pose)
{
  return std::equal(modes.begin(), modes.end(), pose.begin(), pose.end(),
    [](HandleMode mode, const HandlePose& handle) { return mode == handle.mode; });
}

} // namespace bindpose
