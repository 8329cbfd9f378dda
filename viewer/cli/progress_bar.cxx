#include "cli/progress_bar.h"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace bindpose::cli
{

ProgressBar::ProgressBar(ProgressStyle style)
  : style_(style == ProgressStyle::bar && !isatty(STDERR_FILENO) ? ProgressStyle::none : style)
{
}

void ProgressBar::show(double fraction, const std::string& phase)
{
  const auto now = std::chrono::steady_clock::now();
  const bool new_phase = phase != this->phase_;
  if (this->style_ == ProgressStyle::none ||
    (!new_phase && now - this->last_draw_time_ < std::chrono::milliseconds(80)))
  {
    return;
  }
  this->last_draw_time_ = now;
  this->phase_ = phase;
  this->maximum_fraction_ = std::max(this->maximum_fraction_, std::clamp(fraction, 0.0, 1.0));
  const int percent = static_cast<int>(100 * this->maximum_fraction_);
  if (this->style_ == ProgressStyle::bar)
  {
    this->draw_bar(percent);
  }
  else if (new_phase || percent != this->printed_percent_)
  {
    std::fprintf(stderr, "progress %d %% %s\n", percent, phase.c_str());
    std::fflush(stderr);
    this->printed_percent_ = percent;
  }
}

void ProgressBar::draw_bar(int percent)
{
  this->drawn_ = true;
  constexpr int width = 30;
  const int full = static_cast<int>(this->maximum_fraction_ * width);
  const std::string bar =
    std::string(static_cast<std::size_t>(full), '#') + std::string(width - full, '-');
  std::fprintf(stderr, "\r[%s] %3d %%  %s\033[K", bar.c_str(), percent, this->phase_.c_str());
  std::fflush(stderr);
}

void ProgressBar::clear()
{
  if (this->drawn_)
  {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    this->drawn_ = false;
    this->phase_.clear();
  }
}

} // namespace bindpose::cli
