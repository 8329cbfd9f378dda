#ifndef handle_commands_h
#define handle_commands_h

#include "pose/pose.h"

#include <QColor>
#include <QObject>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

class Document;
class HandleEditing;
class QAction;
class QMenu;
class QString;
class QWidget;

/// What can be done with the selected handles besides dragging them, by menus, keys and functions:
/// each is one step of the document, or nothing and one sentence (HandleEditing::refused()).
class HandleCommands : public QObject
{
  Q_OBJECT

public:
  /// Keys work in the picture and in the list of handles.
  HandleCommands(HandleEditing* editing, Document* document, QWidget* picture, QWidget* list);
  ~HandleCommands() override;

  /// The menu of a handle.
  QMenu* menu() const { return this->menu_; }
  void fill(QMenu* menu);
  /// By its name in window_keys.h, or "fixes.tail", "fixes.ends", "mirror.y", "mirror.z",
  /// "no_colour"; null for none.
  QAction* action(const std::string& name) const;
  /// What can be done depends on what is selected.
  void update();

  bool rename(int handle, const QString& name);
  /// Null: the colour of its mode.
  void set_colour(const std::optional<QColor>& colour);
  void set_locked(bool locked);
  void remove();
  /// To the other side of the plane across an axis through the middle of the shape (of 0, where
  /// that is near it).
  void mirror(int axis);
  void snap();
  /// -1: none.
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
  void ask_for_colour();
  void fill_parents();
  bool is_locked(int handle) const;
  double middle(int axis) const;

  HandleEditing* editing_;
  Document* document_;
  QWidget* picture_;
  QMenu* menu_;
  QMenu* fixes_;
  QMenu* mirror_;
  QMenu* parents_;
  std::map<std::string, QAction*> actions_;
};

#endif
