// Memory of the process and limits for it, as reported by the system.
//
// On Linux, /proc/self/statm and status describe the process, and MemAvailable of /proc/meminfo
// describes the machine (free pages and caches that can be freed). The files memory.max and
// memory.current describe the process's control group and all enclosing groups.
#include "base/memory.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace bindpose
{

namespace
{
constexpr double unknown = std::numeric_limits<double>::infinity();

#ifdef __linux__
/// Sizes from /proc/self/statm, in bytes.
struct Pages
{
  double address_space = 0.0;
  double resident = 0.0;
};

Pages own_pages()
{
  Pages pages;
  std::ifstream("/proc/self/statm") >> pages.address_space >> pages.resident;
  const auto size = static_cast<double>(::sysconf(_SC_PAGESIZE));
  pages.address_space *= size;
  pages.resident *= size;
  return pages;
}

/// Return the bytes of a line "KEY: NUMBER kB", or `fallback` if there is no such line.
double read_kibibytes(const char* path, const std::string& key, double fallback)
{
  std::ifstream file(path);
  for (std::string word; file >> word; std::getline(file, word))
  {
    double kibibytes = 0.0;
    if (word == key && file >> kibibytes)
    {
      return kibibytes * 1024.0;
    }
  }
  return fallback;
}

double unused_address_space()
{
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
  {
    return unknown;
  }
  return static_cast<double>(limit.rlim_cur) - own_pages().address_space;
}

double unused_group_memory()
{
  // In the unified hierarchy (version 2), the control group of the process is in a line "0::/path".
  std::string group;
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);)
  {
    if (line.compare(0, 3, "0::") == 0)
    {
      group = line.substr(3);
    }
  }
  double least = unknown;
  while (!group.empty())
  {
    const std::string folder = "/sys/fs/cgroup" + (group == "/" ? std::string() : group);
    double maximum = 0.0;
    double current = 0.0;
    // "max" is not a number and means no limit.
    if (std::ifstream(folder + "/memory.max") >> maximum &&
      std::ifstream(folder + "/memory.current") >> current)
    {
      least = std::min(least, maximum - current);
    }
    group.resize(group == "/" ? 0 : std::max<std::size_t>(group.rfind('/'), 1));
  }
  return least;
}
#endif
} // namespace

double resident_memory()
{
#ifdef __linux__
  return own_pages().resident;
#else
  return 0.0;
#endif
}

double peak_memory()
{
#ifdef __linux__
  return read_kibibytes("/proc/self/status", "VmHWM:", 0.0);
#else
  return 0.0;
#endif
}

double available_memory()
{
#ifdef __linux__
  return std::max(0.0,
    std::min({ read_kibibytes("/proc/meminfo", "MemAvailable:", unknown), unused_address_space(),
      unused_group_memory() }));
#else
  return unknown;
#endif
}

double remaining_memory(Index limit)
{
  const double available = available_memory();
  return limit > 0
    ? std::max(0.0, std::min(available, static_cast<double>(limit) * mebibyte - resident_memory()))
    : available;
}

Status check_memory(const std::string& subject, double bytes, Index limit)
{
  const double left = remaining_memory(limit);
  if (bytes <= left)
  {
    return {};
  }
  const double resident_bytes = resident_memory();
  const double allowed = static_cast<double>(limit) * mebibyte;
  const bool limit_is_set_by_user = limit > 0 && allowed - resident_bytes <= available_memory();
  const auto format_mebibytes = [](double size)
  { return std::to_string(static_cast<long long>(std::ceil(size / mebibyte))) + " MiB"; };
  return Status::failure(StatusCode::internal_error,
    subject + " would increase the memory of this process to about " +
      format_mebibytes(resident_bytes + bytes) + "; " +
      (limit_is_set_by_user
          ? "the limit is " + format_mebibytes(allowed) + ": use a coarser mesh or a higher limit"
          : "only " + format_mebibytes(resident_bytes + left) +
            " are available: use a coarser mesh"));
}

} // namespace bindpose
