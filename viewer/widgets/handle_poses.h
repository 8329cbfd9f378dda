#ifndef handle_poses_h
#define handle_poses_h

#include "handle_data.h"

#include <vector>

namespace bindpose
{

/// A handle's own axes at rest, as columns: of a bone y along it; of all others the world's.
Eigen::Matrix3d rest_axes(const HandlePlace& place);
/// The same, turned with the pose.
Eigen::Matrix3d posed_axes(const HandlePlace& place);

/// Handles that move together: those that are grabbed and, below them by Parent, those that follow.
struct HandleGroup
{
  std::vector<vtkIdType> cells; ///< grabbed ones first
  std::size_t grabbed = 0; ///< how many are
  std::vector<HandleData::CellPose> start; ///< one a cell
};
/// @param descend  whether any follow
HandleGroup make_group(
  const std::vector<HandlePlace>& places, const std::vector<vtkIdType>& grabbed, bool descend);

/// What happens to the first grabbed handle of a group, beyond the motion of all.
struct GrabbedChange
{
  double factor = 1.0; ///< of its length
  Eigen::Vector2d twist = Eigen::Vector2d::Zero(); ///< degrees added at head and tail
  /// Whether that goes to Stretch and Twist, or into the transform.
  bool to_arrays = true;
};

/// Poses after a motion of the world. A handle whose mode is position goes with its pivot and does
/// not turn. If a bone stretches or twists, its followers move with the cross-section to which they
/// are attached, as in transform_for_child().
std::vector<HandleData::CellPose> moved_poses(const std::vector<HandlePlace>& places,
  const HandleGroup& group, const Eigen::Affine3d& motion, const GrabbedChange& change = {});

} // namespace bindpose

#endif
