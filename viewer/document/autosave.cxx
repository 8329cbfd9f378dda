// Saves copies of the work for recovery after a crash. Each process has one folder,
// ROOT/PID-RANDOM, with a lock file that names the process. If another process can acquire the lock
// of a folder, the process of this folder has ended.
#include "document/autosave.h"

#include <QCoreApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QLockFile>
#include <QRandomGenerator>
#include <QStandardPaths>

#include <algorithm>

using namespace bindpose;

namespace
{
constexpr double default_interval = 60.0; // seconds
const char* const session_file_name = "work.bindpose";

std::unique_ptr<QLockFile> lock_of(const QString& folder)
{
  auto lock = std::make_unique<QLockFile>(folder + "/lock");
  lock->setStaleLockTime(0); // a lock is stale only if its process has ended
  return lock;
}
} // namespace

Autosave::Autosave(MakeSession make_session, const QString& root, QObject* parent)
  : QObject(parent), make_session_(std::move(make_session)),
    root_(root.isEmpty() ? default_root() : root)
{
  this->timer_.setSingleShot(true);
  this->timer_.setInterval(static_cast<int>(1000.0 * interval()));
  QObject::connect(&this->timer_, &QTimer::timeout, this, &Autosave::begin_save);
}

Autosave::~Autosave()
{
  this->next_session_ = nullptr; // discard the pending copy, because the folder is removed next
  if (this->is_saving())
  {
    this->writer_.join();
  }
  if (!this->folder_.isEmpty())
  {
    this->lock_->unlock();
    QDir(this->folder_).removeRecursively();
  }
}

QString Autosave::default_root()
{
  return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/recovery";
}

double Autosave::interval()
{
  bool is_number = false;
  const double seconds = qEnvironmentVariable("BINDPOSE_AUTOSAVE_SECONDS").toDouble(&is_number);
  return is_number && seconds >= 0.0 ? std::min(seconds, 86400.0) : default_interval;
}

void Autosave::schedule_save()
{
  if (!this->timer_.isActive())
  {
    this->timer_.start();
  }
}

QString Autosave::path() const
{
  return this->folder_.isEmpty() ? QString() : this->folder_ + '/' + session_file_name;
}

/// Create the folder of this process before the first save.
bool Autosave::make_folder()
{
  // Before a new folder is locked, another process may find it and remove it. If the folder was
  // removed, try again with another one.
  constexpr int maximum_attempts = 8;
  for (int k = 0; k < maximum_attempts && this->folder_.isEmpty(); ++k)
  {
    const QString folder = QString("%1/%2-%3")
                             .arg(this->root_)
                             .arg(QCoreApplication::applicationPid())
                             .arg(QRandomGenerator::global()->generate(), 8, 16, QChar('0'));
    auto lock = lock_of(folder);
    if (QDir().mkpath(folder) && lock->tryLock(0))
    {
      this->folder_ = folder;
      this->lock_ = std::move(lock);
    }
  }
  return !this->folder_.isEmpty();
}

void Autosave::begin_save()
{
  QElapsedTimer clock;
  clock.start();
  this->timer_.stop();
  if (this->make_folder())
  {
    this->next_session_ = SessionFile::prepare(this->path(), this->make_session_());
    if (!this->is_saving())
    {
      this->start_writer();
    }
  }
  else
  {
    this->report_status(Status::invalid_input("cannot write to " + this->root_.toStdString()));
  }
  this->milliseconds_ = 1e-6 * static_cast<double>(clock.nsecsElapsed());
}

void Autosave::start_writer()
{
  this->current_session_ = std::move(this->next_session_);
  this->writer_ = std::thread(
    [this, writer_number = ++this->writer_count_]
    {
      QElapsedTimer clock;
      clock.start();
      try
      {
        this->writer_status_ = this->file_.write(*this->current_session_);
      }
      catch (const std::exception& error)
      {
        this->writer_status_ = Status::failure(StatusCode::internal_error, error.what());
      }
      this->writing_milliseconds_ = 1e-6 * static_cast<double>(clock.nsecsElapsed());
      QMetaObject::invokeMethod(
        this,
        [this, writer_number]
        {
          // If wait() has already ended this writer, there is nothing to do.
          if (this->is_saving() && writer_number == this->writer_count_)
          {
            this->end_writer();
          }
        },
        Qt::QueuedConnection);
    });
}

void Autosave::end_writer()
{
  this->writer_.join();
  this->current_session_ = nullptr;
  const Status status = this->writer_status_;
  if (this->next_session_)
  {
    this->start_writer();
  }
  this->report_status(status);
}

void Autosave::report_status(const Status& status)
{
  this->status_ = status;
  if (!status.ok())
  {
    Q_EMIT this->failed(
      tr("The work is not being backed up: %1.").arg(QString::fromStdString(status.message)));
  }
}

Status Autosave::wait()
{
  while (this->is_saving())
  {
    this->end_writer();
  }
  return this->status_;
}

Status Autosave::save()
{
  this->begin_save();
  return this->wait();
}

// ---- After a crash -----------------------------------------------------------------------------

std::unique_ptr<RecoveredWork> RecoveredWork::find(const QString& root)
{
  std::unique_ptr<RecoveredWork> latest;
  for (const QFileInfo& folder : QDir(root).entryInfoList(QDir::Dirs | QDir::NoDotAndDotDot))
  {
    auto lock = lock_of(folder.filePath());
    if (!lock->tryLock(0))
    {
      continue; // the process of this folder is running
    }
    const QFileInfo session(folder.filePath() + '/' + session_file_name);
    if (!session.exists())
    {
      lock->unlock();
      // The process of this folder ended before its first save.
      QDir(folder.filePath()).removeRecursively();
      continue;
    }
    if (latest && latest->time_ >= session.lastModified())
    {
      continue;
    }
    latest.reset(new RecoveredWork);
    latest->folder_ = folder.filePath();
    latest->time_ = session.lastModified();
    latest->lock_ = std::move(lock);
  }
  return latest;
}

RecoveredWork::~RecoveredWork() = default;

QString RecoveredWork::path() const
{
  return this->folder_ + '/' + session_file_name;
}

void RecoveredWork::remove()
{
  if (!this->folder_.isEmpty())
  {
    this->lock_->unlock();
    QDir(this->folder_).removeRecursively();
    this->folder_.clear();
  }
}
