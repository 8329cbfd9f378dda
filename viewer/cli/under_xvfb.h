#ifndef bindpose_cli_under_xvfb_h
#define bindpose_cli_under_xvfb_h

#include <string>
#include <vector>

namespace bindpose::cli
{

/// Replace the process by xvfb-run with the same command line (Arguments::words), to draw without
/// an X server. The function returns only if xvfb-run cannot be started.
void run_again_under_xvfb(const std::vector<std::string>& command_line);

} // namespace bindpose::cli

#endif
