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
class QAction;
class QMenu;
class QString;
class QWidget;

namespace app::handles
{

class HandleSelection;

/// Commands for the selected handles, available as menu entries, keys and functions. Drags with the
/// mouse are not part of this class. Each command makes one undo step of the document. A command
/// that cannot be applied makes no step, and HandleSelection::edit_refused() is emitted with the
/// reason.
class HandleCommands : public QObject
{
  Q_OBJECT

public:
  /// The keys work in the 3D view `view_widget` and in `list`, the list of handles.
  HandleCommands(
    HandleSelection* selection, Document* document, QWidget* view_widget, QWidget* list);
  ~HandleCommands() override;

  /// Return the context menu of handles.
  QMenu* menu() const { return this->menu_; }
  void fill(QMenu* menu);
  /// Return the action with this name; null if there is none. Most names are listed in
  /// window_keys.h. The others are "fixes.tail", "fixes.ends", "mirror.y", "mirror.z" and
  /// "no_color".
  QAction* action(const std::string& name) const;
  /// Enable the actions that apply to the selection.
  void update();

  bool rename(int handle, const QString& name);
  /// Set the color of the selected handles. If `color` is empty, each handle is drawn in the color
  /// of its mode again.
  void set_color(const std::optional<QColor>& color);
  void set_locked(bool locked);
  void remove();
  /// Mirror the selected handles at a plane through the center of the shape's bounding box. `axis`
  /// (0 to 2) is the normal of the plane. If the plane's distance from the origin is at most 2 %
  /// of the box's extent, the plane goes through the origin instead: most symmetric shapes are
  /// modeled about the origin.
  void mirror(int axis);
  void snap();
  /// Set the parent of the selected handles; -1: no parent.
  void set_parent(int parent);
  void toggle_cage_edge();
  void set_handle_mode(bindpose::HandleMode mode);
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
  double center_coordinate(int axis) const;

  HandleSelection* selection_;
  Document* document_;
  QWidget* view_widget_;
  QMenu* menu_;
  QMenu* mode_menu_;
  QMenu* mirror_;
  QMenu* parents_;
  std::map<std::string, QAction*> actions_;
};

} // namespace app::handles

#endif
