// Progress, cancellation and computing time per phase. The progress callback is called at most
// every 50 ms, and at every change of phase.
#include "base/execution.h"

#include <algorithm>

namespace bindpose
{

ExecutionContext::ExecutionContext(ProgressCallback progress, CancelCallback cancel)
  : progress_(std::move(progress)), cancel_(std::move(cancel))
{
}

bool ExecutionContext::canceled() const
{
  if (this->canceled_.load(std::memory_order_relaxed))
  {
    return true;
  }
  if (this->cancel_ && this->cancel_())
  {
    this->canceled_.store(true, std::memory_order_relaxed);
    return true;
  }
  return false;
}

void ExecutionContext::progress(double fraction_of_phase)
{
  if (!this->progress_ || std::this_thread::get_id() != this->owner_)
  {
    return;
  }
  const double f = std::clamp(fraction_of_phase, 0.0, 1.0);
  this->emit(this->begin_ + f * (this->end_ - this->begin_), false);
}

void ExecutionContext::add_seconds(const std::string& phase, double seconds)
{
  this->seconds_.add("seconds." + phase, seconds);
}

double ExecutionContext::elapsed_seconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->start_).count();
}

void ExecutionContext::emit(double fraction_of_whole, bool force)
{
  if (!this->progress_)
  {
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (!force && now - this->last_emit_ < std::chrono::milliseconds(50))
  {
    return;
  }
  this->last_emit_ = now;
  // Report the largest fraction so far, because the reported progress must not decrease. A kernel
  // that repeats a part of its work reports smaller fractions again.
  this->largest_fraction_ = std::max(this->largest_fraction_, fraction_of_whole);
  this->progress_(this->largest_fraction_, this->phase_);
}

Phase::Phase(ExecutionContext& context, std::string name, double begin, double end)
  : context_(context), name_(std::move(name)), outer_name_(context.phase_),
    outer_begin_(context.begin_), outer_end_(context.end_), start_(std::chrono::steady_clock::now())
{
  const double length = this->outer_end_ - this->outer_begin_;
  context.begin_ = this->outer_begin_ + begin * length;
  context.end_ = this->outer_begin_ + end * length;
  context.phase_ = this->name_;
  context.emit(context.begin_, true);
}

Phase::~Phase()
{
  this->context_.add_seconds(this->name_, this->seconds());
  this->context_.emit(this->context_.end_, false);
  this->context_.begin_ = this->outer_begin_;
  this->context_.end_ = this->outer_end_;
  this->context_.phase_ = this->outer_name_;
}

ProgressRange::ProgressRange(ExecutionContext& context, double begin, double end)
  : context_(context), outer_begin_(context.begin_), outer_end_(context.end_)
{
  const double length = this->outer_end_ - this->outer_begin_;
  context.begin_ = this->outer_begin_ + begin * length;
  context.end_ = this->outer_begin_ + end * length;
}

ProgressRange::~ProgressRange()
{
  this->context_.begin_ = this->outer_begin_;
  this->context_.end_ = this->outer_end_;
}

double Phase::seconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->start_).count();
}

} // namespace bindpose
