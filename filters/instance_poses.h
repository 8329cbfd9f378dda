#ifndef instance_poses_h
#define instance_poses_h

#include "conversion.h"

class vtkDataObject;

namespace bindpose
{

/// Poses and placements of the instances of a crowd.
struct InstancePoses
{
  std::vector<Pose> poses; ///< one per instance
  std::vector<Affine> placements; ///< one per instance; empty: instances have no placement
};

/// Convert the poses of instances as documented in vtkCrowdDeformation: rows of a table, points, or
/// a composite of handle datasets. `base` is the pose of handles without an array. Return
/// invalid_input if there is no instance. Also return it, with instance and handle, for arrays of a
/// wrong size, an unknown mode, handles that differ from the input's, or values that are not
/// finite. A warning is issued if there is neither an array named after a handle nor a Mode array.
Status to_instance_poses(
  vtkDataObject* data, const Handles& handles, const Pose& base, InstancePoses& instances);

} // namespace bindpose

#endif
