#ifndef bindpose_tests_support_affines_h
#define bindpose_tests_support_affines_h

// Rotations and affine maps for tests of poses.

#include "base/constants.h"
#include "pose/transform_parts.h"

#include <Eigen/Geometry>

namespace bindpose::test
{

/// Return the rotation about an axis of any length.
inline Eigen::Matrix3d rotation(double degrees, const Vec3& axis)
{
  return Eigen::AngleAxisd(degrees * pi / 180.0, axis.normalized()).toRotationMatrix();
}

/// Return the map of p to linear * p + translation.
inline Affine affine(const Eigen::Matrix3d& linear, const Vec3& translation)
{
  Affine t;
  t.leftCols<3>() = linear;
  t.col(3) = translation;
  return t;
}

/// Return the map that rotates about the origin and then translates by `move`.
inline Affine rigid(double degrees, const Vec3& axis, const Vec3& move)
{
  return affine(rotation(degrees, axis), move);
}

inline Points moved(const Points& points, const Affine& t)
{
  Points result = points * t.leftCols<3>().transpose();
  result.rowwise() += t.col(3).transpose();
  return result;
}

} // namespace bindpose::test

#endif
