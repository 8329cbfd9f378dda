// Polar decomposition of the linear part L of a transform. The rotation R nearest to L maximizes
// tr(R L^T). At the maximum R^T L is symmetric, because otherwise a small rotation would increase
// the trace.
#include "pose/transform_parts.h"

#include "pose/rotation_fit.h"

#include <Eigen/Geometry>

namespace bindpose
{

Affine affine_about(const Vec3& pivot, const Eigen::Matrix3d& linear, const Vec3& translation)
{
  Affine result;
  result.leftCols<3>() = linear;
  result.col(3) = translation + (pivot - linear * pivot);
  return result;
}

TransformParts parts_of(const Affine& transform, const Vec3& pivot)
{
  const Eigen::Matrix3d linear = transform.leftCols<3>();
  TransformParts parts;
  parts.translation = linear * pivot + transform.col(3) - pivot;
  if (linear != Eigen::Matrix3d::Identity()) // for the identity, the result must be exact
  {
    fit_rotation(linear.transpose(), parts.rotation);
    parts.scale = parts.rotation.transpose() * linear;
  }
  return parts;
}

Affine affine_of(const TransformParts& parts, const Vec3& pivot)
{
  return affine_about(pivot, parts.rotation * parts.scale, parts.translation);
}

Eigen::Quaterniond rotation_between(const Vec3& from, const Vec3& to)
{
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

Vec3 rotation_vector(const Eigen::Matrix3d& rotation)
{
  const Eigen::AngleAxisd angle_axis(rotation);
  return angle_axis.angle() * (180.0 / EIGEN_PI) * angle_axis.axis();
}

} // namespace bindpose
