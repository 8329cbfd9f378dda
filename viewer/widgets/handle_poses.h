#ifndef handle_poses_h
#define handle_poses_h

#include "handle_data.h"

#include <vector>

namespace bindpose
{

/// Return a handle's own axes at rest, as columns: y along a bone, the world's axes for all other
/// handles.
Eigen::Matrix3d rest_axes(const HandlePlace& place);
/// Return the axes of rest_axes(), turned by the pose.
Eigen::Matrix3d posed_axes(const HandlePlace& place);

/// Handles that move together: the grabbed handles and their followers, which are below them by
/// Parent.
struct HandleGroup
{
  std::vector<vtkIdType> cells; ///< grabbed ones first
  std::size_t grabbed = 0; ///< number of grabbed handles
  std::vector<HandleData::CellPose> start; ///< one per cell
};
/// @param descend  true to include followers
HandleGroup make_group(
  const std::vector<HandlePlace>& places, const std::vector<vtkIdType>& grabbed, bool descend);

/// Changes to the first grabbed handle of a group, in addition to the common motion.
struct GrabbedChange
{
  double factor = 1.0; ///< factor on its length
  Eigen::Vector2d twist = Eigen::Vector2d::Zero(); ///< degrees added at head and tail
  /// True to write the changes to Stretch and Twist, else into the transform.
  bool to_arrays = true;
};

/// Return the poses after a motion in world coordinates. A handle whose mode is position moves with
/// its pivot and does not turn. If a bone stretches or twists, its followers move with the
/// cross-section to which they are attached, as in transform_for_child().
std::vector<HandleData::CellPose> moved_poses(const std::vector<HandlePlace>& places,
  const HandleGroup& group, const Eigen::Affine3d& motion, const GrabbedChange& change = {});

} // namespace bindpose

#endif
