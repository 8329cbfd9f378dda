// Runs kernels in the background. Each job has one execution context. Progress is sent to the
// window's thread by queued signals. The cancel request is an atomic flag.
#include "app/parts/kernel_job.h"

#include <QString>

namespace app::parts
{

using namespace bindpose;

KernelJob::KernelJob(QObject* parent) : QObject(parent) {}

KernelJob::~KernelJob()
{
  this->cancel();
  if (this->thread_.joinable())
  {
    this->thread_.join();
  }
}

void KernelJob::start(JobFunction job_function)
{
  if (this->running_)
  {
    return;
  }
  if (this->thread_.joinable())
  {
    this->thread_.join();
  }
  this->running_ = true;
  this->cancel_requested_ = false;
  this->thread_ = std::thread(
    [this, job_function = std::move(job_function)]
    {
      ExecutionContext context(
        [this](double fraction, const std::string& phase)
        {
          const QString name = QString::fromStdString(phase);
          QMetaObject::invokeMethod(
            this, [this, fraction, name] { Q_EMIT this->progress(fraction, name); },
            Qt::QueuedConnection);
        },
        [this] { return this->cancel_requested_.load(); });
      Status status;
      try
      {
        status = job_function(context);
      }
      catch (const std::exception& error)
      {
        status = Status::failure(StatusCode::internal_error, error.what());
      }
      status.report.merge(context.seconds());
      status.report.set("seconds.total", context.elapsed_seconds());
      QMetaObject::invokeMethod(
        this,
        [this, status]
        {
          this->status_ = status;
          if (this->cancel_requested_) // canceled after the work has ended, but before finished()
          {
            this->status_ = Status::failure(StatusCode::canceled, "canceled");
          }
          this->running_ = false;
          Q_EMIT this->finished();
        },
        Qt::QueuedConnection);
    });
}

void KernelJob::cancel()
{
  this->cancel_requested_ = true;
}

} // namespace app::parts
