#ifndef bindpose_poser_pose_rotations_h
#define bindpose_poser_pose_rotations_h

#include "arap/arap_energy.h"
#include "poser/pose_source.h"

#include <memory>
#include <vector>

namespace bindpose
{

/// The rotations that an as-rigid-as-possible method has fitted, for display.
struct PoseRotations
{
  /// #V: index of the rotation that each surface point follows; -1: no rotation. Empty for full
  /// ARAP with the energy `elements`, whose rotations belong to elements. Each bind creates a new
  /// list, so a changed pointer means that the indices have changed.
  std::shared_ptr<const std::vector<Index>> cluster_of_point;
  std::vector<Eigen::Matrix3d> rotations;
};

/// Set `pose_rotations` to the rotations of the surface's points. A surface point follows the
/// rotation of its own group; with tets, it follows the group of the vertex that has the largest
/// barycentric coordinate in its tet. If `pose_rotations` already has groups, these groups are
/// kept; they must come from the same bind.
void update_rotations(const PoseSource& source, const RotationGroups& groups,
  const std::vector<Eigen::Matrix3d>& rotations, bool in_tets, PoseRotations& pose_rotations);

} // namespace bindpose

#endif
