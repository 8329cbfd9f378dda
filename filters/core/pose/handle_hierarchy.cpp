#include "pose/handle_hierarchy.h"

#include "pose/transform_parts.h"
#include "weights/bone_projection.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>

namespace bindpose
{

std::vector<Index> parents_first(const Handles& handles)
{
  std::vector<Index> order;
  std::vector<bool> seen(handles.size(), false);
  std::vector<Index> chain;
  for (std::size_t start = 0; start < handles.size(); ++start)
  {
    chain.clear();
    for (auto h = static_cast<Index>(start); h >= 0 && !seen[static_cast<std::size_t>(h)];
         h = handles[static_cast<std::size_t>(h)].parent)
    {
      seen[static_cast<std::size_t>(h)] = true;
      chain.push_back(h);
    }
    order.insert(order.end(), chain.rbegin(), chain.rend());
  }
  return order;
}

Affine composed(const Affine& second, const Affine& first)
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

Affine transform_for_child(const Handle& parent, const HandlePose& posed, const Vec3& place)
{
  const Vec3 bone = parent.tail - parent.head;
  const bool changes = posed.stretch != 1.0 || posed.twist != Eigen::Vector2d::Zero();
  if (parent.kind != HandleKind::bone || !changes)
  {
    return posed.transform;
  }
  const double along = projected_endpoint(place, parent.head, bone);
  const double degrees = (1.0 - along) * posed.twist[0] + along * posed.twist[1];
  const Eigen::AngleAxisd turn(degrees * (EIGEN_PI / 180.0), bone.stableNormalized());
  return composed(posed.transform,
    affine_about(parent.head, turn.toRotationMatrix(), along * (posed.stretch - 1.0) * bone));
}

namespace
{
/// What the handle inherits from its parent; the identity for a root and if that is singular.
Affine above(const Handles& handles, const Pose& pose, std::size_t handle)
{
  const Index parent = handles[handle].parent;
  Affine up = identity_affine();
  if (parent >= 0)
  {
    const auto p = static_cast<std::size_t>(parent);
    up = transform_for_child(handles[p], pose[p], handles[handle].head);
  }
  Affine back;
  return invert(up, back) ? up : identity_affine();
}
} // namespace

Pose relative_pose(const Handles& handles, const Pose& pose)
{
  Pose relative = pose;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    Affine back = identity_affine();
    if (handles[h].parent >= 0 && invert(above(handles, pose, h), back))
    {
      relative[h].transform = composed(back, pose[h].transform);
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
    if (handles[h].parent >= 0)
    {
      pose[h].transform = composed(above(handles, pose, h), relative[h].transform);
    }
  }
  return pose;
}

void follow_parent(const Handles& handles, const Pose& base, Index handle, Pose& pose)
{
  const Handle& rest = handles[static_cast<std::size_t>(handle)];
  if (rest.parent < 0)
  {
    return;
  }
  const auto up = static_cast<std::size_t>(rest.parent);
  const Affine before = transform_for_child(handles[up], base[up], rest.head);
  const Affine now = transform_for_child(handles[up], pose[up], rest.head);
  if (now == before)
  {
    return;
  }
  Affine back;
  if (invert(before, back))
  {
    const auto h = static_cast<std::size_t>(handle);
    pose[h].transform = composed(now, composed(back, base[h].transform));
  }
}

} // namespace bindpose
