// The member functions of vtkHandleSetRepresentation that read and set the translation, rotation,
// scale, stretch and twist of a handle. Each setter splits the transform, replaces one part and
// combines the parts again.
#include "handle_set_state.h"
#include "pose/transform_parts.h"
#include "vtkHandleSetRepresentation.h"

#include "vtkMath.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

using bindpose::Affine;
using bindpose::HandleRecord;
using Eigen::Vector2d;
using Eigen::Vector3d;

bool vtkHandleSetRepresentation::WriteHandle(vtkIdType handle, const HandleRecord& posed)
{
  const std::vector<HandleRecord> records = this->Internal->Data.records();
  if (!this->Internal->Data.exists(handle) || this->GetDragRefusal(handle) == IS_LOCKED ||
    !records[static_cast<std::size_t>(handle)].is_handle() || !posed.transform.allFinite())
  {
    return false;
  }
  const HandleRecord& before = records[static_cast<std::size_t>(handle)];
  const bindpose::HandleGroup group =
    bindpose::make_group(records, { handle }, this->MoveDescendants != 0);
  // The descendants of the handle move by the motion from the old to the new transform. The handle
  // itself gets exactly the values that were set.
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  const Eigen::Matrix3d inverse = before.transform.leftCols<3>().inverse();
  if (posed.transform != before.transform && inverse.allFinite())
  {
    motion.linear() = posed.transform.leftCols<3>() * inverse;
    motion.translation() = posed.transform.col(3) - motion.linear() * before.transform.col(3);
  }
  const double factor = before.stretch != 0.0 ? posed.stretch / before.stretch : 1.0;
  std::vector<bindpose::HandleData::CellPose> poses =
    bindpose::moved_poses(records, group, motion, { factor, posed.twist - before.twist, true });
  poses.front() = { posed.transform, posed.stretch, posed.twist };
  this->Internal->Data.set_poses(group.cells, poses);
  this->Modified();
  return true;
}

bool vtkHandleSetRepresentation::SetHandleTranslation(vtkIdType handle, const double translation[3])
{
  HandleRecord record = this->Internal->Data.record(handle);
  const Affine linear = record.transform;
  record.transform.col(3) =
    record.rest_head + Vector3d(translation) - linear.leftCols<3>() * record.rest_head;
  return this->WriteHandle(handle, record);
}

bool vtkHandleSetRepresentation::SetHandleRotation(
  vtkIdType handle, const double axis[3], double degrees)
{
  HandleRecord record = this->Internal->Data.record(handle);
  bindpose::TransformParts parts = bindpose::parts_of(record.transform, record.rest_head);
  const double length = Vector3d(axis).norm();
  if (!(length > 0.0))
  {
    return false;
  }
  parts.rotation = Eigen::AngleAxisd(vtkMath::RadiansFromDegrees(degrees), Vector3d(axis) / length)
                     .toRotationMatrix();
  record.transform = bindpose::affine_of(parts, record.rest_head);
  return this->WriteHandle(handle, record);
}

bool vtkHandleSetRepresentation::SetHandleScale(vtkIdType handle, const double factors[3])
{
  HandleRecord record = this->Internal->Data.record(handle);
  bindpose::TransformParts parts = bindpose::parts_of(record.transform, record.rest_head);
  const Eigen::Matrix3d axes = bindpose::rest_axes(record);
  const Vector3d scale(factors);
  if ((scale.array() == 0.0).any())
  {
    return false;
  }
  parts.scale = axes * scale.asDiagonal() * axes.transpose();
  if (scale[0] == scale[1] && scale[1] == scale[2])
  {
    parts.scale = scale[0] * Eigen::Matrix3d::Identity(); // exact, without round-off
  }
  record.transform = bindpose::affine_of(parts, record.rest_head);
  return this->WriteHandle(handle, record);
}

bool vtkHandleSetRepresentation::SetHandleScale(vtkIdType handle, double factor)
{
  const double factors[3] = { factor, factor, factor };
  return this->SetHandleScale(handle, factors);
}

bool vtkHandleSetRepresentation::SetHandleStretch(vtkIdType handle, double ratio)
{
  HandleRecord record = this->Internal->Data.record(handle);
  record.stretch = ratio;
  return ratio > 0.0 && std::isfinite(ratio) && record.is_bone() &&
    this->WriteHandle(handle, record);
}

bool vtkHandleSetRepresentation::SetHandleTwist(
  vtkIdType handle, double headDegrees, double tailDegrees)
{
  HandleRecord record = this->Internal->Data.record(handle);
  record.twist = Vector2d(headDegrees, tailDegrees);
  return record.twist.allFinite() && record.is_bone() && this->WriteHandle(handle, record);
}

bool vtkHandleSetRepresentation::ResetHandle(vtkIdType handle)
{
  HandleRecord record = this->Internal->Data.record(handle);
  record.transform = bindpose::identity_affine();
  record.stretch = 1.0;
  record.twist.setZero();
  return this->WriteHandle(handle, record);
}

void vtkHandleSetRepresentation::GetHandleTranslation(vtkIdType handle, double translation[3])
{
  const HandleRecord record = this->Internal->Data.record(handle);
  const Vector3d moved = bindpose::parts_of(record.transform, record.rest_head).translation;
  std::copy_n(moved.data(), 3, translation);
}

double vtkHandleSetRepresentation::GetHandleRotation(vtkIdType handle, double axis[3])
{
  const HandleRecord record = this->Internal->Data.record(handle);
  const Eigen::AngleAxisd turned(bindpose::parts_of(record.transform, record.rest_head).rotation);
  std::copy_n(turned.axis().data(), 3, axis);
  return vtkMath::DegreesFromRadians(turned.angle());
}

void vtkHandleSetRepresentation::GetHandleScale(vtkIdType handle, double factors[3])
{
  const HandleRecord record = this->Internal->Data.record(handle);
  const Eigen::Matrix3d axes = bindpose::rest_axes(record);
  const Vector3d scale =
    (axes.transpose() * bindpose::parts_of(record.transform, record.rest_head).scale * axes)
      .diagonal();
  std::copy_n(scale.data(), 3, factors);
}

double vtkHandleSetRepresentation::GetHandleStretch(vtkIdType handle)
{
  return this->Internal->Data.record(handle).stretch;
}

void vtkHandleSetRepresentation::GetHandleTwist(vtkIdType handle, double degrees[2])
{
  std::copy_n(this->Internal->Data.record(handle).twist.data(), 2, degrees);
}
