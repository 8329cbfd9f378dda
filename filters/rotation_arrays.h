#ifndef rotation_arrays_h
#define rotation_arrays_h

#include "pose/arap_energy.h"

#include "vtkIntArray.h"
#include "vtkSmartPointer.h"

class vtkPointData;

namespace bindpose
{

/// Adds the point arrays RotationCluster, which rotation each vertex follows (-1: none), and
/// Rotation, its axis times its angle in degrees.
/// @param clusters  the first, made where it is null: it is the same for all poses of a bind
void add_rotations(const RotationGroups& groups, const std::vector<Eigen::Matrix3d>& rotations,
  vtkSmartPointer<vtkIntArray>& clusters, vtkPointData* data);

} // namespace bindpose

#endif
