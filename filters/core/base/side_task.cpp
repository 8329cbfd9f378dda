// A task that starts on a separate thread after a delay. It is canceled when its owner's context is
// canceled.
#include "base/side_task.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace bindpose
{

SideTask::SideTask(ExecutionContext& context, double delay, Work work)
  : delay_(delay), context_(context), work_(std::move(work))
{
  const bool one_thread = context.threads() == 1 || std::thread::hardware_concurrency() == 1;
  if (!one_thread)
  {
    try
    {
      this->thread_ = std::thread([this] { this->run(); });
    }
    catch (const std::system_error&)
    {
      // No thread is available, so finish() does the work.
    }
  }
}

SideTask::~SideTask()
{
  {
    const std::lock_guard<std::mutex> lock(this->mutex_);
    this->canceled_ = true;
  }
  this->condition_.notify_all();
  if (this->thread_.joinable())
  {
    this->thread_.join();
  }
}

void SideTask::run()
{
  {
    std::unique_lock<std::mutex> lock(this->mutex_);
    this->condition_.wait_for(lock, std::chrono::duration<double>(this->delay_),
      [this] { return this->finish_requested_ || this->canceled_; });
    if (this->canceled_)
    {
      return;
    }
    this->started_ = true;
  }
  ExecutionContext context({}, [this] { return this->canceled_ || this->context_.canceled(); });
  context.set_threads(1);
  try
  {
    this->work_(context);
  }
  catch (...)
  {
    this->failure_ = std::current_exception();
  }
}

bool SideTask::drop_unless_started()
{
  {
    const std::lock_guard<std::mutex> lock(this->mutex_);
    if (this->started_)
    {
      return false;
    }
    this->canceled_ = true;
  }
  this->condition_.notify_all();
  return true;
}

void SideTask::finish()
{
  if (this->finished_)
  {
    return;
  }
  this->finished_ = true;
  if (!this->thread_.joinable())
  {
    this->work_(this->context_);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(this->mutex_);
    this->finish_requested_ = true;
  }
  this->condition_.notify_all();
  this->thread_.join();
  if (this->failure_)
  {
    std::rethrow_exception(this->failure_);
  }
}

} // namespace bindpose
