// Poses from matrices in the layout of libigl. The layout follows from the size: transforms in a
// plane have two columns, transforms in space three columns, and rotations one column.
#include "pose/pose_matrix.h"

#include "pose/handle_hierarchy.h"
#include "pose/transform_parts.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace bindpose
{

namespace
{
/// Read transposed transforms that are stored one below the other.
void read_transforms(WeightsView matrix, Pose& pose)
{
  const Index d = matrix.cols();
  for (Index h = 0; h < static_cast<Index>(pose.size()); ++h)
  {
    Affine& transform = pose[static_cast<std::size_t>(h)].transform;
    const auto block = matrix.middleRows((d + 1) * h, d + 1);
    transform.topLeftCorner(d, d) = block.topRows(d).transpose();
    transform.col(3).head(d) = block.row(d).transpose();
  }
}

/// Return the parent of a handle; -1: no parent. If a bone has no parent, the first bone that ends
/// at the head of this bone counts as the parent.
Index parent_of(const Handles& handles, std::size_t h)
{
  if (handles[h].parent >= 0 || handles[h].kind != HandleKind::bone)
  {
    return handles[h].parent;
  }
  const auto parent_bone = std::find_if(handles.begin(), handles.end(),
    [&](const Handle& other)
    { return other.kind == HandleKind::bone && other.tail == handles[h].head; });
  return parent_bone != handles.end() ? parent_bone - handles.begin() : -1;
}

/// Compute the transform of a bone: its rotation, followed by the transform of its parent. This
/// function calls itself for the parent. In a cycle of parents, the bone of the outermost call is
/// the root.
const Affine& follow(const std::vector<Eigen::Matrix3d>& rotations, const Handles& handles,
  std::size_t h, std::vector<char>& done, Pose& pose)
{
  Affine& transform = pose[h].transform;
  if (!done[h])
  {
    done[h] = 1;
    transform = affine_about(handles[h].head, rotations[h], Vec3::Zero());
    const Index parent = parent_of(handles, h);
    if (parent >= 0)
    {
      const Affine parent_transform =
        follow(rotations, handles, static_cast<std::size_t>(parent), done, pose);
      transform = compose(parent_transform, transform);
    }
  }
  return transform;
}

std::string size_of(Index rows, Index cols)
{
  return std::to_string(rows) + " x " + std::to_string(cols);
}
} // namespace

Status pose_of_matrix(WeightsView matrix, const Handles& handles, Pose& pose)
{
  const auto count = static_cast<Index>(handles.size());
  Index bones = 0;
  for (const Handle& handle : handles)
  {
    bones += handle.kind == HandleKind::bone ? 1 : 0;
  }
  if (!matrix.allFinite())
  {
    return Status::invalid_input("the pose contains a value that is not finite");
  }
  const bool transforms =
    (matrix.cols() == 2 || matrix.cols() == 3) && matrix.rows() == (matrix.cols() + 1) * count;
  const bool rotations = matrix.cols() == 1 && bones > 0 && matrix.rows() == 4 * bones;
  if (!transforms && !rotations)
  {
    return Status::invalid_input("the pose is a matrix of size " +
      size_of(matrix.rows(), matrix.cols()) + "; for " + std::to_string(count) +
      " handles it must be " + size_of(4 * count, 3) + ", or in the plane " +
      size_of(3 * count, 2) + " (transposed transforms)" +
      (bones > 0 ? ", or " + size_of(4 * bones, 1) + " (rotations of the bones)" : ""));
  }
  pose.assign(handles.size(), HandlePose());
  if (transforms)
  {
    read_transforms(matrix, pose);
    return {};
  }
  std::vector<Eigen::Matrix3d> joint_rotations(handles.size(), Eigen::Matrix3d::Identity());
  Index bone = 0;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    if (handles[h].kind != HandleKind::bone)
    {
      continue;
    }
    Eigen::Quaterniond q;
    q.coeffs() = matrix.col(0).segment<4>(4 * bone++); // quaternion in the order x, y, z, w
    const double length = q.coeffs().stableNorm();
    if (!(length > 0.0))
    {
      return Status::invalid_input(
        "the quaternion of bone '" + handles[h].name + "' has length zero");
    }
    q.coeffs() /= length;
    joint_rotations[h] = q.toRotationMatrix();
  }
  std::vector<char> done(handles.size(), 0);
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    follow(joint_rotations, handles, h, done, pose);
  }
  return {};
}

} // namespace bindpose
