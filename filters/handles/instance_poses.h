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
/// a composite of handle datasets. `base` is the pose of handles without an array. Return
/// invalid_input if there is no instance. Also return it, with a message that names the instance
/// and the handle, for arrays of a wrong size, an unknown mode, handles that differ from the
/// input's, or values that are not finite. A warning is issued if there is neither an array named
/// after a handle nor a Mode array.
Status to_instance_poses(
  vtkDataObject* data, const Handles& handles, const Pose& base, InstancePoses& instances);

} // namespace bindpose

#endif
