#ifndef bindpose_cli_under_xvfb_h
#define bindpose_cli_under_xvfb_h

#include <string>
#include <vector>

namespace bindpose::cli
{

/// Becomes xvfb-run with the same command line (Arguments::words); returns only when that is
/// impossible.
void run_again_under_xvfb(const std::vector<std::string>& command_line);

} // namespace bindpose::cli

#endif
