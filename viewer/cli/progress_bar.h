#ifndef bindpose_cli_progress_bar_h
#define bindpose_cli_progress_bar_h

#include <chrono>
#include <string>

namespace bindpose::cli
{

/// Draws one line on the standard error: a bar, the percentage, and the name of the phase. It draws
/// nothing if the standard error is not a terminal.
class ProgressBar
{
public:
  explicit ProgressBar(bool enabled);
  ~ProgressBar() { this->clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draw the bar for a fraction of the whole work in [0, 1]; the bar never moves backwards.
  void show(double fraction, const std::string& phase);
  /// Remove the line, so that other output can be printed.
  void clear();

private:
  bool visible_ = false;
  bool drawn_ = false;
  double maximum_fraction_ = 0.0;
  std::string phase_;
  std::chrono::steady_clock::time_point last_draw_time_{};
};

} // namespace bindpose::cli

#endif
