#ifndef bindpose_tests_support_cancel_later_h
#define bindpose_tests_support_cancel_later_h

#include "base/execution.h"

#include <chrono>
#include <thread>

namespace bindpose::test
{

/// Requests a cancel from another thread, a given time after construction.
class DelayedCancel
{
public:
  DelayedCancel(ExecutionContext& context, int milliseconds)
    : cancel_thread_(
        [this, &context, milliseconds]
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
          this->cancel_time_ = Clock::now();
          context.request_cancel();
        })
  {
  }
  ~DelayedCancel()
  {
    if (this->cancel_thread_.joinable())
    {
      this->cancel_thread_.join();
    }
  }
  DelayedCancel(const DelayedCancel&) = delete;
  DelayedCancel& operator=(const DelayedCancel&) = delete;

  /// Return the time in seconds since the cancel request. Call this function after the work has
  /// ended. The result is negative if the work ended before the request.
  double seconds_since_cancel()
  {
    const auto now = Clock::now();
    this->cancel_thread_.join();
    return std::chrono::duration<double>(now - this->cancel_time_).count();
  }

private:
  using Clock = std::chrono::steady_clock;

  /// Time of the cancel request. The thread starts during construction and writes to this member.
  /// Therefore the member is declared before cancel_thread_.
  Clock::time_point cancel_time_;
  std::thread cancel_thread_;
};

} // namespace bindpose::test

#endif
