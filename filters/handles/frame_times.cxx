// Provides the frames of a sequence as time steps of a VTK pipeline. Frame k is shown from time k /
// fps to (k + 1) / fps.
#include "frame_times.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{

using SDDP = vtkStreamingDemandDrivenPipeline;

void set_time_steps(vtkInformation* output, const std::vector<double>& times)
{
  output->Remove(SDDP::TIME_STEPS());
  output->Remove(SDDP::TIME_RANGE());
  if (!times.empty())
  {
    const double range[2] = { times.front(), times.back() };
    output->Set(SDDP::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    output->Set(SDDP::TIME_RANGE(), range, 2);
  }
}

void set_frame_times(vtkInformation* output, int frames, double frames_per_second)
{
  std::vector<double> times;
  for (int frame = 0; frames > 1 && frame < frames; ++frame)
  {
    times.push_back(static_cast<double>(frame) / frames_per_second);
  }
  set_time_steps(output, times);
}

bool requested_time(vtkInformation* output, double& time)
{
  const bool is_requested =
    output->Has(SDDP::UPDATE_TIME_STEP()) && output->Has(SDDP::TIME_RANGE());
  if (is_requested)
  {
    time = output->Get(SDDP::UPDATE_TIME_STEP());
  }
  return is_requested;
}

int frame_at(double time, int frames, double frames_per_second)
{
  // The 1e-6 allows for round-off in the times of frames.
  return static_cast<int>(
    std::floor(std::clamp(time * frames_per_second + 1e-6, 0.0, static_cast<double>(frames - 1))));
}

} // namespace bindpose
