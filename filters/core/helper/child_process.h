#ifndef bindpose_helper_child_process_h
#define bindpose_helper_child_process_h

#include "base/execution.h"
#include "base/mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace bindpose
{

/// A program that is run in a separate process.
struct ChildRequest
{
  std::string name; ///< name in messages
  std::string path; ///< path of the executable
  std::vector<std::string> arguments;
  std::string folder; ///< working folder; empty: that of this process
  int input = -1; ///< file descriptor of its standard input, -1: no input
  int output = -1; ///< file descriptor of its standard output, -1: lines, like standard error
  double time_limit = 120.0; ///< the program is killed after this many seconds
  /// The program is killed after this many seconds of its own processor time, 0: no limit. Other
  /// processes on the machine do not count.
  double processor_limit = 0.0;
  Index memory_limit = 0; ///< largest address space in MiB, 0: no limit
  /// Called with the process group when the program runs, and with 0 when the group has ended.
  std::function<void(int group)> started;
};

/// Outcome of a program.
struct ChildEnd
{
  /// "was ended by signal 11 (Segmentation fault)" or "ended with code 7"; empty for code 0.
  std::string failure;
  bool by_signal = false;
  bool at_limit = false; ///< it was stopped at one of its time limits
  double seconds = 0.0;
};

/// Run a program to its end. It leads a separate process group, which is always killed before the
/// function returns, so that no process that it started remains. It writes no core file.
/// `take_line` is called on this thread with each printed line, without the line end.
/// - ok: the program ended; see `end`;
/// - unavailable: it could not be started;
/// - canceled: the context was canceled (the group is killed within 20 ms);
/// - internal_error: it was stopped at a time limit, or no pipe could be created.
Status run_child(const ChildRequest& request,
  const std::function<void(const std::string&)>& take_line, ChildEnd& end,
  ExecutionContext& context);

/// Return invalid_input for a time limit (seconds) that is not positive or a memory limit (MiB)
/// below 0.
Status check_limits(double time_limit, Index memory_limit);

/// Return " under a memory limit of 500 MiB", or an empty string without a limit.
std::string memory_words(Index memory_limit);

/// Report whether a path is an executable file.
bool executable_file(const std::string& path);

/// Return the path of a program in one of the folders of PATH, or an empty string if there is none.
std::string find_on_path(const std::string& program);

/// A file descriptor that is closed by the destructor.
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
