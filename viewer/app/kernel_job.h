#ifndef kernel_job_h
#define kernel_job_h

#include "base/execution.h"
#include "base/status.h"

#include <QObject>

#include <atomic>
#include <functional>
#include <thread>

/// Work by the kernels on a thread of its own. One at a time; destroying the job cancels it and
/// waits.
class KernelJob : public QObject
{
  Q_OBJECT

public:
  /// Runs on the thread: on copies, which it holds itself, as it holds what it makes.
  using Work = std::function<bindpose::Status(bindpose::ExecutionContext&)>;

  explicit KernelJob(QObject* parent = nullptr);
  ~KernelJob() override;

  /// Nothing happens while a job is running.
  void start(Work work);
  /// Ends the job soon; finished() still comes, with the status cancelled.
  void cancel();
  bool is_running() const { return this->running_; }
  /// How the last one went, with seconds.* in its report; to be read after finished().
  const bindpose::Status& status() const { return this->status_; }

Q_SIGNALS:
  /// Fraction of the whole in [0, 1] and the name of the phase. On the thread of this object.
  void progress(double fraction, const QString& phase);
  void finished();

private:
  std::thread thread_;
  std::atomic<bool> cancel_{ false };
  bool running_ = false;
  bindpose::Status status_;
};

#endif
