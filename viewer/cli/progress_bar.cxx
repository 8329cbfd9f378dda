#include "cli/progress_bar.h"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace bindpose::cli
{

ProgressBar::ProgressBar(bool enabled) : visible_(enabled && isatty(STDERR_FILENO)) {}

void ProgressBar::show(double fraction, const std::string& phase)
{
  const auto now = std::chrono::steady_clock::now();
  if (!this->visible_ ||
    (phase == this->phase_ && now - this->last_draw_time_ < std::chrono::milliseconds(80)))
  {
    return;
  }
  this->last_draw_time_ = now;
  this->phase_ = phase;
  this->drawn_ = true;
  constexpr int width = 30;
  this->maximum_fraction_ = std::max(this->maximum_fraction_, std::clamp(fraction, 0.0, 1.0));
  const double f = this->maximum_fraction_;
  const int full = static_cast<int>(f * width);
  const std::string bar =
    std::string(static_cast<std::size_t>(full), '#') + std::string(width - full, '-');
  std::fprintf(
    stderr, "\r[%s] %3d %%  %s\033[K", bar.c_str(), static_cast<int>(100 * f), phase.c_str());
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
