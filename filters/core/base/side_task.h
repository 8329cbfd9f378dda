#ifndef bindpose_base_side_task_h
#define bindpose_base_side_task_h

#include "base/execution.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace bindpose
{

/// Work that may be needed later, done on a thread of its own while the owner does something else.
/// The owner decides afterwards whether the result is used, so an early start changes how long it
/// takes to get a result, and nothing else.
class SideTask
{
public:
  /// Runs on one thread. Its context is cancelled when the owner's is, and by the destructor.
  using Work = std::function<void(ExecutionContext& context)>;

  /// Starts the work after `delay` seconds; if the context has one thread only, in finish(). The
  /// context must outlive the task.
  SideTask(double delay, ExecutionContext& context, Work work);
  /// Cancels the work and waits for its thread.
  ~SideTask();
  SideTask(const SideTask&) = delete;
  SideTask& operator=(const SideTask&) = delete;

  /// Starts the work if it has not started, waits for its end, and throws what it threw.
  void finish();

private:
  void run();

  const double delay_;
  ExecutionContext& context_;
  const Work work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool wanted_ = false; ///< finish() was called
  std::atomic<bool> dropped_{ false }; ///< by the destructor
  bool finished_ = false;
  std::exception_ptr failure_;
  std::thread thread_; ///< none if the context has one thread
};

} // namespace bindpose

#endif
