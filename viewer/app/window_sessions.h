#ifndef window_sessions_h
#define window_sessions_h

#include "document/autosave.h"
#include "document/session.h"

#include <QObject>

#include <memory>

class MainWindow;
class NoticeBar;
class QMenu;
class OptionLinks;

/// The session files of the window: open, save, and the question before changes are lost; recent
/// files; autosave, and recovery after a crash.
class WindowSessions : public QObject
{
  Q_OBJECT

public:
  /// `recovery` and `missing` are bars of the window.
  WindowSessions(MainWindow* window, OptionLinks* links, NoticeBar* recovery, NoticeBar* missing);
  ~WindowSessions() override;

  /// Open a session in place of the work. Return false if it cannot be read, with a sentence, or if
  /// the user keeps the work.
  bool open(const QString& path);
  /// Save the session; ask for a name if it has none yet. Return false if nothing was written.
  bool save();
  bool save_as();
  bool write(const QString& path);
  /// Report whether the work can be closed: nothing would be lost, or the user agrees.
  bool may_go();
  /// Return the path of the session file; empty if there is none.
  QString path() const { return this->path_; }
  /// Show the bar if a crashed process has left work.
  void offer_recovery(const QString& root = QString());
  Autosave* autosave() { return &this->autosave_; }
  /// Return the name for the title: that of the session, otherwise that of the open data.
  QString name() const;
  void fill_recent(QMenu* menu);

private:
  Session session() const;
  void show(const Session& session);
  void recover();
  void show_notes(const Session& session);

  MainWindow* window_;
  OptionLinks* links_;
  NoticeBar* recovery_;
  NoticeBar* missing_;
  QString path_;
  SessionFile file_;
  Autosave autosave_;
  std::unique_ptr<RecoveredWork> recovered_;
};

#endif
