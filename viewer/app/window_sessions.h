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

/// The window's session files: open, save, and the question before changes are lost; recent files;
/// the copy against crashes, and what a crash has left.
class WindowSessions : public QObject
{
  Q_OBJECT

public:
  /// `recovery` and `missing` are bars of the window.
  WindowSessions(MainWindow* window, OptionLinks* links, NoticeBar* recovery, NoticeBar* missing);
  ~WindowSessions() override;

  /// Opens a session in place of the work; false, with a sentence, when it cannot be read or when
  /// the work is to stay.
  bool open(const QString& path);
  /// Asks for a name where there is none yet; false when nothing was written.
  bool save();
  bool save_as();
  bool write(const QString& path);
  /// True when nothing would be lost, or the user says so.
  bool may_go();
  /// The session file; empty as long as there is none.
  QString path() const { return this->path_; }
  /// Shows the bar when a process has died and left its work.
  void offer_recovery(const QString& root = QString());
  Autosave* autosave() { return &this->autosave_; }
  /// For the title: the session's name, else what is open.
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
