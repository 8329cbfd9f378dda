#ifndef bindpose_skinning_moving_least_squares_h
#define bindpose_skinning_moving_least_squares_h

#include "base/execution.h"
#include "skinning/points_output.h"
#include "handles/handles.h"
#include "pose/pose.h"

namespace bindpose
{

/// Options of MovingLeastSquares::bind().
struct MovingLeastSquaresOptions
{
  /// Handles are weighted by 1 / distance^(2 exponent). The exponent is from 1 to 8. With a larger
  /// exponent, the surroundings of a handle are more rigid. (With an exponent below 1, a bone would
  /// not constrain the points on it.)
  double exponent = 1.0;
};

/// Rigid warp by moving least squares (Schaefer, McPhail, Warren: Image Deformation Using Moving
/// Least Squares, 2006). Every point of space moves by the rigid motion that best fits the motion
/// of the handles, with larger weights for near handles. The warp needs no mesh and no weights. It
/// does not depend on the shape: all points near a handle move with it, even if they are not
/// connected to it.
///
///     MovingLeastSquares warp;
///     warp.bind(context, options, rest, handles);
///     warp.warp(context, handles, pose, posed);
///
/// Points, cage vertices and pivots of regions contribute with their positions; their rotations are
/// ignored. Bones contribute as line segments (section 3 of the paper). The weight of a bone is an
/// integral over the bone. It is scaled so that a bone as long as the handles' extent has the same
/// weight as a point. (The extent is the largest distance between two pivots or tails.) A rotation
/// about the bone itself has no effect. A handle in mode free has no effect. If a pose moves all
/// handles by one rigid motion, all points move by this motion, provided that the handles determine
/// it. Two points determine a motion in a plane; three points that are not on a line determine a
/// motion in space. Otherwise the smallest of the possible rotations is used.
///
/// If the rest shape, the handles at rest and the posed handles are each in a plane z = const, the
/// rotation is within the plane. Otherwise the rotation is in space.
///
/// Memory: 24 bytes for each vertex and handle. Cost: a bind needs one integral for each vertex and
/// bone, a warp one rotation fit per vertex. The result has the same bits for any number of
/// threads.
class MovingLeastSquares
{
public:
  /// Compute the weights of the handles at each vertex and copy the points. Return invalid_input if
  /// the exponent is out of range or check_handles() fails.
  Status bind(ExecutionContext& context, const MovingLeastSquaresOptions& options, PointsView rest,
    const Handles& handles);

  /// Compute the posed positions of the bound points. The report contains planar (1 or 0). If all
  /// handles are in mode free, the points do not move, and a warning is added.
  Status warp(
    ExecutionContext& context, const Handles& handles, const Pose& pose, PointsOutput posed) const;

  /// Weight of a handle at a vertex. The amount is the total weight (1 for the nearest handle if
  /// that handle is a point). For a bone, `mean` and `variance` are those of the weighted positions
  /// along the bone (0 head, 1 tail).
  struct HandleMoments
  {
    double amount = 0.0, mean = 0.0, variance = 0.0;
  };
  HandleMoments moments(Index vertex, Index handle) const
  {
    return this->moments_[static_cast<std::size_t>(vertex * this->handles_ + handle)];
  }

private:
  Points rest_;
  Index handles_ = 0;
  bool flat_ = false;
  std::vector<HandleMoments> moments_;
};

} // namespace bindpose

#endif
