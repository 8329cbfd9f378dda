#ifndef bindpose_pose_pose_h
#define bindpose_pose_pose_h

#include "weights/handles.h"

#include <vector>

namespace bindpose
{

/// The constraint that the user puts on a handle. The integers are those of the cell array Mode.
enum class HandleMode : int
{
  full = 0, ///< the whole transform
  position = 1, ///< position of the pivot; rotation and scale are found
  free = 2, ///< no constraint
  tail = 3, ///< bones: position of the tail
  ends = 4, ///< bones: positions of both ends
  /// Full; methods that find rotations use the mode that with_found_rotations() chooses.
  automatic = 5
};

/// Names of the modes, in the order of their integers.
inline constexpr const char* handle_mode_words[] = { "full", "position", "free", "tail", "ends",
  "auto" };
/// Return one of handle_mode_words.
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
  HandleMode mode = HandleMode::automatic;
  Affine transform = identity_affine();
  double stretch = 1.0; ///< bones: posed length / rest length
  Eigen::Vector2d twist = Eigen::Vector2d::Zero(); ///< bones: degrees at head and tail
};

/// Report whether a mode constrains the whole transform.
inline bool holds_transform(HandleMode mode)
{
  return mode == HandleMode::full || mode == HandleMode::automatic;
}
/// Report whether a mode other than full constrains the pivot, or the tail.
inline bool holds_pivot(HandleMode mode)
{
  return mode == HandleMode::position || mode == HandleMode::ends;
}
inline bool holds_tail(HandleMode mode)
{
  return mode == HandleMode::tail || mode == HandleMode::ends;
}

/// Return the posed position of a handle's pivot, or of its tail. The tail is at the end of the
/// stretched bone.
Vec3 posed_pivot(const Handle& handle, const HandlePose& pose);
Vec3 posed_tail(const Handle& handle, const HandlePose& pose);

/// One HandlePose for each handle, in the order of the columns.
using Pose = std::vector<HandlePose>;

/// Return invalid_input if the numbers of entries and handles differ or are zero. Return
/// invalid_input, naming the handle, for numbers that are not finite and for a mode of bone ends at
/// a handle that is not a bone.
Status check_pose(const Handles& handles, const Pose& pose);

/// Check whether a mesh and its handles can be bound. Return invalid_input for the reasons of
/// check_mesh() and check_handles(), for a point that is not finite, and if there is no element.
Status check_bendable(PointsView points, TrianglesView triangles, const Handles& handles);
Status check_bendable(PointsView points, TetsView tets, const Handles& handles);

/// Use of the stretch and the twist of a bone by a method. Every method uses the stretch of a bone
/// in mode tail.
enum class StretchUse : int
{
  tails, ///< only that: skinning with one transform per bone
  ends, ///< also the stretch in mode ends: methods that find transforms
  all ///< stretch and twist: stretchable bones
};

/// Return a sentence if the pose has a stretch or a twist that the method does not use; else empty.
/// A stretch within 1e-6 of 1 and a twist of at most 1e-4 degrees are roundoff of posed ends. The
/// sentence has no names, so that the frames of a sequence repeat one sentence.
std::string unused_stretch(const Pose& pose, StretchUse use);

std::vector<HandleMode> modes_of(const Pose& pose);
/// Report whether these are the modes of the pose.
bool same_modes(const std::vector<HandleMode>& modes, const Pose& pose);

} // namespace bindpose

#endif
