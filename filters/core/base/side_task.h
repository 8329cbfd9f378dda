#ifndef bindpose_base_side_task_h
#define bindpose_base_side_task_h

#include "base/execution.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace bindpose
{

/// Work that may be needed later, begun on a thread of its own while its maker does something else
/// for a long time. Whether it is begun early changes when it ends, not what it gives: the maker
/// decides what to take.
class SideTask
{
public:
  /// Runs on one thread, with a context that is cancelled when the task or the maker's context is.
  using Work = std::function<void(ExecutionContext& context)>;

  /// Begins the work after `delay` seconds. Where the context has one thread only, the work waits
  /// for finish(). The context must outlive the task.
  SideTask(double delay, ExecutionContext& context, Work work);
  /// Cancels what is not finished.
  ~SideTask();
  SideTask(const SideTask&) = delete;
  SideTask& operator=(const SideTask&) = delete;

  /// Begins the work if it has not begun, and waits for its end.
  void finish();

private:
  void run();

  const double delay_;
  ExecutionContext& context_;
  const Work work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool wanted_ = false; ///< now
  bool dropped_ = false;
  bool done_ = false;
  std::thread thread_; ///< none where the context has one thread
};

} // namespace bindpose

#endif
