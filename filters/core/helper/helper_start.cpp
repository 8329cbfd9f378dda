// Preparation of the process of a helper executable (see helper_start.h).
#include "helper/helper_start.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace bindpose
{

namespace
{
/// Make this process end when its parent ends. If the parent ended before this request, the parent
/// id is different and the helper fails.
void exit_with_parent(pid_t parent)
{
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (parent > 0 && ::getppid() != parent)
  {
    helper_fail("the parent process has ended");
  }
}

void set_limits(double memory_mib)
{
  // Crashes are expected in this process, so no core files are written.
  const rlimit none{ 0, 0 };
  ::setrlimit(RLIMIT_CORE, &none);
  if (memory_mib > 0.0)
  {
    const auto bytes = static_cast<rlim_t>(memory_mib * 1048576.0);
    const rlimit memory{ bytes, bytes };
    ::setrlimit(RLIMIT_AS, &memory);
  }
  std::set_new_handler([] { helper_fail("out of memory"); });
}

/// Change to a folder in which no file can be created. CGAL writes input that it cannot mesh to the
/// working folder ("dump-bug.mesh"), and the working folder may belong to the user.
void leave_working_folder()
{
  if (::chdir("/proc") != 0 && ::chdir("/") != 0)
  {
    helper_fail("cannot change the working folder");
  }
}
} // namespace

HelperOptions helper_options(int argc, char* argv[], int skipped)
{
  HelperOptions options;
  for (int i = 1 + skipped; i + 1 < argc; i += 2)
  {
    options[argv[i]] = argv[i + 1];
  }
  return options;
}

double helper_number(const HelperOptions& options, const std::string& name, double fallback)
{
  const auto entry = options.find(name);
  return entry == options.end() ? fallback : std::atof(entry->second.c_str());
}

void helper_warn(const std::string& text)
{
  std::fprintf(stderr, "warning %s\n", text.c_str());
}

void helper_fail(const std::string& reason)
{
  std::fprintf(stderr, "error %s\n", reason.c_str());
  std::fflush(stderr);
  std::_Exit(1);
}

int start_helper(const HelperOptions& options)
{
  exit_with_parent(static_cast<pid_t>(helper_number(options, "--parent", 0.0)));
  set_limits(helper_number(options, "--memory", 0.0));
  leave_working_folder();
  // Libraries print to standard output. It is redirected to standard error, so that only the result
  // is written to the original standard output.
  const int result = ::dup(1);
  ::dup2(2, 1);
  return result;
}

void end_helper()
{
  std::fflush(stderr);
  std::_Exit(0);
}

} // namespace bindpose
