// Polar decomposition of the linear part L of a transform. The rotation R nearest to L maximizes
// tr(R L^T). At the maximum R^T L is symmetric, because otherwise a small rotation would increase
// the trace.
#include "pose/transform_parts.h"

#include "pose/rotation_fit.h"

#include <Eigen/Geometry>

#include <cmath>

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

Eigen::Quaterniond minimal_rotation(const Vec3& from, const Vec3& to)
{
  const Vec3 u = from.stableNormalized(), v = to.stableNormalized();
  if (u.isZero(0.0) || v.isZero(0.0) || u == v)
  {
    return Eigen::Quaterniond::Identity();
  }
  const Vec3 sum = u + v;
  Vec3 axis = u.cross(v);
  if (axis.isZero(0.0) && u.dot(v) > 0.0)
  {
    return Eigen::Quaterniond::Identity();
  }
  if (axis.isZero(0.0))
  {
    Index axis_index = 2;
    for (const Index k : { 1, 0 })
    {
      axis_index = std::abs(u[k]) < std::abs(u[axis_index]) ? k : axis_index;
    }
    axis = Vec3::Unit(axis_index) - u[axis_index] * u;
  }
  // The cosine and sine of half the angle are half the lengths of the sum and of the difference of
  // the unit vectors.
  Eigen::Quaterniond q;
  q.w() = 0.5 * sum.norm();
  q.vec() = 0.5 * (u - v).norm() * axis.stableNormalized();
  q.normalize();
  return q;
}

Vec3 rotation_vector(const Eigen::Matrix3d& rotation)
{
  const Eigen::AngleAxisd angle_axis(rotation);
  return angle_axis.angle() * (180.0 / EIGEN_PI) * angle_axis.axis();
}

} // namespace bindpose
