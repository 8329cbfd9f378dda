#include "cli/progress_bar.h"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace bindpose::cli
{

ProgressBar::ProgressBar(bool wanted) : visible_(wanted && isatty(STDERR_FILENO)) {}

void ProgressBar::show(double fraction, const std::string& phase)
{
  const auto now = std::chrono::steady_clock::now();
  if (!this->visible_ ||
    (phase == this->phase_ && now - this->last_ < std::chrono::milliseconds(80)))
  {
    return;
  }
  this->last_ = now;
  this->phase_ = phase;
  this->drawn_ = true;
  constexpr int width = 30;
  this->furthest_ = std::max(this->furthest_, std::clamp(fraction, 0.0, 1.0));
  const double f = this->furthest_;
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
