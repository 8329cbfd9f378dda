#ifndef bindpose_pose_pose_matrix_h
#define bindpose_pose_pose_matrix_h

#include "pose/pose.h"

namespace bindpose
{

/// A pose of all handles from a matrix, as libigl keeps them in DMAT files; every handle is full.
/// With m handles, points before bones, and d = 3, or 2 in the plane z = const:
/// - (d + 1) m x d: a transform a handle below the other, each transposed, rest to posed, absolute
///   (igl::deform_skeleton, igl::lbs_matrix): posed = (p, 1) times its rows;
/// - 4 b x 1: a rotation (x, y, z, w) for each of the b bones, about its head and before its
///   parent's (igl::forward_kinematics); a bone that knows no parent has the first one whose tail
///   is its head. Points stay.
///
/// invalid_input for any other size, for numbers that are not finite and, naming the bone, for a
/// rotation of length zero. handles must have passed check_handles().
Status pose_of_matrix(WeightsView matrix, const Handles& handles, Pose& pose);

} // namespace bindpose

#endif
