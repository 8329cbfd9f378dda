#ifndef instance_poses_h
#define instance_poses_h

#include "conversion.h"

class vtkDataObject;

namespace bindpose
{

/// Poses and placements of the instances of a crowd.
struct InstancePoses
{
  std::vector<Pose> poses; ///< the pose of each instance
  /// The placement of each instance; empty: instances have no placement.
  std::vector<Affine> placements;
};

/// Convert the poses of instances as documented in vtkCrowdDeformation: rows of a table, points, or
/// a composite of handle datasets. Handles without an array get their pose from `base`. Return
/// invalid_input if there is no instance. Also return it for arrays of a wrong size, an unknown
/// mode, handles that differ from the input's, or values that are not finite; the message names the
/// instance and the handle. A warning is issued if there is neither an array named after a handle
/// nor a Mode array.
Status to_instance_poses(
  vtkDataObject* data, const Handles& handles, const Pose& base, InstancePoses& instances);

} // namespace bindpose

#endif
