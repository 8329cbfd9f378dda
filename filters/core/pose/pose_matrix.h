#ifndef bindpose_pose_pose_matrix_h
#define bindpose_pose_pose_matrix_h

#include "pose/pose.h"

namespace bindpose
{

/// Convert a matrix in the layout of libigl's DMAT files to a pose of all handles. All handles get
/// mode full. Let m be the number of handles, with points before bones, and let d be 3, or 2 for a
/// shape in the plane z = const. The matrix is one of:
/// - (d + 1) m x d: one transposed transform per handle, one below the other, from rest to posed in
///   world coordinates (igl::deform_skeleton, igl::lbs_matrix). The posed position of a point p is
///   (p, 1) times the rows of the transform.
/// - 4 b x 1: one quaternion (x, y, z, w) for each of the b bones: a rotation about the bone's
///   head, applied before the rotation of its parent (igl::forward_kinematics). For a bone without
///   a parent, the first bone that ends where this bone begins is taken as the parent. Points do
///   not move.
///
/// Return invalid_input if the matrix has another size, a value is not finite, or a quaternion has
/// length zero. The message about a quaternion contains the name of the bone. `handles` must have
/// passed check_handles().
Status pose_of_matrix(WeightsView matrix, const Handles& handles, Pose& pose);

} // namespace bindpose

#endif
