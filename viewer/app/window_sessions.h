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

/// Manages the session files of the window. The class opens and saves sessions, and asks before
/// changes are lost. It also manages the list of recent files, autosave, and recovery after a
/// crash.
class WindowSessions : public QObject
{
  Q_OBJECT

public:
  /// `recovery` offers recovered work, `missing` shows missing files; both are bars of the window.
  WindowSessions(MainWindow* window, OptionLinks* links, NoticeBar* recovery, NoticeBar* missing);
  ~WindowSessions() override;

  /// Open a session in place of the current work. Return false, and show a sentence, if it cannot
  /// be read. Also return false if the user decides to keep the current work.
  bool open(const QString& path);
  /// Save the session; ask for a name if it has none yet. Return false if nothing was written.
  bool save();
  bool save_as();
  bool write(const QString& path);
  /// Report whether the work can be closed: it has no unsaved changes, or the user agrees to lose
  /// them.
  bool may_go();
  /// Return the path of the session file; empty if there is none.
  QString path() const { return this->path_; }
  /// Show the recovery bar if a crashed process has left work.
  void offer_recovery(const QString& root = QString());
  Autosave* autosave() { return &this->autosave_; }
  /// Return the name for the window title: that of the session, or that of the open data if there
  /// is no session.
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
