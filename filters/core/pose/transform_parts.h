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

/// Return the rotation by the smallest angle that maps the direction of `from` to the direction of
/// `to`. For opposite directions it is half a turn about an axis perpendicular to them. This axis
/// is the coordinate axis with the largest angle to the directions, projected to the plane
/// perpendicular to them. If several coordinate axes have the same angle, the last one is used, so
/// that flat shapes (z = const) rotate within their plane. Return the identity for a vector of
/// length zero.
Eigen::Quaterniond minimal_rotation(const Vec3& from, const Vec3& to);

/// Return the rotation axis times the rotation angle in degrees, 0 to 180.
Vec3 rotation_vector(const Eigen::Matrix3d& rotation);

} // namespace bindpose

#endif
