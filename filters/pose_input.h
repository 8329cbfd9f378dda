#ifndef pose_input_h
#define pose_input_h

#include "conversion.h"
#include "pose/arap_energy.h"
#include "vtkPoseAlgorithm.h"

/// Input of the subclasses of vtkBindAlgorithm.
struct vtkBindAlgorithm::PoseInput
{
  vtkPointSet* mesh;
  bindpose::PointsView points; ///< #V x 3, at rest
  bindpose::WeightsView weights; ///< #V x #handles
  const bindpose::Handles& handles;
  const bindpose::Pose& pose;
  vtkPolyData* handle_data; ///< including cells that are not handles: pseudo-edges
  const std::vector<bindpose::Index>& cells; ///< cells of the handles in handle_data
};

/// Output of the subclasses of vtkPoseAlgorithm.
struct vtkPoseAlgorithm::PosedPoints
{
  bindpose::Points points;
  /// The transforms that were used, one per handle; if empty, none are attached to the output.
  std::vector<bindpose::Affine> transforms;
  /// The groups and rotations of the energy, if the filter attaches them; otherwise null and empty.
  const bindpose::RotationGroups* groups = nullptr;
  std::vector<Eigen::Matrix3d> rotations;
};

#endif
