// Runs ffmpeg to write animations. ffmpeg is a separate program: it is found on the PATH, reads a
// folder of image files, and is killed when the user cancels.
#include "pictures/video_file.h"

#include "file_kind.h"
#include "helper/child_process.h"

#include <cstdio>

namespace bindpose
{

namespace
{
constexpr double time_limit = 3600.0; // seconds

/// Return the arguments of ffmpeg for a file format.
std::vector<std::string> codec_of(const std::string& extension)
{
  if (extension == "gif")
  {
    // Compute the palette of 256 colors from the frames. ffmpeg's default palette does not depend
    // on the frames.
    return { "-vf", "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse" };
  }
  if (extension == "apng")
  {
    return { "-plays", "0", "-f", "apng" };
  }
  // Many players require an even width and height, and yuv420p: one color sample per four pixels.
  const std::string even_size_filter = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
  return extension == "webm" ? std::vector<std::string>{ "-vf", even_size_filter, "-c:v",
    "libvpx-vp9", "-crf", "24", "-b:v", "0", "-pix_fmt", "yuv420p" }
                             : std::vector<std::string>{ "-vf", even_size_filter, "-c:v", "libx264",
                                 "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart" };
}
} // namespace

Status check_ffmpeg()
{
  return find_on_path("ffmpeg").empty()
    ? Status::failure(StatusCode::unavailable,
        "videos need ffmpeg, which is not on the PATH (on Debian: apt-get install ffmpeg); a .png "
        "output shows the frames side by side without ffmpeg")
    : Status();
}

std::string frame_file(const std::string& folder, int frame)
{
  char name[32];
  std::snprintf(name, sizeof(name), "/%06d.png", frame);
  return folder + name;
}

Status write_video(ExecutionContext& context, const std::string& folder, double frames_per_second,
  const std::string& path)
{
  char rate[40];
  std::snprintf(rate, sizeof(rate), "%.9g", frames_per_second);
  ChildRequest request;
  request.name = "ffmpeg";
  request.path = find_on_path("ffmpeg");
  request.arguments = { "-nostdin", "-loglevel", "error", "-y", "-framerate", rate, "-i",
    folder + "/%06d.png" };
  const std::vector<std::string> codec = codec_of(file_extension(path));
  request.arguments.insert(request.arguments.end(), codec.begin(), codec.end());
  request.arguments.push_back("file:" + path); // the prefix "file:" allows a file name with a colon
  request.time_limit = time_limit;
  std::string first_message;
  ChildEnd end;
  Status status = run_child(
    context, request,
    [&first_message](const std::string& line)
    { first_message = first_message.empty() ? line : first_message; },
    end);
  if (status.ok() && !end.failure.empty())
  {
    status = Status::failure(StatusCode::unavailable,
      "ffmpeg " + end.failure +
        (first_message.empty() ? "" : ": " + sanitize_line(first_message.substr(0, 200))));
  }
  return status;
}

} // namespace bindpose
