#ifndef document_autosave_h
#define document_autosave_h

#include "document/session.h"

#include <QDateTime>
#include <QObject>
#include <QTimer>

#include <functional>
#include <memory>
#include <vector>

class QLockFile;

/// Keeps a copy of the work in a folder of this process, against crashes: at most a minute after
/// something has changed, and at once when it is told to. The folder goes when the process ends as
/// it should. Nothing happens while nothing changes.
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
  /// A copy of what is now.
  bindpose::Status save();
  /// The session file of this process; empty as long as nothing was saved.
  QString path() const;
  /// How long the last copy took, milliseconds.
  double milliseconds() const { return this->milliseconds_; }

Q_SIGNALS:
  void failed(const QString& sentence);

private:
  bool make_folder();

  MakeSession make_session_;
  QString root_;
  QString folder_;
  std::unique_ptr<QLockFile> lock_;
  SessionFile file_;
  QTimer timer_;
  double milliseconds_ = 0.0;
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
