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
  free = 2, ///< nothing
  tail = 3, ///< bones: where the tail goes
  ends = 4, ///< bones: where both ends go
  automatic = 5 ///< full, or for methods that find rotations what with_found_rotations() chooses
};

/// The words of the modes, in the order of their numbers.
inline constexpr const char* handle_mode_words[] = { "full", "position", "free", "tail", "ends",
  "auto" };
/// One of handle_mode_words.
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

/// Whether a mode fixes the whole transform.
inline bool holds_transform(HandleMode mode)
{
  return mode == HandleMode::full || mode == HandleMode::automatic;
}
/// Whether a mode that is not full fixes where the pivot goes, or the tail.
inline bool holds_pivot(HandleMode mode)
{
  return mode == HandleMode::position || mode == HandleMode::ends;
}
inline bool holds_tail(HandleMode mode)
{
  return mode == HandleMode::tail || mode == HandleMode::ends;
}

/// Where a pose takes a handle's pivot, or its tail: along the posed bone, as far as it stretches.
Vec3 posed_pivot(const Handle& handle, const HandlePose& pose);
Vec3 posed_tail(const Handle& handle, const HandlePose& pose);

/// One HandlePose for each handle, in the order of the columns.
using Pose = std::vector<HandlePose>;

/// invalid_input for another number of entries than of handles, for none, and, naming the handle,
/// for numbers that are not finite and for a mode of bones' ends at another handle.
Status check_pose(const Handles& handles, const Pose& pose);

/// What can be bound: invalid_input for check_mesh()'s reasons, a point that is not finite, no
/// element, and for check_handles()'s reasons.
Status check_bendable(PointsView points, TrianglesView triangles, const Handles& handles);
Status check_bendable(PointsView points, TetsView tets, const Handles& handles);

/// What a method does with the stretch and the twist of a bone. Every method uses the stretch of a
/// bone in mode tail.
enum class StretchUse : int
{
  tails, ///< nothing else: skinning with one transform per bone
  ends, ///< the stretch in mode ends: methods that find transforms
  all ///< stretch and twist: stretchable bones
};

/// Return a sentence if the pose has a stretch or a twist that the method does not use; else empty.
/// A stretch within 1e-6 of 1 and a twist of at most 1e-4 degrees are roundoff of posed ends. The
/// sentence has no names, so that the frames of a sequence repeat one sentence.
std::string unused_stretch(const Pose& pose, StretchUse use);

std::vector<HandleMode> modes_of(const Pose& pose);
/// Whether these are the modes of the pose.
bool same_modes(const std::vector<HandleMode>& modes, const Pose& pose);

} // namespace bindpose

#endif
