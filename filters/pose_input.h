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
  /// Handle dataset; it may also have cells that are not handles (pseudo-edges).
  vtkPolyData* handle_data;
  const std::vector<bindpose::Index>& cells; ///< the cell of each handle in handle_data
};

/// Output of the subclasses of vtkPoseAlgorithm.
struct vtkPoseAlgorithm::PosedPoints
{
  bindpose::Points points;
  /// The transforms that were used, one per handle. If empty, the output gets no array of
  /// transforms.
  std::vector<bindpose::Affine> transforms;
  /// The groups of vertices that share a rotation, and these rotations, if the filter adds them to
  /// the output; otherwise null and empty.
  const bindpose::RotationGroups* groups = nullptr;
  std::vector<Eigen::Matrix3d> rotations;
};

#endif
