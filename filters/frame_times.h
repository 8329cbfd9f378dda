#ifndef frame_times_h
#define frame_times_h

#include <vector>

class vtkInformation;

namespace bindpose
{

/// Offers these times at a port, ascending; none: takes all offers back.
void offer_times(vtkInformation* output, const std::vector<double>& times);

/// Offers the times of so many frames at a port, the first at 0 s; of fewer than two frames, none.
void offer_frames(vtkInformation* output, int frames, double frames_per_second);

/// Whether a time is asked for that the port offers, and which.
bool asked_time(vtkInformation* output, double& time);

/// The frame that is on at a time, the first or the last outside of them.
int frame_at(double time, int frames, double frames_per_second);

} // namespace bindpose

#endif
