#ifndef bindpose_base_execution_h
#define bindpose_base_execution_h

#include "base/status.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

namespace bindpose
{

/// Interface between a kernel and its caller: progress in named phases, cancellation, number of
/// threads, and computing time per phase. A default-constructed context uses all cores and has no
/// callbacks.
class ExecutionContext
{
public:
  /// Receives two values: the completed fraction of the whole computation, in [0, 1] and never
  /// decreasing, and the name of the phase. Called on the thread that created the context, at most
  /// every 50 ms and at every change of phase.
  using ProgressCallback = std::function<void(double fraction, const std::string& phase)>;
  /// Returns true if the computation must stop. Called on any thread, so it must be thread-safe and
  /// fast.
  using CancelCallback = std::function<bool()>;

  ExecutionContext() = default;
  ExecutionContext(ProgressCallback progress, CancelCallback cancel);
  ExecutionContext(const ExecutionContext&) = delete;
  ExecutionContext& operator=(const ExecutionContext&) = delete;

  /// Set the number of threads that a kernel may use; 0 (default): all cores. Results never depend
  /// on the number of threads.
  void set_threads(int threads) { this->threads_ = threads; }
  int threads() const { return this->threads_; }

  void request_cancel() { this->canceled_.store(true, std::memory_order_relaxed); }
  /// Report whether the computation is canceled. Thread-safe. Once true, the result stays true.
  /// Kernels call this function at least every 100 ms.
  bool canceled() const;

  /// Report progress within the current phase, in [0, 1]. Fast enough for frequent calls. Calls on
  /// threads other than the one that created the context are ignored, so that the bodies of
  /// parallel loops may call this function.
  void progress(double fraction_of_phase);

  /// Return the seconds spent in each phase, in the order in which the phases first began. If a
  /// phase ran several times, its value is the sum. The keys are "seconds.NAME" (see Report).
  const Report& seconds() const { return this->seconds_; }
  void add_seconds(const std::string& phase, double seconds);
  /// Return the seconds since the context was created.
  double elapsed_seconds() const;

private:
  friend class Phase;
  friend class ProgressRange;
  void emit(double fraction_of_whole, bool force);

  ProgressCallback progress_;
  CancelCallback cancel_;
  mutable std::atomic<bool> canceled_{ false };
  std::thread::id owner_ = std::this_thread::get_id();
  int threads_ = 0;
  double begin_ = 0.0; // range of the current phase as fractions of the whole computation
  double end_ = 1.0;
  double largest_fraction_ = 0.0; // largest fraction reported so far
  std::string phase_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_emit_{};
  Report seconds_;
};

/// Scope of one phase. The constructor sets the name of the current phase and maps progress to
/// [begin, end] of the enclosing phase. The destructor restores the enclosing phase and adds the
/// duration of this phase to ExecutionContext::seconds() (key "seconds.NAME"). The progress
/// callback receives the name unchanged.
class Phase
{
public:
  Phase(ExecutionContext& context, std::string name, double begin = 0.0, double end = 1.0);
  ~Phase();
  Phase(const Phase&) = delete;
  Phase& operator=(const Phase&) = delete;

  double seconds() const;

private:
  ExecutionContext& context_;
  std::string name_;
  std::string outer_name_;
  double outer_begin_, outer_end_;
  std::chrono::steady_clock::time_point start_;
};

/// Scope of an unnamed part of the current phase. It maps progress to [begin, end] of the enclosing
/// phase or range, so that progress never decreases from one part to the next.
class ProgressRange
{
public:
  ProgressRange(ExecutionContext& context, double begin, double end);
  ~ProgressRange();
  ProgressRange(const ProgressRange&) = delete;
  ProgressRange& operator=(const ProgressRange&) = delete;

private:
  ExecutionContext& context_;
  double outer_begin_, outer_end_;
};

} // namespace bindpose

#endif
