// Read motions from files, and report how they match handles (see motion_data.h).
#include "motion_data.h"

#include "file_kind.h"
#include "helper/guarded_import.h"
#include "pose/handle_hierarchy.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace bindpose
{

namespace
{
bool is_gltf(const std::string& path)
{
  return is_listed(file_extension(path), "glb gltf");
}

std::vector<MotionJoint> to_joints(const Handles& handles)
{
  std::vector<MotionJoint> joints;
  for (const Handle& handle : handles)
  {
    joints.push_back({ handle.name, handle.parent, handle.head });
  }
  return joints;
}

/// Report whether every joint is at its handle, within float round-off or 1e-4 of the diagonal.
bool are_at_handles(const Handles& handles, const std::vector<MotionJoint>& joints,
  const std::vector<Index>& joint_of_handle)
{
  Box box;
  double largest = 0.0;
  double distance = 0.0;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    box.add(handles[h].head);
    box.add(handles[h].tail);
    largest = std::max(largest, handles[h].head.cwiseAbs().maxCoeff());
    if (joint_of_handle[h] >= 0)
    {
      distance = std::max(distance, (handles[h].head - joints[joint_of_handle[h]].head).norm());
    }
  }
  constexpr double tolerance = 1e-4;
  constexpr double float_tolerance = 1e-6;
  return distance <= tolerance * box.diagonal() + float_tolerance * largest;
}

std::vector<Affine> transforms_of(const GltfMotion& motion, std::size_t frame)
{
  std::vector<Affine> transforms;
  for (std::size_t j = 0; j < motion.joints.size(); ++j)
  {
    const Eigen::Affine3d map = motion.frames[frame].posed[j] * motion.joints[j].rest.inverse();
    transforms.emplace_back(map.matrix().topRows<3>());
  }
  return transforms;
}

Status check_values(const std::string& path, const Handles& handles, const Pose& pose)
{
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    const Status status = check_pose_values(handles[h], pose[h]);
    if (!status.ok())
    {
      return Status::invalid_input(path + ": " + status.message);
    }
  }
  return {};
}

/// Report the handles and joints that have no partner.
/// @param is_listed_joint per joint: whether it is listed if it has no handle
Status report_match(const std::string& path, const Handles& handles,
  const std::vector<MotionJoint>& joints, const std::vector<Index>& joint_of_handle,
  const std::vector<char>& is_listed_joint)
{
  std::vector<std::string> handle_names, joint_names;
  std::vector<char> used(joints.size(), 0);
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    if (joint_of_handle[h] >= 0)
    {
      used[joint_of_handle[h]] = 1;
    }
    else
    {
      handle_names.push_back(handles[h].name);
    }
  }
  for (std::size_t j = 0; j < joints.size(); ++j)
  {
    if (!used[j] && is_listed_joint[j])
    {
      joint_names.push_back(joints[j].name);
    }
  }
  Status status = handle_names.size() < handles.size()
    ? Status()
    : Status::invalid_input(path + ": none of its joints has the name of a handle");
  status.report.set("handles_without_joint[]", handle_names);
  status.report.set("joints_without_handle[]", joint_names);
  return status;
}
} // namespace

Status MotionFile::read_motion(
  ExecutionContext& context, const std::string& path, GltfMotion& motion)
{
  motion = GltfMotion();
  if (is_gltf(path))
  {
    return read_gltf_motion(context, path, motion);
  }
  std::string bytes;
  const Status status = import_guarded(context, path, bytes);
  return status.ok() ? read_gltf_motion(path, std::move(bytes), motion) : status;
}

Status MotionFile::read(ExecutionContext& context, const std::string& path, HandleMotion& motion)
{
  motion = HandleMotion();
  if (is_gltf(path) && this->rig_.read(context, path).ok() &&
    !this->rig_.data().handle_list.empty())
  {
    motion.frames = static_cast<int>(this->rig_.data().poses.size());
    motion.frames_per_second = this->rig_.data().frames_per_second;
    return {};
  }
  const Status status = this->motion_.read(context, path);
  motion.frames = static_cast<int>(this->motion_.data().frames.size());
  motion.frames_per_second = this->motion_.data().frames_per_second;
  return status;
}

Status MotionFile::fit(
  ExecutionContext& context, const std::string& path, const Handles& handles, HandleMotion& motion)
{
  motion = HandleMotion();
  if (is_gltf(path))
  {
    const Status status = this->rig_.read(context, path);
    const Handles& list = this->rig_.data().handle_list;
    if (status.ok() && !list.empty())
    {
      const std::vector<MotionJoint> joints = to_joints(list);
      const std::vector<Index> joint_of_handle = joints_of_handles(handles, joints);
      if (are_at_handles(handles, joints, joint_of_handle))
      {
        Status fitted = this->fit_exactly(path, handles, joints, joint_of_handle, motion);
        fitted.warnings.insert(
          fitted.warnings.begin(), status.warnings.begin(), status.warnings.end());
        return fitted;
      }
    }
  }
  const Status status = this->motion_.read(context, path);
  return status.ok() ? this->retarget(path, handles, motion) : status;
}

Status MotionFile::fit_exactly(const std::string& path, const Handles& handles,
  const std::vector<MotionJoint>& joints, const std::vector<Index>& joint_of_handle,
  HandleMotion& motion) const
{
  const GltfData& data = this->rig_.data();
  Status status =
    report_match(path, handles, joints, joint_of_handle, std::vector<char>(joints.size(), 1));
  status.report.set("motion", "exact");
  if (!status.ok())
  {
    return status;
  }
  auto frames = std::make_shared<std::vector<Pose>>();
  if (data.poses.empty())
  {
    // The pose from the transforms of the nodes.
    std::vector<Index> cells;
    Handles list;
    frames->resize(1);
    Status posed = to_handles(data.handles, list, &cells);
    posed = posed.ok() ? to_pose(data.handles, list, cells, frames->front()) : posed;
    if (!posed.ok())
    {
      return posed;
    }
  }
  motion.sequence = !data.poses.empty();
  motion.frames = motion.sequence ? static_cast<int>(data.poses.size()) : 1;
  motion.frames_per_second = data.frames_per_second;
  motion.pose = [handles, joint_of_handle, frames, &data](const Pose& base, int frame, Pose& pose)
  {
    const Pose& joint_pose = frames->empty() ? data.poses[frame] : frames->front();
    pose = base;
    for (const Index h : parents_first(handles))
    {
      if (joint_of_handle[h] < 0)
      {
        follow_parent(handles, base, h, pose);
        continue;
      }
      pose[h].mode = HandleMode::full;
      pose[h].transform = joint_pose[joint_of_handle[h]].transform;
    }
    return Status();
  };
  return status;
}

Status MotionFile::retarget(
  const std::string& path, const Handles& handles, HandleMotion& motion) const
{
  const GltfMotion& data = this->motion_.data();
  if (data.frames.empty())
  {
    return Status::invalid_input(path +
      " has no skin with the joints of the handles and no "
      "animation, and therefore no pose");
  }
  std::vector<MotionJoint> joints;
  for (const GltfJoint& joint : data.joints)
  {
    joints.push_back({ joint.name, joint.parent, joint.rest.translation() });
  }
  const auto retarget = std::make_shared<Retarget>(handles, joints);
  Status status = report_match(path, handles, joints, retarget->joint_of_handle(), data.animated);
  status.report.set("motion", "retargeted");
  if (!status.ok())
  {
    return status;
  }
  const std::vector<Index> unmatched = retarget->handles_without_joint();
  if (!unmatched.empty())
  {
    status.warnings.push_back(path + ": " + std::to_string(unmatched.size()) + " of " +
      std::to_string(handles.size()) +
      " handles have no joint of the same name and keep their pose relative to their parents: " +
      abbreviated_names(handles, unmatched));
  }
  if (data.animations > 1)
  {
    status.warnings.push_back(path + ": only the first of " + std::to_string(data.animations) +
      " animations that moves joints is used, '" + data.animation + "'");
  }
  motion.sequence = true;
  motion.frames = static_cast<int>(data.frames.size());
  motion.frames_per_second = data.frames_per_second;
  motion.pose = [path, handles, retarget, first = transforms_of(data, 0), &data](
                  const Pose& base, int frame, Pose& pose)
  {
    pose = retarget->apply(base, transforms_of(data, static_cast<std::size_t>(frame)), first);
    return check_values(path, handles, pose);
  };
  return status;
}

} // namespace bindpose
