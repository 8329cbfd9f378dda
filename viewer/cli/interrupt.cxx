// The signal handler may do almost nothing, so it only writes a byte to a pipe; a thread reads the
// pipe and does the rest. Child processes get the default handlers back when they are executed.
#include "cli/interrupt.h"

#include "io/atomic_file.h"

#include "vtkAlgorithm.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

namespace bindpose::cli
{

namespace
{
constexpr int exit_cancelled = 4;

int pipe_ends[2] = { -1, -1 };
std::atomic<bool> signal_came{ false };
std::mutex running_mutex;
vtkAlgorithm* running = nullptr;

void handle_signal(int)
{
  const int saved = errno;
  const char byte = 1;
  const ssize_t written = write(pipe_ends[1], &byte, 1);
  static_cast<void>(written); // a full pipe: enough signals are on their way
  errno = saved;
}

void watch()
{
  for (;;)
  {
    char byte = 0;
    const ssize_t count = read(pipe_ends[0], &byte, 1);
    if (count < 0 && errno == EINTR)
    {
      continue;
    }
    if (count <= 0)
    {
      return;
    }
    if (signal_came.exchange(true))
    {
      AtomicFile::discard_all();
      _exit(exit_cancelled);
    }
    const std::lock_guard<std::mutex> lock(running_mutex);
    if (running)
    {
      running->SetAbortExecute(1);
    }
  }
}
} // namespace

void catch_interrupts()
{
  if (pipe2(pipe_ends, O_CLOEXEC) != 0)
  {
    return; // signals then kill, as they do by default
  }
  std::thread(watch).detach();
  struct sigaction action = {};
  action.sa_handler = handle_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void release_interrupts()
{
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool interrupted()
{
  return signal_came.load();
}

AbortOnInterrupt::AbortOnInterrupt(vtkAlgorithm* algorithm)
{
  const std::lock_guard<std::mutex> lock(running_mutex);
  this->outer_ = running;
  running = algorithm;
}

AbortOnInterrupt::~AbortOnInterrupt()
{
  const std::lock_guard<std::mutex> lock(running_mutex);
  running = this->outer_;
}

} // namespace bindpose::cli
