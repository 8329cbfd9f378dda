#ifndef bindpose_base_stopwatch_h
#define bindpose_base_stopwatch_h

#include <chrono>

namespace bindpose
{

/// Measures the seconds since its construction.
class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace bindpose

#endif
