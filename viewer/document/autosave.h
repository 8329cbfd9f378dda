#ifndef document_autosave_h
#define document_autosave_h

#include "document/session.h"

#include <QDateTime>
#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>
#include <thread>
#include <vector>

class QLockFile;

/// Saves copies of the work to a folder of this process, for recovery after a crash. A copy is
/// written at most interval() seconds after a change, and immediately on request. The folder is
/// removed when the process ends normally. Without changes nothing is written.
///
/// A separate thread writes the files. It reads the window's datasets without copying them, because
/// nothing modifies these datasets. Only one copy is written at a time; a copy that is requested
/// meanwhile is written afterward. The destructor waits for the copy that is being written.
class Autosave : public QObject
{
  Q_OBJECT

public:
  using MakeSession = std::function<Session()>;

  /// @param root  the folder that will contain the folder of this process; empty: default_root()
  explicit Autosave(
    MakeSession make_session, const QString& root = QString(), QObject* parent = nullptr);
  ~Autosave() override;

  /// Return QStandardPaths::AppDataLocation/recovery.
  static QString default_root();
  /// Return the maximum time in seconds between a change and its copy: 60, or the value of the
  /// environment variable BINDPOSE_AUTOSAVE_SECONDS.
  static double interval();

  /// Record that the work has changed and a copy is due.
  void schedule_save();
  /// Begin to write a copy of the current work, and return. failed() is emitted if the copy cannot
  /// be written.
  void begin_save();
  /// Write a copy of the current work, and wait until it is on the disk.
  bindpose::Status save();
  bool is_saving() const { return this->writer_.joinable(); }
  /// Wait until all begun copies are on the disk, and return the status of the last one.
  bindpose::Status wait();
  /// Return the path of this process's session file; empty before the first save.
  QString path() const;
  /// Return the milliseconds that the last begin_save() took on the caller's thread.
  double milliseconds() const { return this->milliseconds_; }
  /// Return the milliseconds that the writer took for the last copy.
  double writing_milliseconds() const { return this->writing_milliseconds_; }

Q_SIGNALS:
  void failed(const QString& sentence);

private:
  bool make_folder();
  void start_writer();
  void end_writer();
  void report_status(const bindpose::Status& status);

  MakeSession make_session_;
  QString root_;
  QString folder_;
  std::unique_ptr<QLockFile> lock_;
  SessionFile file_;
  QTimer timer_;
  double milliseconds_ = 0.0;
  double writing_milliseconds_ = 0.0;
  std::thread writer_;
  int writer_count_ = 0; // number of writers that were started
  // The session that is being written, and the session to write next. Both must be destroyed on the
  // window's thread.
  std::shared_ptr<const SessionFile::PreparedSession> current_session_, next_session_;
  // Status of the running writer. The writer sets it; the window reads it only after the writer has
  // ended.
  bindpose::Status writer_status_;
  bindpose::Status status_; // status of the last copy that was written
};

/// The work that a crashed process left in its recovery folder. Other processes cannot find this
/// folder while the object exists.
class RecoveredWork
{
public:
  /// Return the latest work; null if there is none. Folders of running processes are skipped.
  static std::unique_ptr<RecoveredWork> find(const QString& root);
  ~RecoveredWork();

  QString path() const; ///< path of the session file
  QDateTime time() const { return this->time_; }
  /// Delete the recovered work.
  void remove();

private:
  RecoveredWork() = default;

  QString folder_;
  QDateTime time_;
  std::unique_ptr<QLockFile> lock_;
};

#endif
