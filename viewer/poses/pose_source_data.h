#ifndef bindpose_poses_pose_source_data_h
#define bindpose_poses_pose_source_data_h

#include "poser/pose_source.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace bindpose
{

/// Create the source from datasets. Return invalid_input for a surface, handles or weights that the
/// filters reject: an invalid surface, invalid handles, weights that do not match the handles,
/// endpoint weights outside [0, 1].
/// @param tets  tets with the point array Weights; may be null. Invalid tets, and tets whose
/// weights do not match the handles, are ignored.
Status to_pose_source(
  vtkPolyData* surface, vtkUnstructuredGrid* tets, vtkPolyData* handles, PoseSource& source);

} // namespace bindpose

#endif
