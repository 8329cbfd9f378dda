// Choice of the modes of handles in mode `automatic`, for methods that compute rotations
// themselves. The chosen mode of a handle depends on its world transform and on its transform
// relative to its parent.
#include "pose/found_rotations.h"

#include "pose/handle_hierarchy.h"

namespace bindpose
{

namespace
{
// Tolerance for the entries of a transform: above the round-off of a relative transform, and far
// below any motion that a user specifies.
constexpr double identity_tolerance = 1e-12;

bool is_translation(const Affine& transform)
{
  return (transform.leftCols<3>() - Eigen::Matrix3d::Identity()).norm() < identity_tolerance;
}

/// Report whether a transform is the identity up to round-off.
/// @param size magnitude of the lengths in the scene
bool is_identity(const Affine& transform, double size)
{
  return is_translation(transform) && transform.col(3).norm() <= identity_tolerance * size;
}
} // namespace

Pose resolve_automatic_modes(const Handles& handles, const Pose& pose)
{
  const Pose relative = relative_pose(handles, pose);
  Pose result = pose;
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    if (pose[h].mode != HandleMode::automatic)
    {
      continue;
    }
    const HandleKind kind = handles[h].kind;
    const Affine& in_world = pose[h].transform;
    const Affine& to_parent = relative[h].transform;
    const double size = handles[h].tail.norm() + in_world.col(3).norm();
    const bool only_translates = (is_translation(in_world) || is_translation(to_parent)) &&
      pose[h].stretch == 1.0 && pose[h].twist == Eigen::Vector2d::Zero();
    const bool is_at_rest = is_identity(in_world, size) || is_identity(to_parent, size);
    const bool constrains_rotation =
      !only_translates || kind == HandleKind::region || (kind == HandleKind::bone && is_at_rest);
    result[h].mode = constrains_rotation ? HandleMode::full : HandleMode::position;
  }
  return result;
}

} // namespace bindpose
