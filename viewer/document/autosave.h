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

/// Keeps a copy of the work in a folder of this process, against crashes: at most a minute after
/// something has changed, and at once when it is told to. The folder goes when the process ends as
/// it should. Nothing happens while nothing changes.
///
/// Files are written on a thread of their own: what is copied are shared datasets that nobody
/// changes. One copy at a time; what is asked for meanwhile follows it. The end waits for it.
class Autosave : public QObject
{
  Q_OBJECT

public:
  using MakeSession = std::function<Session()>;

  /// Under the root; without one under default_root().
  explicit Autosave(
    MakeSession make_session, const QString& root = QString(), QObject* parent = nullptr);
  ~Autosave() override;

  /// QStandardPaths::AppDataLocation/recovery.
  static QString default_root();
  /// Seconds between a change and its copy: 60, or the environment's BINDPOSE_AUTOSAVE_SECONDS.
  static double interval();

  /// Something has changed.
  void note_change();
  /// A copy of what is now, begun. The caller goes on; failed() tells when it cannot be written.
  void begin_save();
  /// A copy of what is now, on the disk.
  bindpose::Status save();
  bool is_saving() const { return this->writer_.joinable(); }
  /// Until what was begun is on the disk; how the last copy went.
  bindpose::Status wait();
  /// The session file of this process; empty as long as nothing was saved.
  QString path() const;
  /// Milliseconds that the last begin_save() took on the caller's thread.
  double milliseconds() const { return this->milliseconds_; }
  /// Milliseconds that the last copy took to write.
  double writing_milliseconds() const { return this->writing_milliseconds_; }

Q_SIGNALS:
  void failed(const QString& sentence);

private:
  bool make_folder();
  void start_writer();
  void end_writer();
  void end_with(const bindpose::Status& status);

  MakeSession make_session_;
  QString root_;
  QString folder_;
  std::unique_ptr<QLockFile> lock_;
  SessionFile file_;
  QTimer timer_;
  double milliseconds_ = 0.0;
  double writing_milliseconds_ = 0.0;
  std::thread writer_;
  int round_ = 0; // of the writer
  std::shared_ptr<const SessionFile::Prepared> writing_, next_; // dropped on this thread
  bindpose::Status written_; // by the writer; read after it has ended
  bindpose::Status status_; // of the last copy
};

/// What a process that has died left in the recovery folder. As long as this exists no other
/// process finds it.
class RecoveredWork
{
public:
  /// The latest one; null without. Folders of living processes are left alone.
  static std::unique_ptr<RecoveredWork> find(const QString& root);
  ~RecoveredWork();

  QString path() const; ///< of its session file
  QDateTime time() const { return this->time_; }
  /// It is no longer needed.
  void remove();

private:
  RecoveredWork() = default;

  QString folder_;
  QDateTime time_;
  std::unique_ptr<QLockFile> lock_;
};

#endif
