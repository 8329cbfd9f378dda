#ifndef app_parts_kernel_job_h
#define app_parts_kernel_job_h

#include "base/execution.h"
#include "base/status.h"

#include <QObject>

#include <atomic>
#include <functional>
#include <thread>

namespace app::parts
{

/// Runs kernels on a separate thread. One job runs at a time. Destroying the object cancels the job
/// and waits for its end.
class KernelJob : public QObject
{
  Q_OBJECT

public:
  /// The function that runs on the thread. It must own copies of its input, and write its output to
  /// objects that it shares by shared pointers.
  using JobFunction = std::function<bindpose::Status(bindpose::ExecutionContext&)>;

  explicit KernelJob(QObject* parent = nullptr);
  ~KernelJob() override;

  /// Start a job. Do nothing if a job is running.
  void start(JobFunction job_function);
  /// Request cancellation of the job. finished() is still emitted, with the status canceled.
  void cancel();
  bool is_running() const { return this->running_; }
  /// Return the status of the last job; valid after finished(). Its report contains durations, in
  /// entries whose names begin with "seconds.".
  const bindpose::Status& status() const { return this->status_; }

Q_SIGNALS:
  /// Emitted on the thread of this object. `fraction` is the progress of the whole job in [0, 1].
  void progress(double fraction, const QString& phase);
  void finished();

private:
  std::thread thread_;
  std::atomic<bool> cancel_requested_{ false };
  bool running_ = false;
  bindpose::Status status_;
};

} // namespace app::parts

#endif
