#ifndef bindpose_scene_video_file_h
#define bindpose_scene_video_file_h

#include "base/execution.h"
#include "base/status.h"

#include <string>

namespace bindpose
{

/// File name extensions of moving pictures, which ffmpeg writes.
constexpr const char* video_extensions = "gif webm mp4 apng";

/// Return unavailable, with the package to install, if ffmpeg is not on the PATH.
Status check_ffmpeg();

/// Return the path of the picture of a frame (counted from 0) in a folder of pictures.
std::string frame_file(const std::string& folder, int frame);

/// Make a moving picture from the pictures frame_file() in a folder. ffmpeg writes directly to
/// `path`, whose extension determines the format.
Status write_video(const std::string& folder, double frames_per_second, const std::string& path,
  ExecutionContext& context);

} // namespace bindpose

#endif
