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

/// How a kernel talks to whoever runs it: progress in named phases, cancel, number of threads,
/// seconds per phase. A default-made context runs on all cores, silently and to the end.
class ExecutionContext
{
public:
  /// fraction of the whole in [0, 1], never less than before, and the phase's name. Called on the
  /// thread that made the context, at most every 50 ms and at every change of phase.
  using ProgressCallback = std::function<void(double fraction, const std::string& phase)>;
  /// True once the user wants to stop. Called from any thread: must be thread-safe and cheap.
  using CancelCallback = std::function<bool()>;

  ExecutionContext() = default;
  ExecutionContext(ProgressCallback progress, CancelCallback cancel);
  ExecutionContext(const ExecutionContext&) = delete;
  ExecutionContext& operator=(const ExecutionContext&) = delete;

  /// Threads that a kernel may use; 0 (default): all cores. Results never depend on it.
  void set_threads(int threads) { this->threads_ = threads; }
  int threads() const { return this->threads_; }

  void request_cancel() { this->cancelled_.store(true, std::memory_order_relaxed); }
  /// Thread-safe. Once true it stays true. Kernels ask at least every 100 ms.
  bool cancelled() const;

  /// Progress within the current phase, in [0, 1]. Cheap; ignored on any other thread than the
  /// one that made the context, so that parallel bodies may call it freely.
  void progress(double fraction_of_phase);

  /// Seconds spent in each phase, summed over its runs, in order of first appearance: keys
  /// "seconds.NAME" (see Report).
  const Report& seconds() const { return this->seconds_; }
  void add_seconds(const std::string& phase, double seconds);
  /// Seconds since the context was made.
  double elapsed_seconds() const;

private:
  friend class Phase;
  friend class ProgressRange;
  void emit(double fraction_of_whole, bool force);

  ProgressCallback progress_;
  CancelCallback cancel_;
  mutable std::atomic<bool> cancelled_{ false };
  std::thread::id owner_ = std::this_thread::get_id();
  int threads_ = 0;
  double begin_ = 0.0; // the current phase's part of the whole
  double end_ = 1.0;
  double furthest_ = 0.0; // that was told
  std::string phase_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_emit_{};
  Report seconds_;
};

/// Scope of one phase: names what is being done, maps progress into [begin, end] of the enclosing
/// phase and adds its seconds to the context. The name is the key in the report
/// ("factor" -> "seconds.factor"); progress bars show it as it is.
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

/// Scope of a step of the current phase that has no name of its own: maps progress into
/// [begin, end] of the enclosing phase or range, so that steps one after another never go back.
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
