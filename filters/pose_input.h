#ifndef pose_input_h
#define pose_input_h

#include "conversion.h"
#include "pose/arap_energy.h"
#include "vtkPoseAlgorithm.h"

/// What vtkBindAlgorithm hands to its subclasses.
struct vtkBindAlgorithm::PoseInput
{
  vtkPointSet* mesh;
  bindpose::PointsView points; ///< #V x 3, at rest
  bindpose::WeightsView weights; ///< #V x #handles
  const bindpose::Handles& handles;
  const bindpose::Pose& pose;
  vtkPolyData* handle_data; ///< with what is no handle: pseudo-edges
  const std::vector<bindpose::Index>& cells; ///< of the handles, in it
};

/// And vtkPoseAlgorithm to its own.
struct vtkPoseAlgorithm::PosedPoints
{
  bindpose::Points points;
  /// One a handle, as used; empty: none are attached to the output.
  std::vector<bindpose::Affine> transforms;
  /// Those that the energy was measured against, of whoever wants them attached; else empty.
  const bindpose::RotationGroups* groups = nullptr;
  std::vector<Eigen::Matrix3d> rotations;
};

#endif
