#ifndef frame_times_h
#define frame_times_h

class vtkInformation;

namespace bindpose
{

/// Offers the times of so many frames at a port, the first at 0 s; of fewer than two frames, none.
void offer_frames(vtkInformation* output, int frames, double frames_per_second);

/// Takes all offers of times back.
void offer_no_time(vtkInformation* output);

/// Whether a time is asked for that the port offers, and which.
bool asked_time(vtkInformation* output, double& time);

/// The frame that is on at a time, the first or the last outside of them.
int frame_at(double time, int frames, double frames_per_second);

} // namespace bindpose

#endif
