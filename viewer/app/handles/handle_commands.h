#ifndef app_handles_handle_commands_h
#define app_handles_handle_commands_h

#include "pose/pose.h"

#include <QColor>
#include <QObject>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

class Document;
class HandleSelection;
class QAction;
class QMenu;
class QString;
class QWidget;

/// Commands for the selected handles, as menu entries, keys and functions; drags are handled
/// elsewhere. Each command makes one undo step of the document. If it cannot be applied, it makes
/// no step, and HandleSelection::refused() is emitted with one sentence.
class HandleCommands : public QObject
{
  Q_OBJECT

public:
  /// The keys work in the 3D view `picture` and in `list`, the list of handles.
  HandleCommands(HandleSelection* selection, Document* document, QWidget* picture, QWidget* list);
  ~HandleCommands() override;

  /// Return the context menu of handles.
  QMenu* menu() const { return this->menu_; }
  void fill(QMenu* menu);
  /// Return an action by its name in window_keys.h, or "fixes.tail", "fixes.ends", "mirror.y",
  /// "mirror.z", "no_color"; null if there is none.
  QAction* action(const std::string& name) const;
  /// Enable the actions that apply to the selection.
  void update();

  bool rename(int handle, const QString& name);
  /// Set the color of the selected handles; empty: the color of their mode.
  void set_color(const std::optional<QColor>& color);
  void set_locked(bool locked);
  void remove();
  /// Mirror the selected handles at the plane perpendicular to an axis, through the center of the
  /// shape. A center coordinate near 0 is treated as 0.
  void mirror(int axis);
  void snap();
  /// Set the parent of the selected handles; -1: no parent.
  void set_parent(int parent);
  void toggle_cage_edge();
  void fix(bindpose::HandleMode mode);
  void reset();
  void select_all();

private:
  template <typename Action>
  QAction* add(const std::string& name, const QString& text, Action action);
  void make_actions();
  void ask_for_name();
  void ask_for_color();
  void fill_parents();
  bool is_locked(int handle) const;
  double middle(int axis) const;

  HandleSelection* selection_;
  Document* document_;
  QWidget* picture_;
  QMenu* menu_;
  QMenu* fixes_;
  QMenu* mirror_;
  QMenu* parents_;
  std::map<std::string, QAction*> actions_;
};

#endif
