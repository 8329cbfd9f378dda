#ifndef bindpose_helper_helper_process_h
#define bindpose_helper_helper_process_h

#include "base/execution.h"
#include "helper/child_process.h"

#include <string>
#include <vector>

namespace bindpose
{

/// One of Bindpose's helper executables. A helper uses a library that may crash, hang or take all
/// memory on bad input, so it runs in a separate process.
struct Helper
{
  const char* program; ///< file name of the executable: "bindpose-mesher"
  const char* variable; ///< environment variable with the executable's path: "BINDPOSE_MESHER"
  const char* missing; ///< message if the executable is not found
};

/// One run of a helper.
struct HelperRequest
{
  std::string name; ///< name of the run in messages: "bindpose-mesher refine"
  std::vector<std::string> arguments;
  int input = -1; ///< file descriptor of the standard input, -1: no input
  double time_limit = 120.0; ///< the helper is killed after this many seconds
  /// The helper is killed after using this many seconds of processor time, 0: no limit.
  double processor_limit = 0.0;
  Index memory_limit = 0; ///< limit of the helper's address space in MiB, 0: no limit
};

/// The result of a run.
struct HelperRun
{
  Report report; ///< values that the helper reported, with the helper's keys
  std::vector<std::string> warnings;
  double seconds = 0.0;
  bool timed_out = false; ///< whether the helper was stopped at one of its time limits
};

/// Return the path of a helper, or an empty string if it is not found. If its environment variable
/// is set, only this path is used. Otherwise these folders are searched in this order, where LIB is
/// the folder of the library that contains this function:
/// - LIB, LIB/../bin and LIB/../../bin
/// - the folder of the running executable
/// - the build tree
std::string find_helper(const Helper& helper);

/// Create an anonymous memory file that programs started later do not inherit. Its descriptor is
/// larger than 2. Return -1 if that fails.
int anonymous_file(const char* name);

/// Run a helper and wait for its end. The helper writes its result to standard output, which is the
/// file descriptor `output`. On standard error, the helper prints lines of these forms: "progress
/// FRACTION", "report KEY NUMBER", "warning TEXT", "error TEXT". The fraction becomes the progress
/// of the current phase. Any other line is output of a library. If the helper crashes, or fails
/// without an "error" line, the last of these other lines becomes part of the error message. Return
/// - unavailable: the helper is not found;
/// - canceled: the context was canceled (the helper is killed within 20 ms);
/// - internal_error: the helper crashed, ended with an error, or ran out of time or memory; the
///   message contains the reason.
Status run_helper(ExecutionContext& context, const Helper& helper, const HelperRequest& request,
  int output, HelperRun& run);

} // namespace bindpose

#endif
