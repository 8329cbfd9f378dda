#ifndef bindpose_helper_helper_start_h
#define bindpose_helper_helper_start_h

// Functions for the main() of a helper executable. An application runs such an executable by the
// functions in helper_process.h.

#include <map>
#include <string>

namespace bindpose
{

/// Pairs of an option and its value, as on the command line: "--parent" -> "1234".
using HelperOptions = std::map<std::string, std::string>;

/// Return the options that follow the first `skipped` arguments.
HelperOptions helper_options(int argc, char* argv[], int skipped);

/// Return an option as a number, or the fallback if it is absent.
double helper_number(const HelperOptions& options, const std::string& name, double fallback);

/// Print a warning of this helper, in one line.
void helper_warn(const std::string& text);

/// Print the reason as the error of this helper, and end the process with code 1.
[[noreturn]] void helper_fail(const std::string& reason);

/// Prepare the process of a helper: it ends when its parent ends (--parent), has a memory limit
/// (--memory, MiB), writes no core files, cannot create files in the working folder, and prints all
/// output of libraries to standard error.
/// @return the file descriptor for the result.
int start_helper(const HelperOptions& options);

/// End the process with code 0, without calling the destructors of static objects of libraries.
[[noreturn]] void end_helper();

} // namespace bindpose

#endif
