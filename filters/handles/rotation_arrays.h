#ifndef rotation_arrays_h
#define rotation_arrays_h

#include "arap/arap_energy.h"

#include "vtkIntArray.h"
#include "vtkSmartPointer.h"

class vtkPointData;

namespace bindpose
{

/// Add two point arrays. RotationCluster is the index of the rotation that each vertex follows (-1:
/// none). Rotation is the rotation of each vertex as axis times angle in degrees.
/// @param clusters  the array RotationCluster; created if null and then reused, because all poses
/// of a bind have the same clusters
void add_rotations(const RotationGroups& groups, const std::vector<Eigen::Matrix3d>& rotations,
  vtkSmartPointer<vtkIntArray>& clusters, vtkPointData* data);

} // namespace bindpose

#endif
