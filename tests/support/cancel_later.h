#ifndef bindpose_tests_support_cancel_later_h
#define bindpose_tests_support_cancel_later_h

#include "base/execution.h"

#include <chrono>
#include <thread>

namespace bindpose::test
{

/// Requests a cancel from another thread, a given time after construction.
class CancelLater
{
public:
  CancelLater(ExecutionContext& context, int milliseconds)
    : user_(
        [this, &context, milliseconds]
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
          this->cancel_time_ = Clock::now();
          context.request_cancel();
        })
  {
  }
  ~CancelLater()
  {
    if (this->user_.joinable())
    {
      this->user_.join();
    }
  }
  CancelLater(const CancelLater&) = delete;
  CancelLater& operator=(const CancelLater&) = delete;

  /// Return the time in seconds since the cancel request. Call this function after the work has
  /// ended. The result is negative if the work ended before the request.
  double seconds_since_cancel()
  {
    const auto now = Clock::now();
    this->user_.join();
    return std::chrono::duration<double>(now - this->cancel_time_).count();
  }

private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point cancel_time_; // must be declared before the thread that writes it
  std::thread user_;
};

} // namespace bindpose::test

#endif
