#ifndef bindpose_pose_pose_h
#define bindpose_pose_pose_h

#include "weights/handles.h"

#include <vector>

namespace bindpose
{

/// What of a handle the user fixes. The integers are those of the cell array Mode.
enum class HandleMode : int
{
  full = 0, ///< the whole transform
  position = 1, ///< where the pivot goes; rotation and scale are found
  free = 2 ///< nothing
};

/// "full", "position", "free".
const char* to_string(HandleMode mode);

/// x -> linear * x + translation as 3 x 4, rest to posed, absolute.
using Affine = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
inline Affine identity_affine()
{
  Affine t = Affine::Zero();
  t.leftCols<3>().setIdentity();
  return t;
}

/// Pose of one handle.
struct HandlePose
{
  HandleMode mode = HandleMode::full;
  Affine transform = identity_affine();
  double stretch = 1.0; ///< bones: posed length / rest length
  Eigen::Vector2d twist = Eigen::Vector2d::Zero(); ///< bones: degrees at head and tail
};

/// One HandlePose for each handle, in the order of the columns.
using Pose = std::vector<HandlePose>;

/// invalid_input for another number of entries than of handles, for none, and, naming the handle,
/// for a transform that is not finite.
Status check_pose(const Handles& handles, const Pose& pose);

/// What can be bound: invalid_input for check_mesh()'s reasons, a point that is not finite, no
/// element, and for check_handles()'s reasons.
Status check_bendable(PointsView points, TrianglesView triangles, const Handles& handles);
Status check_bendable(PointsView points, TetsView tets, const Handles& handles);

std::vector<HandleMode> modes_of(const Pose& pose);
/// Whether these are the modes of the pose.
bool same_modes(const std::vector<HandleMode>& modes, const Pose& pose);

} // namespace bindpose

#endif
