#include "poser/sequence_maker.h"

#include "poser/make_poser.h"
#include "skinning/skinning.h"

namespace bindpose
{

Status make_frames(ExecutionContext& context, const std::shared_ptr<const PoseSource>& source,
  const PoseOptions& options, const std::vector<Pose>& poses, PosedFrames& frames)
{
  const std::unique_ptr<Poser> poser = make_poser(options.method, source);
  Status status;
  {
    ProgressRange range(context, 0.0, 0.3);
    status = poser->bind(context, options);
  }
  for (std::size_t k = 0; status.usable() && k < poses.size(); ++k)
  {
    const auto fraction = [&](std::size_t frame)
    { return 0.3 + 0.7 * static_cast<double>(frame) / static_cast<double>(poses.size()); };
    ProgressRange range(context, fraction(k), fraction(k + 1));
    Points points;
    status = poser->solve(context, poses[k], options, 0, points);
    frames.points.push_back(std::move(points));
    if (options.method == PoseMethod::linear_blend)
    {
      std::vector<Affine> transforms;
      skinning_transforms(source->handles, poses[k], transforms);
      frames.transforms.push_back(std::move(transforms));
    }
    if (context.canceled())
    {
      return Status::canceled();
    }
  }
  return status;
}

Status make_frames(ExecutionContext& context, const std::shared_ptr<const PoseSource>& source,
  const PoseOptions& options, const BodyRun& run, PosedFrames& frames)
{
  Body body(source);
  Status status;
  {
    ProgressRange range(context, 0.0, 0.3);
    status = body.bind(context, options);
  }
  if (!status.usable())
  {
    return status;
  }
  if (!run.steps.empty() && run.steps.front().options)
  {
    frames.frames_per_second = run.steps.front().options->steps_per_second;
  }
  status = body.play(context, run,
    [&](std::size_t /*step*/, const Points& points)
    {
      frames.points.push_back(points);
      return !context.canceled();
    });
  return context.canceled() ? Status::canceled() : status;
}

} // namespace bindpose
