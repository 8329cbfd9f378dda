#ifndef bindpose_poser_sequence_maker_h
#define bindpose_poser_sequence_maker_h

#include "poser/body.h"
#include "poser/poser.h"

#include <vector>

namespace bindpose
{

/// The frames of an animation: the surface's points and, for linear blend skinning, the transforms
/// that moved these points.
struct PosedFrames
{
  std::vector<Points> points;
  std::vector<std::vector<Affine>> transforms; ///< one list of transforms per frame, or empty
  double frames_per_second = 24.0;
};

/// Pose all frames of an animation. Each solve starts from the result of the previous frame, as it
/// does when the window plays the animation.
Status make_frames(ExecutionContext& context, const std::shared_ptr<const PoseSource>& source,
  const PoseOptions& options, const std::vector<Pose>& poses, PosedFrames& frames);

/// Return the frames of a recorded simulation: one for its start and one per step.
Status make_frames(ExecutionContext& context, const std::shared_ptr<const PoseSource>& source,
  const PoseOptions& options, const BodyRun& run, PosedFrames& frames);

} // namespace bindpose

#endif
