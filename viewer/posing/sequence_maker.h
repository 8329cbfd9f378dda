#ifndef bindpose_posing_sequence_maker_h
#define bindpose_posing_sequence_maker_h

#include "posing/body.h"
#include "posing/poser.h"

#include <vector>

namespace bindpose
{

/// The frames of an animation: the surface's points, and for linear blends the transforms that
/// moved them.
struct PosedFrames
{
  std::vector<Points> points;
  std::vector<std::vector<Affine>> transforms; ///< one a frame, or none
  double frames_per_second = 24.0;
};

/// Poses all frames, each from where the one before was, as the window shows them when it plays.
Status make_frames(ExecutionContext& context, const std::shared_ptr<const PoseSource>& source,
  const PoseOptions& options, const std::vector<Pose>& poses, PosedFrames& frames);

/// The same of a body's run: every step is a frame.
Status make_frames(ExecutionContext& context, const std::shared_ptr<const PoseSource>& source,
  const PoseOptions& options, const BodyRun& run, PosedFrames& frames);

} // namespace bindpose

#endif
