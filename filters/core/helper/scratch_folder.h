#ifndef bindpose_helper_scratch_folder_h
#define bindpose_helper_scratch_folder_h

#include <string>

namespace bindpose
{

/// A temporary folder, in the system's folder for temporary files (TMPDIR, else /tmp), for a
/// program that can exchange data only through files. The destructor removes it with all its
/// contents. If this process dies or is killed, a small shell process removes it.
class ScratchFolder
{
public:
  /// Create the folder. `purpose` becomes part of its name.
  explicit ScratchFolder(const std::string& purpose);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// Return the path, which is empty if the folder could not be created: see error().
  const std::string& path() const { return this->path_; }
  const std::string& error() const { return this->error_; }

  /// Set the process group that works in the folder and must be killed if this process dies; 0:
  /// none. See ChildRequest::started.
  void guard_group(int group);

private:
  void start_guard();

  std::string path_;
  std::string error_;
  int guard_ = -1; ///< process id
  int line_ = -1; ///< file descriptor; its closing signals the end of this process to the guard
};

} // namespace bindpose

#endif
