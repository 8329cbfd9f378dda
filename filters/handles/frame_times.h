#ifndef frame_times_h
#define frame_times_h

#include <vector>

class vtkInformation;

namespace bindpose
{

// Frames of a sequence as time steps of a VTK pipeline: frame k is at the time k / fps.

/// Set the time steps of an output port. `times` must be in ascending order; an empty list removes
/// the time steps.
void set_time_steps(vtkInformation* output, const std::vector<double>& times);

/// Set the time steps of an output port to the times of the frames, the first at 0 s. If there are
/// fewer than two frames, remove the time steps.
void set_frame_times(vtkInformation* output, int frames, double frames_per_second);

/// Report whether the pipeline requests a time from a port that provides times (TIME_RANGE). If so,
/// set `time` to the requested time in seconds.
bool requested_time(vtkInformation* output, double& time);

/// Return the index of the frame that is shown at `time` (seconds): the last frame at or before
/// `time`. Return the first frame if `time` is before all frames.
int frame_at(double time, int frames, double frames_per_second);

} // namespace bindpose

#endif
