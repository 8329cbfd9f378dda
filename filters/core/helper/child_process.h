#ifndef bindpose_helper_child_process_h
#define bindpose_helper_child_process_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <functional>
#include <string>
#include <vector>

namespace bindpose
{

/// A request to run a program in a separate process.
struct ChildRequest
{
  std::string name; ///< name of the program in messages
  std::string path; ///< path of the executable
  std::vector<std::string> arguments;
  std::string folder; ///< working folder; empty: working folder of this process
  int input = -1; ///< file descriptor for the standard input of the program, -1: no input
  /// File descriptor for the standard output of the program. -1: the lines of the output are passed
  /// to on_line, like those of standard error.
  int output = -1;
  double time_limit = 120.0; ///< the program is killed after this many seconds
  /// The program is killed after using this many seconds of processor time, 0: no limit. Processor
  /// time does not depend on the load of the machine.
  double processor_limit = 0.0;
  Index memory_limit = 0; ///< largest address space of the program in MiB, 0: no limit
  /// Called with the id of the process group when the program has started, and with 0 when the
  /// group has ended.
  std::function<void(int group)> started;
};

/// The way in which a program ended.
struct ChildEnd
{
  /// Phrase for messages, such as "was terminated by signal 11 (Segmentation fault)" or "failed
  /// with exit code 7"; empty for exit code 0.
  std::string failure;
  bool killed_by_signal = false;
  bool timed_out = false; ///< whether the program was stopped at one of its time limits
  double seconds = 0.0;
};

/// Run a program and wait for its end. The program leads a separate process group, which is always
/// killed before the function returns, so that no process that it started remains. The program
/// writes no core file. `on_line` is called in the current thread for each printed line, without
/// the line end. Return
/// - ok: the program ended; see `end`;
/// - unavailable: the program could not be started;
/// - canceled: the context was canceled (the group is killed within 20 ms);
/// - internal_error: the program was stopped at a time limit, or no pipe could be created.
Status run_child(ExecutionContext& context, const ChildRequest& request,
  const std::function<void(const std::string&)>& on_line, ChildEnd& end);

/// Return invalid_input if the time limit (seconds) is not positive or the memory limit (MiB) is
/// below 0.
Status check_limits(double time_limit, Index memory_limit);

/// Return a phrase for messages, for example " under a memory limit of 500 MiB"; empty without a
/// limit.
std::string memory_limit_phrase(Index memory_limit);

/// Report whether a path is an executable file.
bool is_executable_file(const std::string& path);

/// Search the folders of PATH for a program. Return the program's path, or an empty string if no
/// folder contains the program.
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
