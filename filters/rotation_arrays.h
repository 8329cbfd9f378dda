#ifndef rotation_arrays_h
#define rotation_arrays_h

#include "pose/arap_energy.h"

#include "vtkIntArray.h"
#include "vtkSmartPointer.h"

class vtkPointData;

namespace bindpose
{

/// Add the point arrays RotationCluster, the index of the rotation that each vertex follows (-1:
/// none), and Rotation, its axis times its angle in degrees.
/// @param clusters  the array RotationCluster; created if null, because it is the same for all
/// poses of a bind
void add_rotations(const RotationGroups& groups, const std::vector<Eigen::Matrix3d>& rotations,
  vtkSmartPointer<vtkIntArray>& clusters, vtkPointData* data);

} // namespace bindpose

#endif
