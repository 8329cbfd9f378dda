#ifndef bindpose_pictures_video_file_h
#define bindpose_pictures_video_file_h

#include "base/execution.h"
#include "base/status.h"

#include <string>

namespace bindpose
{

/// File name extensions of the animation formats that ffmpeg writes for Bindpose.
constexpr const char* video_extensions = "gif webm mp4 apng";

/// Return unavailable, with the package to install, if ffmpeg is not on the PATH.
Status check_ffmpeg();

/// Return the path of the image file of a frame (counted from 0) in a folder.
std::string frame_file(const std::string& folder, int frame);

/// Write an animation of the image files in a folder. The file names must be the results of
/// frame_file(). ffmpeg writes directly to `path`; the extension of `path` determines the format.
Status write_video(ExecutionContext& context, const std::string& folder, double frames_per_second,
  const std::string& path);

} // namespace bindpose

#endif
