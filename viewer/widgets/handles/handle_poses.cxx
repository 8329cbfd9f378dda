#include "handle_poses.h"

#include "motion_about.h"

#include "handles/bone_projection.h"
#include "pose/transform_parts.h"

#include <Eigen/Geometry>

#include <algorithm>

using Eigen::Affine3d;
using Eigen::Matrix3d;

namespace bindpose
{
namespace
{
Affine compose(const Affine3d& motion, const Affine& transform)
{
  Affine moved = motion.linear() * transform;
  moved.col(3) += motion.translation();
  return moved;
}

/// Return the position on the first grabbed bone at which a follower is attached, directly or
/// through its ancestors: 0 at the bone's head, 1 at its tail. Followers are handles below the
/// grabbed handles in the hierarchy.
double attachment(
  const std::vector<HandleRecord>& records, const HandleGroup& group, vtkIdType cell)
{
  const HandleRecord& bone = records[static_cast<std::size_t>(group.cells.front())];
  vtkIdType child = cell;
  for (std::size_t step = 0; step < records.size(); ++step)
  {
    const vtkIdType parent = records[static_cast<std::size_t>(child)].parent;
    if (parent < 0 || parent == group.cells.front())
    {
      break;
    }
    child = parent;
  }
  return fraction_along_bone(records[static_cast<std::size_t>(child)].rest_head, bone.rest_head,
    bone.rest_tail - bone.rest_head);
}

Matrix3d axis_rotation(const Vec3& axis, double degrees)
{
  return Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, axis).toRotationMatrix();
}
} // namespace

Matrix3d rest_axes(const HandleRecord& record)
{
  Matrix3d axes = Matrix3d::Identity();
  const Vec3 bone = record.rest_tail - record.rest_head;
  if (record.is_bone() && bone.norm() > 0.0)
  {
    axes = minimal_rotation(Vec3::UnitY(), bone).toRotationMatrix();
  }
  return axes;
}

Matrix3d posed_axes(const HandleRecord& record)
{
  return parts_of(record.transform, record.rest_head).rotation * rest_axes(record);
}

HandleGroup make_group(const std::vector<HandleRecord>& records,
  const std::vector<vtkIdType>& grabbed, bool with_descendants)
{
  HandleGroup group;
  group.cells = grabbed;
  group.grabbed = grabbed.size();
  const auto count = static_cast<vtkIdType>(records.size());
  const auto is_grabbed = [&](vtkIdType cell)
  { return std::find(grabbed.begin(), grabbed.end(), cell) != grabbed.end(); };
  for (vtkIdType cell = 0; with_descendants && cell < count; ++cell)
  {
    // Walk up the hierarchy. The loop is bounded, in case the file contains a cycle of parents.
    vtkIdType ancestor = records[static_cast<std::size_t>(cell)].parent;
    for (vtkIdType step = 0; step < count && ancestor >= 0 && ancestor < count; ++step)
    {
      if (is_grabbed(ancestor))
      {
        if (!is_grabbed(cell))
        {
          group.cells.push_back(cell);
        }
        break;
      }
      ancestor = records[static_cast<std::size_t>(ancestor)].parent;
    }
  }
  for (const vtkIdType cell : group.cells)
  {
    const HandleRecord& record = records[static_cast<std::size_t>(cell)];
    group.start.push_back({ record.transform, record.stretch, record.twist });
  }
  return group;
}

std::vector<HandleData::CellPose> moved_poses(const std::vector<HandleRecord>& records,
  const HandleGroup& group, const Affine3d& motion, const GrabbedChange& change)
{
  std::vector<HandleData::CellPose> poses = group.start;
  if (group.cells.empty())
  {
    return poses;
  }
  const HandleRecord& bone = records[static_cast<std::size_t>(group.cells.front())];
  const Vec3 head = motion * bone.head;
  const Vec3 arm = motion.linear() * (bone.tail - bone.head);
  const bool is_bone = bone.is_bone() && arm.norm() > 0.0;
  const Vec3 axis = is_bone ? Vec3(arm.normalized()) : Vec3::UnitY();
  // Followers (the handles below the grabbed handles in the hierarchy) inherit stretch and twist as
  // in transform_for_child().
  const auto follower_motion = [&](vtkIdType cell)
  {
    const double fraction = attachment(records, group, cell);
    const double degrees = change.writes_arrays
      ? (1.0 - fraction) * change.twist[0] + fraction * change.twist[1]
      : change.twist.sum();
    Affine3d motion_there = motion_about(head, axis_rotation(axis, degrees));
    motion_there.translation() += fraction * (change.factor - 1.0) * arm;
    return motion_there;
  };
  for (std::size_t i = 0; i < group.cells.size(); ++i)
  {
    const HandleRecord& record = records[static_cast<std::size_t>(group.cells[i])];
    HandleData::CellPose& pose = poses[i];
    Affine3d total_motion =
      i < group.grabbed || !is_bone ? motion : Affine3d(follower_motion(group.cells[i]) * motion);
    if (i == 0 && is_bone && !change.writes_arrays)
    {
      const Matrix3d stretch_matrix =
        Matrix3d::Identity() + (change.factor - 1.0) * axis * axis.transpose();
      total_motion =
        motion_about(head, axis_rotation(axis, change.twist.sum()) * stretch_matrix) * motion;
    }
    if (record.only_moves())
    {
      pose.transform.col(3) += total_motion * record.head - record.head;
    }
    else
    {
      pose.transform = compose(total_motion, pose.transform);
    }
    if (i == 0 && is_bone && change.writes_arrays)
    {
      pose.stretch *= change.factor;
      pose.twist += change.twist;
    }
  }
  return poses;
}

} // namespace bindpose
