// Transforms that handles inherit from their parents, and conversion between world and
// parent-relative poses.
#include "pose/handle_hierarchy.h"

#include "handles/bone_projection.h"
#include "pose/transform_parts.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace bindpose
{

std::vector<Index> parents_first(const Handles& handles)
{
  std::vector<Index> order;
  std::vector<bool> visited(handles.size(), false);
  std::vector<Index> chain;
  for (std::size_t start = 0; start < handles.size(); ++start)
  {
    chain.clear();
    for (auto h = static_cast<Index>(start); h >= 0 && !visited[static_cast<std::size_t>(h)];
         h = handles[static_cast<std::size_t>(h)].parent)
    {
      visited[static_cast<std::size_t>(h)] = true;
      chain.push_back(h);
    }
    order.insert(order.end(), chain.rbegin(), chain.rend());
  }
  return order;
}

Affine compose(const Affine& second, const Affine& first)
{
  Affine result;
  result.leftCols<3>() = second.leftCols<3>() * first.leftCols<3>();
  result.col(3) = second.leftCols<3>() * first.col(3) + second.col(3);
  return result;
}

bool invert(const Affine& transform, Affine& inverse)
{
  const Eigen::FullPivLU<Eigen::Matrix3d> linear(transform.leftCols<3>());
  if (!linear.isInvertible())
  {
    return false;
  }
  inverse.leftCols<3>() = linear.inverse();
  inverse.col(3) = -inverse.leftCols<3>() * transform.col(3);
  return true;
}

Affine transform_for_child(const Handle& parent, const HandlePose& posed, const Vec3& position)
{
  const Vec3 bone = parent.tail - parent.head;
  const bool changes = posed.stretch != 1.0 || posed.twist != Eigen::Vector2d::Zero();
  if (parent.kind != HandleKind::bone || !changes)
  {
    return posed.transform;
  }
  const double fraction = fraction_along_bone(position, parent.head, bone);
  const double degrees = (1.0 - fraction) * posed.twist[0] + fraction * posed.twist[1];
  const Eigen::AngleAxisd angle_axis(degrees * (EIGEN_PI / 180.0), bone.stableNormalized());
  return compose(posed.transform,
    affine_about(
      parent.head, angle_axis.toRotationMatrix(), fraction * (posed.stretch - 1.0) * bone));
}

Affine inherited_transform(const Handles& handles, const Pose& pose, Index handle)
{
  const Handle& rest = handles[static_cast<std::size_t>(handle)];
  if (rest.parent < 0)
  {
    return identity_affine();
  }
  const auto parent = static_cast<std::size_t>(rest.parent);
  return transform_for_child(handles[parent], pose[parent], rest.head);
}

Pose relative_pose(const Handles& handles, const Pose& pose)
{
  Pose relative = pose;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    Affine inverse;
    if (handles[h].parent >= 0 &&
      invert(inherited_transform(handles, pose, static_cast<Index>(h)), inverse))
    {
      relative[h].transform = compose(inverse, pose[h].transform);
    }
  }
  return relative;
}

Pose absolute_pose(const Handles& handles, const Pose& relative)
{
  Pose pose = relative;
  for (const Index handle : parents_first(handles))
  {
    const auto h = static_cast<std::size_t>(handle);
    const Affine inherited = inherited_transform(handles, pose, handle);
    Affine inverse;
    if (handles[h].parent >= 0 && invert(inherited, inverse))
    {
      pose[h].transform = compose(inherited, relative[h].transform);
    }
  }
  return pose;
}

void follow_parent(const Handles& handles, const Pose& base, Index handle, Pose& pose)
{
  const Affine before = inherited_transform(handles, base, handle);
  const Affine inherited_after = inherited_transform(handles, pose, handle);
  Affine inverse;
  if (inherited_after != before && invert(before, inverse))
  {
    const auto h = static_cast<std::size_t>(handle);
    pose[h].transform = compose(inherited_after, compose(inverse, base[h].transform));
  }
}

} // namespace bindpose
