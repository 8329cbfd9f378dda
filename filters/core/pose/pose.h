#ifndef bindpose_pose_pose_h
#define bindpose_pose_pose_h

// A pose of a shape: one transform and one mode per handle, and checks of poses.

#include "handles/handles.h"

#include <vector>

namespace bindpose
{

/// The constraint of a handle, chosen by the user. The integers are those of the cell array Mode.
enum class HandleMode : int
{
  full = 0, ///< the whole transform is constrained
  position = 1, ///< the position of the pivot is constrained; rotation and scale are computed
  free = 2, ///< no constraint
  tail = 3, ///< bones: the position of the tail is constrained
  ends = 4, ///< bones: the positions of both ends are constrained
  /// Like `full`, but methods that compute rotations use the mode that resolve_automatic_modes()
  /// chooses.
  automatic = 5
};

/// Names of the modes, in the order of their integers.
inline constexpr const char* handle_mode_words[] = { "full", "position", "free", "tail", "ends",
  "auto" };
/// Return one of handle_mode_words.
const char* to_string(HandleMode mode);

/// Affine map x -> linear * x + translation as a 3 x 4 matrix, from rest to posed positions, in
/// world coordinates.
using Affine = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
inline Affine identity_affine()
{
  Affine t = Affine::Zero();
  t.leftCols<3>().setIdentity();
  return t;
}

/// Constraints violated by more than this fraction of the bounding-box diagonal are reported as
/// contradictory.
constexpr double contradiction_tolerance = 1e-9;

/// Pose of one handle.
struct HandlePose
{
  HandleMode mode = HandleMode::automatic;
  Affine transform = identity_affine();
  double stretch = 1.0; ///< bones: posed length / rest length
  Eigen::Vector2d twist = Eigen::Vector2d::Zero(); ///< bones: twist at head and tail, degrees
};

/// Report whether a mode constrains the whole transform.
inline bool constrains_transform(HandleMode mode)
{
  return mode == HandleMode::full || mode == HandleMode::automatic;
}
/// Report whether the mode constrains the position of the pivot but not the whole transform.
inline bool constrains_pivot(HandleMode mode)
{
  return mode == HandleMode::position || mode == HandleMode::ends;
}
/// Report whether the mode constrains the position of the tail but not the whole transform.
inline bool constrains_tail(HandleMode mode)
{
  return mode == HandleMode::tail || mode == HandleMode::ends;
}

/// Return the posed position of a handle's pivot.
Vec3 posed_pivot(const Handle& handle, const HandlePose& pose);
/// Return the posed position of a bone's tail. The stretch of the bone is applied.
Vec3 posed_tail(const Handle& handle, const HandlePose& pose);

/// One HandlePose for each handle, in the order of the handles.
using Pose = std::vector<HandlePose>;

/// Convert the transforms of a pose from the original coordinates to the coordinates of a frame.
Pose to_frame(const WorkingFrame& frame, Pose pose);
/// Convert a transform from the coordinates of a frame to the original coordinates.
Affine from_frame(const WorkingFrame& frame, const Affine& transform);

/// Largest allowed absolute value in a pose. It ensures that the product of two transforms and a
/// position is finite.
constexpr double largest_pose_value = 1e102;

/// Return invalid_input, with the name of the handle, if a number of its pose is not finite or is
/// larger than largest_pose_value.
Status check_pose_values(const Handle& handle, const HandlePose& pose);

/// Return invalid_input if the numbers of entries and handles differ or are zero. Return the errors
/// of check_pose_values(). Return invalid_input with the name of the handle if a handle that is not
/// a bone has mode tail or ends.
Status check_pose(const Handles& handles, const Pose& pose);

/// Check whether a mesh and its handles can be bound. Return invalid_input if check_mesh() or
/// check_handles() fails, if a point is not finite, or if there is no element.
Status check_mesh_and_handles(PointsView points, TrianglesView triangles, const Handles& handles);
Status check_mesh_and_handles(PointsView points, TetsView tets, const Handles& handles);

/// Specifies in which modes (HandleMode) a method uses the stretch and the twist of a bone.
enum class StretchUse : int
{
  tails, ///< uses the stretch in mode tail (skinning with one transform per bone)
  ends, ///< uses the stretch in the modes tail and ends (methods that compute transforms)
  all ///< uses stretch and twist in all modes (stretchable, twistable bones)
};

/// Return a warning of one sentence if the pose has a stretch or a twist that the method does not
/// use, otherwise an empty string. A stretch within 1e-6 of 1 and a twist of at most 1e-4 degrees
/// are treated as round-off. The sentence contains no names, so that it is the same for all frames
/// of a sequence.
std::string unused_stretch(const Pose& pose, StretchUse use);

std::vector<HandleMode> modes_of(const Pose& pose);
/// Report whether the handles' modes in the pose equal `modes`.
bool same_modes(const std::vector<HandleMode>& modes, const Pose& pose);

} // namespace bindpose

#endif
