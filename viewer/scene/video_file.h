#ifndef bindpose_scene_video_file_h
#define bindpose_scene_video_file_h

#include "base/execution.h"
#include "base/status.h"

#include <string>

namespace bindpose
{

/// Endings of moving pictures, which ffmpeg makes.
constexpr const char* video_extensions = "gif webm mp4 apng";

/// unavailable, with the package to install, when there is no ffmpeg on the PATH.
Status check_ffmpeg();

/// The picture of frame k (from 0) in a folder of pictures.
std::string frame_file(const std::string& folder, int frame);

/// Makes a moving picture of the pictures frame_file() in a folder. `path` is written to as it is:
/// its ending is its kind.
Status write_video(const std::string& folder, double frames_per_second, const std::string& path,
  ExecutionContext& context);

} // namespace bindpose

#endif
