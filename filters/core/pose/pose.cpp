// Checks and properties of poses: posed positions of pivots and tails, unused stretch and twist,
// validity of pose and mesh.
#include "pose/pose.h"

#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bindpose
{

const char* to_string(HandleMode mode)
{
  return handle_mode_words[static_cast<std::size_t>(mode)];
}

Vec3 posed_pivot(const Handle& handle, const HandlePose& pose)
{
  return pose.transform * handle.head.homogeneous();
}

Vec3 posed_tail(const Handle& handle, const HandlePose& pose)
{
  const Vec3 stretched = handle.head + pose.stretch * (handle.tail - handle.head);
  return pose.transform * stretched.homogeneous();
}

Pose to_frame(const WorkingFrame& frame, Pose pose)
{
  for (HandlePose& handle_pose : pose)
  {
    Affine& t = handle_pose.transform;
    t.col(3) = frame.scale() * (t.leftCols<3>() * frame.center() + t.col(3) - frame.center());
  }
  return pose;
}

Affine from_frame(const WorkingFrame& frame, const Affine& transform)
{
  Affine t = transform;
  if (frame.is_identity())
  {
    return t; // the sum below would change the sign of zeros
  }
  t.col(3) = t.col(3) / frame.scale() + frame.center() - t.leftCols<3>() * frame.center();
  return t;
}

Status check_pose_values(const Handle& handle, const HandlePose& pose)
{
  if (!pose.transform.allFinite() || !std::isfinite(pose.stretch) || !pose.twist.allFinite())
  {
    return Status::invalid_input("the transform, stretch or twist of handle '" + handle.name +
      "' contains a value that is not finite");
  }
  const double largest = std::max({ pose.transform.cwiseAbs().maxCoeff(), std::abs(pose.stretch),
    pose.twist.cwiseAbs().maxCoeff() });
  return largest <= largest_pose_value
    ? Status()
    : Status::invalid_input("the transform, stretch or twist of handle '" + handle.name +
        "' contains the value " + short_number(largest) + "; expected at most 1e102");
}

Status check_pose(const Handles& handles, const Pose& pose)
{
  if (pose.size() != handles.size() || pose.empty())
  {
    return Status::invalid_input("the pose has " + std::to_string(pose.size()) +
      " handles; expected " + std::to_string(handles.size()));
  }
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    const Status status = check_pose_values(handles[h], pose[h]);
    if (!status.ok())
    {
      return status;
    }
    if (constrains_tail(pose[h].mode) && handles[h].kind != HandleKind::bone)
    {
      return Status::invalid_input("the mode " + std::string(to_string(pose[h].mode)) +
        " of handle '" + handles[h].name + "' can only be used for bones");
    }
  }
  return {};
}

namespace
{
template <typename Elements>
Status check_elements(PointsView points, const Elements& elements, const Handles& handles)
{
  const Status status = check_mesh(points, elements);
  if (!status.ok())
  {
    return status;
  }
  if (!points.allFinite())
  {
    return Status::invalid_input(
      "the mesh has an unused point with a coordinate that is not finite");
  }
  if (elements.rows() == 0)
  {
    return Status::invalid_input("the mesh cannot be deformed because it has no elements");
  }
  return check_handles(handles);
}
} // namespace

Status check_mesh_and_handles(PointsView points, TrianglesView triangles, const Handles& handles)
{
  return check_elements(points, triangles, handles);
}

Status check_mesh_and_handles(PointsView points, TetsView tets, const Handles& handles)
{
  return check_elements(points, tets, handles);
}

std::string unused_stretch(const Pose& pose, StretchUse use)
{
  constexpr double same_length = 1e-6;
  constexpr double same_angle = 1e-4; // degrees; smaller twists count as zero
  const bool unused = std::any_of(pose.begin(), pose.end(),
    [use](const HandlePose& posed)
    {
      const bool ends = posed.mode == HandleMode::ends;
      const bool stretches = std::abs(posed.stretch - 1.0) > same_length &&
        (constrains_transform(posed.mode) || (ends && use != StretchUse::ends));
      const bool twists = posed.twist.cwiseAbs().maxCoeff() > same_angle &&
        (constrains_transform(posed.mode) || constrains_tail(posed.mode));
      return stretches || twists;
    });
  return unused && use != StretchUse::all ? "the pose stretches or twists bones, which this method "
                                            "ignores; use stretchable bones (stbs) instead"
                                          : "";
}

std::vector<HandleMode> modes_of(const Pose& pose)
{
  std::vector<HandleMode> modes;
  for (const HandlePose& handle : pose)
  {
    modes.push_back(handle.mode);
  }
  return modes;
}

bool same_modes(const std::vector<HandleMode>& modes, const Pose& pose)
{
  return std::equal(modes.begin(), modes.end(), pose.begin(), pose.end(),
    [](HandleMode mode, const HandlePose& handle) { return mode == handle.mode; });
}

} // namespace bindpose
