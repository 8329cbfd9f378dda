#ifndef bindpose_helper_child_process_h
#define bindpose_helper_child_process_h

#include "base/execution.h"
#include "base/mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace bindpose
{

/// A program to be run in a process of its own.
struct ChildRequest
{
  std::string name; ///< what messages call it
  std::string path; ///< of the executable
  std::vector<std::string> arguments;
  std::string folder; ///< where it is run, empty: where this process is
  int input = -1; ///< file descriptor of its standard input, -1: nothing to read
  int output = -1; ///< file descriptor of its standard output, -1: lines, like standard error
  double time_limit = 120.0; ///< seconds after which it is killed
  /// Seconds of its own processor time after which it is killed, 0: no limit. Other work on the
  /// machine does not count.
  double processor_limit = 0.0;
  Index memory_limit = 0; ///< MiB of address space that it may use, 0: no limit
  /// Called with the process group once it runs, and with 0 when nothing is left of the group.
  std::function<void(int group)> started;
};

/// How it ended.
struct ChildEnd
{
  /// "was ended by signal 11 (Segmentation fault)" or "ended with code 7"; empty for code 0.
  std::string failure;
  bool by_signal = false;
  bool at_limit = false; ///< it was stopped at one of its limits of time
  double seconds = 0.0;
};

/// Runs a program to its end. It leads a process group of its own, which is killed on every way
/// out, so that nothing that it started runs on. It leaves no core file. Called on this thread,
/// `take_line` gets what it prints, line by line without the line ends.
/// - ok: it ended by itself: see `end`;
/// - unavailable: it could not be started;
/// - cancelled: the context was cancelled (the group is killed within 20 ms);
/// - internal_error: it was stopped at a limit of time, or there is no pipe to be had.
Status run_child(const ChildRequest& request,
  const std::function<void(const std::string&)>& take_line, ChildEnd& end,
  ExecutionContext& context);

/// invalid_input for a time limit (seconds) that is not positive or a memory limit (MiB) below 0.
Status check_limits(double time_limit, Index memory_limit);

/// " under a memory limit of 500 MiB", empty without a limit.
std::string memory_words(Index memory_limit);

/// True for a file that may be executed.
bool executable_file(const std::string& path);

/// The file of a program that stands in one of the folders of PATH; empty without one.
std::string find_on_path(const std::string& program);

/// A file descriptor that closes itself.
class FileDescriptor
{
public:
  explicit FileDescriptor(int descriptor = -1) : descriptor_(descriptor) {}
  ~FileDescriptor() { this->close(); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int get() const { return this->descriptor_; }
  void close();

private:
  int descriptor_;
};

} // namespace bindpose

#endif
