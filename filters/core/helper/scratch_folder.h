#ifndef bindpose_helper_scratch_folder_h
#define bindpose_helper_scratch_folder_h

#include <string>

namespace bindpose
{

/// A temporary folder in the system's folder for temporary files (TMPDIR, else /tmp). It is used
/// for programs that exchange data only through files. The destructor removes the folder with all
/// its contents. If this process dies or is killed, a small shell process, the guard, removes the
/// folder.
class ScratchFolder
{
public:
  /// Create the folder. `purpose` becomes part of its name.
  explicit ScratchFolder(const std::string& purpose);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// Return the path, or an empty string if the folder could not be created; see error().
  const std::string& path() const { return this->path_; }
  const std::string& error() const { return this->error_; }

  /// Set the process group (0: no group) that uses the folder. If this process dies, the guard
  /// kills the group. See ChildRequest::started.
  void guard_group(int group);

private:
  void start_guard();

  std::string path_;
  std::string error_;
  int guard_ = -1; ///< process id of the guard; -1: no guard
  int socket_ =
    -1; ///< file descriptor of the socket to the guard; it closes when this process ends
};

} // namespace bindpose

#endif
