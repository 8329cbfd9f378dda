#ifndef app_window_window_sessions_h
#define app_window_window_sessions_h

#include "document/autosave.h"
#include "document/session.h"

#include <QObject>

#include <memory>

class Document;
class QMenu;

namespace app::parts
{
class ErrorBar;
class NoticeBar;
} // namespace app::parts
namespace app::view
{
class Viewport;
} // namespace app::view
namespace app::weights
{
class Binding;
} // namespace app::weights

namespace app::window
{

class OptionLinks;
class PanelColumn;

/// The parts of the window that WindowSessions uses.
struct SessionParts
{
  QWidget* window; ///< parent of the dialogs
  Document* document;
  view::Viewport* viewport;
  PanelColumn* panels;
  weights::Binding* binding;
  OptionLinks* links;
  parts::ErrorBar* errors;
  parts::NoticeBar* recovery; ///< offers recovered work
  parts::NoticeBar* missing; ///< shows missing files
};

/// Manages the session files of the window. The class opens and saves sessions, and asks before
/// changes are lost. It also manages the list of recent files, autosave, and recovery after a
/// crash.
class WindowSessions : public QObject
{
  Q_OBJECT

public:
  explicit WindowSessions(const SessionParts& parts);
  ~WindowSessions() override;

  /// Replace the current work by the session in a file. If the session cannot be read, show an
  /// error and return false. Also return false if the user decides to keep the current work.
  bool open(const QString& path);
  /// Save the session; ask for a name if it has none yet. Return false if nothing was written.
  bool save();
  bool save_as();
  bool write(const QString& path);
  /// Report whether the work can be closed. If there are unsaved changes, ask the user whether to
  /// save or discard them. Return false if the user cancels, or if saving fails.
  bool confirm_close();
  /// Return the path of the session file; empty if there is none.
  QString path() const { return this->path_; }
  /// Show the recovery bar if the folder `root` contains work of a crashed process. If `root` is
  /// empty, search the default folder.
  void offer_recovery(const QString& root = QString());
  Autosave* autosave() { return &this->autosave_; }
  /// Return the name for the window title: the name of the session file or, if there is none, the
  /// name of the open data.
  QString name() const;
  void fill_recent(QMenu* menu);

Q_SIGNALS:
  /// Emitted when the user chooses a recent file or locates a missing one.
  void open_requested(const QString& path);
  /// Emitted when name(), path() or the presence of unsaved changes may have changed.
  void changed();
  /// Emitted if the opened session shows a planar shape with perspective.
  void perspective_requested();

private:
  Session session() const;
  void show(const Session& session);
  void recover();
  void show_notes(const Session& session);

  SessionParts parts_;
  QString path_;
  SessionFile file_;
  Autosave autosave_;
  std::unique_ptr<RecoveredWork> recovered_;
};

} // namespace app::window

#endif
