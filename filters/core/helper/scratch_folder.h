#ifndef bindpose_helper_scratch_folder_h
#define bindpose_helper_scratch_folder_h

#include <string>

namespace bindpose
{

/// A temporary folder for a program that can only talk through files, in the system's folder for
/// them (TMPDIR, else /tmp). It is removed with all that is in it when the object goes and, by a
/// small shell process that waits for that, when this process dies, be it killed.
class ScratchFolder
{
public:
  /// `purpose` becomes part of the name.
  explicit ScratchFolder(const std::string& purpose);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// Empty when no folder could be made: see error().
  const std::string& path() const { return this->path_; }
  const std::string& error() const { return this->error_; }

  /// The process group that works in the folder and is to be killed, too, when this process dies;
  /// 0: none. See ChildRequest::started.
  void guard_group(int group);

private:
  void start_guard();

  std::string path_;
  std::string error_;
  int guard_ = -1; ///< process id
  int line_ = -1; ///< file descriptor: its end tells the guard that this process is gone
};

} // namespace bindpose

#endif
