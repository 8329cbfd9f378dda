#ifndef bindpose_pose_moving_least_squares_h
#define bindpose_pose_moving_least_squares_h

#include "base/execution.h"
#include "pose/pose.h"
#include "weights/handles.h"

namespace bindpose
{

struct MovingLeastSquaresOptions
{
  /// Handles count by 1 / distance^(2 exponent): more makes them rule their surroundings more
  /// rigidly. 1 to 8, 1 by default. (Below 1 a bone would not hold what lies on it.)
  double exponent = 1.0;
};

/// The rigid warp by moving least squares (Schaefer, McPhail, Warren: Image Deformation Using
/// Moving Least Squares, 2006): every point of space moves by the rigid motion that takes the
/// handles nearest to where they are posed, near handles counting more. Needs no mesh and no
/// weights, and knows nothing of the shape: what is near moves along, connected or not.
///
///     MovingLeastSquares warp;
///     warp.bind(context, options, rest, handles);
///     warp.warp(context, handles, pose, posed);
///
/// Points, cage vertices and the pivots of regions count by where they go: how they turn is not
/// asked. Bones count by where their segment goes (as lines of section 3 of the paper): the
/// integral over all points of the bone, where a bone as long as the handles' extent (the largest
/// distance between two ends) counts as one point; a turn about the bone itself is not seen. A
/// handle in mode free does not count. A pose that moves all handles by one rigid motion moves
/// everything by it, where the handles tell a motion from others: two points (in a plane) or three
/// not on a line; of the rotations that are left the smallest is taken.
///
/// A flat rest shape (z = const) with handles at one z, whose pose keeps theirs equal, is turned
/// within its plane; everything else in space.
///
/// Memory: 24 bytes for each vertex and handle. Bind: one integral for each vertex and bone; a
/// warp: one rotation fit a vertex. The same bits for any number of threads.
class MovingLeastSquares
{
public:
  /// Weighs handles at each vertex. invalid_input for an exponent out of range and
  /// check_handles()'s reasons. Keeps the points.
  Status bind(ExecutionContext& context, const MovingLeastSquaresOptions& options, PointsView rest,
    const Handles& handles);

  /// Where the bound points go. Report: planar (1 or 0). A warning where no handle counts.
  Status warp(
    ExecutionContext& context, const Handles& handles, const Pose& pose, Points& posed) const;

  /// What a handle is to a vertex: how much it counts (1 for the nearest of points), where along
  /// the bone (0 head, 1 tail) the mean of what counts is, and its variance.
  struct Share
  {
    double amount = 0.0, mean = 0.0, variance = 0.0;
  };
  Share share(Index vertex, Index handle) const
  {
    return this->shares_[static_cast<std::size_t>(vertex * this->handles_ + handle)];
  }

private:
  Points rest_;
  Index handles_ = 0;
  bool flat_ = false;
  std::vector<Share> shares_;
};

} // namespace bindpose

#endif
