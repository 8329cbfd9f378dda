#ifndef bindpose_pose_transform_parts_h
#define bindpose_pose_transform_parts_h

// Affine maps about a pivot, and their decomposition into translation, rotation and scale.

#include "pose/pose.h"

namespace bindpose
{

/// Return the affine map x -> pivot + translation + linear * (x - pivot).
Affine affine_about(const Vec3& pivot, const Eigen::Matrix3d& linear, const Vec3& translation);

/// The parts of a transform about a pivot c: x -> c + translation + rotation * scale * (x - c),
/// with the nearest rotation and a symmetric scale (polar decomposition). A reflection is part of
/// the scale.
struct TransformParts
{
  Vec3 translation = Vec3::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d scale = Eigen::Matrix3d::Identity();
};
TransformParts parts_of(const Affine& transform, const Vec3& pivot);
Affine affine_of(const TransformParts& parts, const Vec3& pivot);

/// Return the rotation with the smallest angle that turns the direction `from` to the direction
/// `to`. Both vectors must be nonzero. (Eigen's template takes five seconds to compile, so only
/// transform_parts.cpp instantiates it.)
Eigen::Quaterniond rotation_between(const Vec3& from, const Vec3& to);

/// Return the rotation axis times the rotation angle in degrees, 0 to 180.
Vec3 rotation_vector(const Eigen::Matrix3d& rotation);

} // namespace bindpose

#endif
