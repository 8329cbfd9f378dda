#ifndef bindpose_posing_pose_rotations_h
#define bindpose_posing_pose_rotations_h

#include "pose/arap_energy.h"
#include "posing/pose_source.h"

#include <memory>
#include <vector>

namespace bindpose
{

/// What a method turns the shape by.
struct PoseRotations
{
  /// Which rotation each point of the surface follows, -1 for none; another object for another
  /// bind.
  std::shared_ptr<const std::vector<Index>> of_point;
  std::vector<Eigen::Matrix3d> rotations;
};

/// Rotations for the points of the surface: each follows its own group, or in tets that of the
/// vertex nearest to it in its tet. Who has taken some of the same bind has the groups already.
void take_rotations(const PoseSource& source, const RotationGroups& groups,
  const std::vector<Eigen::Matrix3d>& rotations, bool in_tets, PoseRotations& taken);

} // namespace bindpose

#endif
