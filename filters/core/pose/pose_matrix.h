#ifndef bindpose_pose_pose_matrix_h
#define bindpose_pose_pose_matrix_h

#include "pose/pose.h"

namespace bindpose
{

/// Return a pose of all handles from a matrix, in the layout of libigl's DMAT files. Every handle
/// is full. With m handles, points before bones, and d = 3, or 2 in the plane z = const, the matrix
/// is one of:
/// - (d + 1) m x d: one transposed transform per handle, one below the other, rest to posed,
///   absolute (igl::deform_skeleton, igl::lbs_matrix): posed = (p, 1) times its rows;
/// - 4 b x 1: one rotation (x, y, z, w) for each of the b bones, about its head and before the
///   rotation of its parent (igl::forward_kinematics). If a bone has no parent, the first bone
///   whose tail is at its head is its parent. Points do not move.
///
/// invalid_input for any other size, for numbers that are not finite and, naming the bone, for a
/// rotation of length zero. `handles` must have passed check_handles().
Status pose_of_matrix(WeightsView matrix, const Handles& handles, Pose& pose);

} // namespace bindpose

#endif
