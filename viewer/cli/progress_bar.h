#ifndef bindpose_cli_progress_bar_h
#define bindpose_cli_progress_bar_h

#include <chrono>
#include <string>

namespace bindpose::cli
{

/// One line on the standard error: a bar, percent, the phase's name. Draws nothing unless the
/// standard error is a terminal.
class ProgressBar
{
public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar() { this->clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// fraction of the whole in [0, 1]; the bar never goes back
  void show(double fraction, const std::string& phase);
  /// Takes the line away, so that something else can be printed.
  void clear();

private:
  bool visible_ = false;
  bool drawn_ = false;
  double furthest_ = 0.0;
  std::string phase_;
  std::chrono::steady_clock::time_point last_{};
};

} // namespace bindpose::cli

#endif
