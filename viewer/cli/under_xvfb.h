#ifndef bindpose_cli_under_xvfb_h
#define bindpose_cli_under_xvfb_h

#include <string>
#include <vector>

namespace bindpose::cli
{

/// Replace the process by xvfb-run with the same command line (Arguments::words). Return only if
/// this is impossible.
void run_again_under_xvfb(const std::vector<std::string>& command_line);

} // namespace bindpose::cli

#endif
