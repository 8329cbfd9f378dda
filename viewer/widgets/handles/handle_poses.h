#ifndef handle_poses_h
#define handle_poses_h

#include "handle_data.h"

#include <vector>

namespace bindpose
{

/// Return a handle's own axes at rest, as columns. The y axis of a bone is along the bone; all
/// other handles have the world's axes.
Eigen::Matrix3d rest_axes(const HandleRecord& record);
/// Return the axes of rest_axes(), rotated by the pose.
Eigen::Matrix3d posed_axes(const HandleRecord& record);

/// Handles that move together: the grabbed handles and their followers, i.e. the handles below them
/// in the hierarchy of `Parent`.
struct HandleGroup
{
  std::vector<vtkIdType> cells; ///< cell ids; the grabbed handles come first
  std::size_t grabbed = 0; ///< number of grabbed handles
  std::vector<HandleData::CellPose> start; ///< pose of each cell at the start of the drag
};
/// Create a group from the grabbed handles.
/// @param with_descendants  true to include followers
HandleGroup make_group(const std::vector<HandleRecord>& records,
  const std::vector<vtkIdType>& grabbed, bool with_descendants);

/// Changes to the first grabbed handle of a group, in addition to the motion of the whole group.
struct GrabbedChange
{
  double factor = 1.0; ///< factor on the length of the first grabbed handle
  /// Twist angles in degrees that are added at head and tail.
  Eigen::Vector2d twist = Eigen::Vector2d::Zero();
  /// True: write the changes to the arrays Stretch and Twist. False: multiply them into the
  /// transform.
  bool writes_arrays = true;
};

/// Return the poses after a motion in world coordinates. A handle whose mode is position moves with
/// its pivot and does not rotate. If a bone stretches or twists, its followers move with the
/// cross-section to which they are attached, as in transform_for_child().
std::vector<HandleData::CellPose> moved_poses(const std::vector<HandleRecord>& records,
  const HandleGroup& group, const Eigen::Affine3d& motion, const GrabbedChange& change = {});

} // namespace bindpose

#endif
