#ifndef bindpose_cli_progress_bar_h
#define bindpose_cli_progress_bar_h

#include <chrono>
#include <string>

namespace bindpose::cli
{

/// The form in which progress is written to the standard error.
enum class ProgressStyle
{
  none,
  bar, ///< one line that is redrawn; nothing if the standard error is not a terminal
  /// A new line "progress 42 % PHASE" for each new phase, and for each new percentage, but at most
  /// every 80 ms; for programs that run this one.
  lines
};

/// Writes the progress of a run to the standard error: the percentage and the name of the phase.
class ProgressBar
{
public:
  explicit ProgressBar(ProgressStyle style);
  ~ProgressBar() { this->clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Show a fraction of the whole work in [0, 1]; the progress never decreases.
  void show(double fraction, const std::string& phase);
  /// Remove the bar, so that other output can be printed.
  void clear();

private:
  void draw_bar(int percent);

  ProgressStyle style_;
  bool drawn_ = false;
  int printed_percent_ = -1;
  double maximum_fraction_ = 0.0;
  std::string phase_;
  std::chrono::steady_clock::time_point last_draw_time_{};
};

} // namespace bindpose::cli

#endif
