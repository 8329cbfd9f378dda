#ifndef instance_poses_h
#define instance_poses_h

#include "conversion.h"

class vtkDataObject;

namespace bindpose
{

/// What the instances of a crowd are told.
struct InstancePoses
{
  std::vector<Pose> poses; ///< one an instance
  std::vector<Affine> placements; ///< where it stands; empty: none is placed
};

/// Poses of instances as vtkCrowdDeformation documents them: rows of a table, points, or a
/// composite of handle datasets. `base` is the pose of what an instance is not told.
/// invalid_input, naming instance and handle: none at all, arrays of a wrong size, an unknown mode,
/// other handles, numbers that are not finite. A warning when no array is that of a handle.
Status to_instance_poses(
  vtkDataObject* data, const Handles& handles, const Pose& base, InstancePoses& instances);

} // namespace bindpose

#endif
