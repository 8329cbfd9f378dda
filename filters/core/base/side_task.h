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

/// Starts work on a separate thread before it is certain that the result is needed. The owner of
/// the task continues in parallel and decides later whether to use the result. Therefore an early
/// start changes only the time at which the result is available.
class SideTask
{
public:
  /// The work runs on one thread. The context that the work receives is canceled when the owner's
  /// context is canceled, and by the destructor.
  using Work = std::function<void(ExecutionContext& context)>;

  /// Start the work after `delay` seconds. If the context has only one thread, finish() does the
  /// work instead. The context must outlive the task.
  SideTask(ExecutionContext& context, double delay, Work work);
  /// Cancel the work and wait for its thread.
  ~SideTask();
  SideTask(const SideTask&) = delete;
  SideTask& operator=(const SideTask&) = delete;

  /// Drop the work if it has not started. Dropped work never starts; the owner can do it with its
  /// own threads and progress.
  /// @return whether the work was dropped.
  bool drop_unless_started();
  /// Start the work if it has not started, wait for its end, and rethrow its exception.
  void finish();

private:
  void run();

  const double delay_;
  ExecutionContext& context_;
  const Work work_;
  std::mutex mutex_;
  std::condition_variable condition_;
  bool started_ = false;
  bool finish_requested_ = false; ///< set by finish() to skip the rest of the delay
  std::atomic<bool> canceled_{ false }; ///< set when the work is dropped, and by the destructor
  bool finished_ = false;
  std::exception_ptr failure_;
  std::thread thread_; ///< not started if the context has only one thread
};

} // namespace bindpose

#endif
