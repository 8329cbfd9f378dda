#include "cli/under_xvfb.h"

#include "helper/child_process.h"

#include <cstdlib>

#include <unistd.h>

namespace bindpose::cli
{

namespace
{
constexpr const char* under_xvfb = "BINDPOSE_UNDER_XVFB";
} // namespace

void run_again_under_xvfb(const std::vector<std::string>& command_line)
{
  if (std::getenv(under_xvfb) || find_on_path("xvfb-run").empty() || find_on_path("Xvfb").empty())
  {
    return;
  }
  setenv(under_xvfb, "1", 1);
  char executable_path[4096];
  const ssize_t length = readlink("/proc/self/exe", executable_path, sizeof(executable_path) - 1);
  if (length <= 0)
  {
    return;
  }
  executable_path[length] = 0;
  // Use -noreset. A server that resets itself sends a signal to xvfb-run. Then xvfb-run may exit
  // with code 5 instead of the exit code of this program.
  std::vector<std::string> words{ "xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset",
    executable_path };
  words.insert(words.end(), command_line.begin(), command_line.end());
  std::vector<char*> argv;
  for (std::string& word : words)
  {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
}

} // namespace bindpose::cli
