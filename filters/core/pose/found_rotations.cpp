#include "pose/found_rotations.h"

#include "pose/handle_hierarchy.h"

namespace bindpose
{

namespace
{
bool is_translation(const Affine& transform)
{
  // Above the rounding of a relative transform, far below any rotation that a user gives.
  constexpr double tolerance = 1e-12;
  return (transform.leftCols<3>() - Eigen::Matrix3d::Identity()).norm() < tolerance;
}
} // namespace

Pose with_found_rotations(const Handles& handles, const Pose& pose)
{
  const Pose relative = relative_pose(handles, pose);
  Pose result = pose;
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    if (pose[h].mode != HandleMode::automatic)
    {
      continue;
    }
    const bool moves = handles[h].kind != HandleKind::region && pose[h].stretch == 1.0 &&
      pose[h].twist == Eigen::Vector2d::Zero() &&
      (is_translation(pose[h].transform) || is_translation(relative[h].transform));
    result[h].mode = moves ? HandleMode::position : HandleMode::full;
  }
  return result;
}

} // namespace bindpose
