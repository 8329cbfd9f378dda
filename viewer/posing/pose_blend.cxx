#include "posing/pose_blend.h"

#include "pose/transform_parts.h"

#include <cmath>

namespace bindpose
{

namespace
{
constexpr double pi = 3.14159265358979323846;

Eigen::Matrix3d turn(double degrees, const Vec3& axis)
{
  return Eigen::AngleAxisd(degrees * pi / 180.0, axis).toRotationMatrix();
}
} // namespace

HandleValues values_of(const Handle& handle, const HandlePose& pose)
{
  const TransformParts parts = parts_of(pose.transform, handle.head);
  HandleValues values;
  values.translate = parts.translation;
  // R = Rz Ry Rx: the turn about y shows in the last row.
  const Eigen::Matrix3d& r = parts.rotation;
  const double y = std::asin(std::fmax(-1.0, std::fmin(1.0, -r(2, 0))));
  const bool upright = std::abs(r(2, 0)) < 1.0 - 1e-12;
  const double x = upright ? std::atan2(r(2, 1), r(2, 2)) : std::atan2(-r(1, 2), r(1, 1));
  const double z = upright ? std::atan2(r(1, 0), r(0, 0)) : 0.0;
  values.degrees = Vec3(x, y, z) * 180.0 / pi;
  values.scale = parts.scale.trace() / 3.0;
  values.more =
    (parts.scale - values.scale * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 1e-9;
  values.stretch = pose.stretch;
  values.twist = pose.twist;
  return values;
}

HandlePose with_values(const Handle& handle, const HandlePose& pose, const HandleValues& values)
{
  HandlePose result = pose;
  const Eigen::Matrix3d rotation = turn(values.degrees.z(), Vec3::UnitZ()) *
    turn(values.degrees.y(), Vec3::UnitY()) * turn(values.degrees.x(), Vec3::UnitX());
  result.transform = affine_about(handle.head, values.scale * rotation, values.translate);
  result.stretch = values.stretch;
  result.twist = values.twist;
  return result;
}

Pose blend(const Handles& handles, const Pose& a, const Pose& b, double share)
{
  if (share <= 0.0 || share >= 1.0)
  {
    return share <= 0.0 ? a : b;
  }
  Pose result = a;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    const Vec3& pivot = handles[k].head;
    const TransformParts from = parts_of(a[k].transform, pivot);
    const TransformParts to = parts_of(b[k].transform, pivot);
    TransformParts between;
    between.translation = (1.0 - share) * from.translation + share * to.translation;
    between.rotation = Eigen::Quaterniond(from.rotation)
                         .slerp(share, Eigen::Quaterniond(to.rotation))
                         .toRotationMatrix();
    between.scale = (1.0 - share) * from.scale + share * to.scale;
    if (a[k].transform != b[k].transform)
    {
      result[k].transform = affine_of(between, pivot);
    }
    result[k].stretch = (1.0 - share) * a[k].stretch + share * b[k].stretch;
    result[k].twist = (1.0 - share) * a[k].twist + share * b[k].twist;
  }
  return result;
}

} // namespace bindpose
