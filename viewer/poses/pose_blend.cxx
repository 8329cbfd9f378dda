#include "poses/pose_blend.h"

#include "base/constants.h"
#include "pose/handle_hierarchy.h"
#include "pose/transform_parts.h"

#include <cmath>

namespace bindpose
{

namespace
{
Eigen::Matrix3d axis_rotation(double degrees, const Vec3& axis)
{
  return Eigen::AngleAxisd(degrees * pi / 180.0, axis).toRotationMatrix();
}
} // namespace

HandleValues values_of(const Handles& handles, const Pose& pose, std::size_t handle)
{
  const TransformParts parts =
    parts_of(relative_pose(handles, pose)[handle].transform, handles[handle].head);
  HandleValues values;
  values.translate = parts.translation;
  // The rotation is Rz(z) Ry(y) Rx(x) with angles x, y, z, so r(2, 0) = -sin(y).
  const Eigen::Matrix3d& r = parts.rotation;
  const double y = std::asin(std::fmax(-1.0, std::fmin(1.0, -r(2, 0))));
  const bool is_euler_unique = std::abs(r(2, 0)) < 1.0 - 1e-12;
  const double x = is_euler_unique ? std::atan2(r(2, 1), r(2, 2)) : std::atan2(-r(1, 2), r(1, 1));
  const double z = is_euler_unique ? std::atan2(r(1, 0), r(0, 0)) : 0.0;
  values.degrees = Vec3(x, y, z) * 180.0 / pi;
  values.scale = parts.scale.trace() / 3.0;
  values.is_approximate =
    (parts.scale - values.scale * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 1e-9;
  values.stretch = pose[handle].stretch;
  values.twist = pose[handle].twist;
  return values;
}

Pose with_values(
  const Handles& handles, const Pose& pose, std::size_t handle, const HandleValues& values)
{
  const Eigen::Matrix3d rotation = axis_rotation(values.degrees.z(), Vec3::UnitZ()) *
    axis_rotation(values.degrees.y(), Vec3::UnitY()) *
    axis_rotation(values.degrees.x(), Vec3::UnitX());
  Pose relative = relative_pose(handles, pose);
  relative[handle].transform =
    affine_about(handles[handle].head, values.scale * rotation, values.translate);
  Pose result = pose;
  result[handle].transform = absolute_pose(handles, relative)[handle].transform;
  result[handle].stretch = values.stretch;
  result[handle].twist = values.twist;
  for (const Index other : parents_first(handles))
  {
    if (other != static_cast<Index>(handle))
    {
      follow_parent(handles, pose, other, result);
    }
  }
  return result;
}

Pose blend_relative(const Handles& handles, const Pose& a, const Pose& b, double fraction)
{
  Pose result = a;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    const Vec3& pivot = handles[k].head;
    const TransformParts from = parts_of(a[k].transform, pivot);
    const TransformParts to = parts_of(b[k].transform, pivot);
    TransformParts blended;
    blended.translation = (1.0 - fraction) * from.translation + fraction * to.translation;
    blended.rotation = Eigen::Quaterniond(from.rotation)
                         .slerp(fraction, Eigen::Quaterniond(to.rotation))
                         .toRotationMatrix();
    blended.scale = (1.0 - fraction) * from.scale + fraction * to.scale;
    if (a[k].transform != b[k].transform)
    {
      result[k].transform = affine_of(blended, pivot);
    }
    result[k].stretch = (1.0 - fraction) * a[k].stretch + fraction * b[k].stretch;
    result[k].twist = (1.0 - fraction) * a[k].twist + fraction * b[k].twist;
  }
  return result;
}

Pose blend(const Handles& handles, const Pose& a, const Pose& b, double fraction)
{
  if (fraction <= 0.0 || fraction >= 1.0)
  {
    return fraction <= 0.0 ? a : b;
  }
  Pose result = absolute_pose(handles,
    blend_relative(handles, relative_pose(handles, a), relative_pose(handles, b), fraction));
  std::vector<bool> moves(handles.size(), false);
  for (const Index handle : parents_first(handles))
  {
    const auto h = static_cast<std::size_t>(handle);
    const Index parent = handles[h].parent;
    moves[h] = a[h].transform != b[h].transform || a[h].stretch != b[h].stretch ||
      a[h].twist != b[h].twist || (parent >= 0 && moves[static_cast<std::size_t>(parent)]);
    if (!moves[h])
    {
      result[h] = a[h];
    }
  }
  return result;
}

} // namespace bindpose
