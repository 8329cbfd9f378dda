#ifndef bindpose_tests_support_processes_h
#define bindpose_tests_support_processes_h

#include <chrono>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include <sys/types.h>

namespace bindpose::test
{

inline std::size_t open_descriptors()
{
  const auto files = std::filesystem::directory_iterator("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

/// Report whether a process has ended: it does not exist, or it is a zombie that its parent has not
/// reaped yet.
inline bool has_exited(pid_t process)
{
  if (::kill(process, 0) != 0)
  {
    return true;
  }
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string id, name, state;
  file >> id >> name >> state;
  return state.empty() || state == "Z" || state == "X";
}

/// Wait until the condition is true, for at most 5 s. Return whether it is true.
inline bool wait_until(const std::function<bool()>& condition)
{
  for (int i = 0; i < 500 && !condition(); ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return condition();
}

} // namespace bindpose::test

#endif
