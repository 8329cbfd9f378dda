// Handles SIGINT and SIGTERM. All threads block these signals. One thread waits for them with
// sigwait(), so it can run any code, unlike a signal handler. A signal handler would also miss
// signals: while METIS orders a matrix, it installs its own handler of SIGTERM. That handler ends
// the ordering and discards the signal. Child processes get an empty signal mask.
#include "cli/interrupt.h"

#include "io/atomic_file.h"

#include "vtkAlgorithm.h"

#include <atomic>
#include <csignal>
#include <mutex>
#include <thread>

#include <pthread.h>
#include <unistd.h>

namespace bindpose::cli
{

namespace
{
constexpr int exit_canceled = 4;

std::atomic<bool> signal_arrived{ false };
std::atomic<bool> signals_released{ false };
std::mutex running_mutex;
vtkAlgorithm* running_algorithm = nullptr;

sigset_t signals()
{
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

void block(int, char**, char**)
{
  const sigset_t set = signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

/// Block the signals before the constructors of libraries run. Some constructors start threads,
/// which inherit the signal mask.
__attribute__((section(".preinit_array"), used)) void (*const block_first)(
  int, char**, char**) = block;

void wait_for_signals()
{
  pthread_setname_np(pthread_self(), "signals");
  for (;;)
  {
    const sigset_t set = signals();
    int number = 0;
    if (sigwait(&set, &number) != 0)
    {
      return;
    }
    if (signals_released)
    {
      std::signal(number, SIG_DFL);
      pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
      kill(getpid(), number);
      return;
    }
    if (signal_arrived.exchange(true))
    {
      AtomicFile::discard_all();
      _exit(exit_canceled);
    }
    const std::lock_guard<std::mutex> lock(running_mutex);
    if (running_algorithm)
    {
      running_algorithm->SetAbortExecute(1);
    }
  }
}
} // namespace

void catch_interrupts()
{
  std::thread(wait_for_signals).detach();
}

void release_interrupts()
{
  signals_released = true;
}

bool interrupted()
{
  return signal_arrived.load();
}

AbortOnInterrupt::AbortOnInterrupt(vtkAlgorithm* algorithm)
{
  const std::lock_guard<std::mutex> lock(running_mutex);
  this->outer_algorithm_ = running_algorithm;
  running_algorithm = algorithm;
}

AbortOnInterrupt::~AbortOnInterrupt()
{
  const std::lock_guard<std::mutex> lock(running_mutex);
  running_algorithm = this->outer_algorithm_;
}

} // namespace bindpose::cli
