#ifndef pose_input_h
#define pose_input_h

#include "arap/arap_energy.h"
#include "conversion.h"

#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace bindpose
{

/// Mesh, weights, handles and pose in the types of the kernels, for the subclasses of
/// vtkBindAlgorithm. This input is valid only until Bind() or Execute() returns.
struct PoseInput
{
  vtkPointSet* mesh;
  PointsView points; ///< #V x 3, at rest
  WeightsView weights; ///< #V x #handles
  const Handles& handles;
  const Pose& pose;
  /// Handle dataset; it may also have cells that are not handles (pseudo-edges).
  vtkPolyData* handle_data;
  const std::vector<Index>& cells; ///< the cell of each handle in handle_data
};

/// Output of the subclasses of vtkPoseAlgorithm.
struct PosedPoints
{
  /// @param memory  destination of the points, #V x 3
  explicit PosedPoints(const Eigen::Map<Points>& memory) : points(memory) {}

  Eigen::Map<Points> points; ///< #V x 3
  /// The transforms that were used, one per handle. If empty, the output gets no array of
  /// transforms.
  std::vector<Affine> transforms;
  /// The groups of vertices that share a rotation, and one rotation per group. If `groups` is
  /// null, the output gets no arrays of rotations.
  const RotationGroups* groups = nullptr;
  std::vector<Eigen::Matrix3d> rotations;
};

} // namespace bindpose

#endif
