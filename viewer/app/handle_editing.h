#ifndef handle_editing_h
#define handle_editing_h

#include "handle_edit_cells.h"

#include "vtkSmartPointer.h"

#include <QObject>
#include <QPoint>

#include <string>
#include <vector>

class Document;
class EditTools;
class HandleCommands;
class ModeBar;
class Posing;
class QAction;
class QActionGroup;
class QKeyEvent;
class QLabel;
class QMenu;
class RegionPainting;
class SidePanel;
class Viewport;
class vtkDataArray;
class vtkHandleSetRepresentation;
class vtkHandleSetWidget;
class vtkObject;

/// Handles by hand: the tools and edit modes of the handle widget and the brush, what they say, and
/// a step of the document for all that they do. Handles are selected here, in the picture or in the
/// list, and stay selected by their names whatever an edit does to their numbers.
///
/// While rest places are edited or regions painted the shape is shown at rest.
class HandleEditing : public QObject
{
  Q_OBJECT

public:
  /// All but the last are the edit modes of vtkHandleSetRepresentation.
  enum Mode
  {
    pose = 0,
    move_rest = 1,
    add_points = 2,
    add_bones = 3,
    add_cage = 4,
    paint_regions = 5
  };

  HandleEditing(
    Document* document, Viewport* viewport, Posing* posing, SidePanel* panel, QAction* auto_rig);

  /// The row of tools, for above the picture.
  EditTools* tools() const { return this->tools_; }
  /// What a mode has, in the upper left corner of the picture.
  ModeBar* mode_bar() const { return this->bar_; }
  HandleCommands* commands() const { return this->commands_; }
  void fill_menu(QMenu* menu);
  /// By its name in window_keys.h; null for none of the tools.
  QAction* action(const QString& name) const;

  int mode() const { return this->mode_; }
  void set_mode(int mode);
  /// In the mode pose: handles are drawn at rest, where they can be selected but not dragged.
  void show_rest(bool shown);
  /// Back by one: a drag or stroke, a cage's last vertex, the mode.
  void step_back();

  /// Numbers of the selected handles, the last one selected at the end.
  std::vector<int> selected() const;
  /// Them alone.
  void select(const std::vector<int>& handles);
  /// What can be done with the handle under a place of the viewport, as a menu; false without one.
  bool show_menu(const QPoint& at);

  /// Edits the handles as one step; false, with refused(), when that cannot be done. What is new is
  /// selected. With `labels` the surface's regions change along.
  bool edit(
    const QString& step, const bindpose::HandleListEdit& edit, vtkDataArray* labels = nullptr);
  /// What was changed in the document's handles already, cell by cell.
  bool commit(const QString& step, vtkDataArray* labels = nullptr);
  /// False, with refused(), for a name that is empty or another handle's.
  bool rename(int handle, const QString& name);
  /// One step for a name: that of the one handle, or how many there are.
  QString named(const QString& step, const std::vector<int>& handles) const;

  /// The document has others.
  void document_changed(int parts);
  /// Ends what the mouse or a key has begun, as if it had not been.
  void stop();
  /// What to tell in the status line; empty: nothing. Warnings are about what was just refused.
  QString sentence() const;
  bool is_warning() const { return !this->warning_.isEmpty(); }

  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  /// Before anything of the mode is shown.
  void mode_changed(int mode);
  void sentence_changed();
  /// Poses or rest places have changed under the mouse.
  void moved();
  /// The last one selected; -1: none.
  void handle_selected(int handle);
  void refused(const QString& sentence);

private:
  QAction* add_action(QActionGroup* group, const char* name, const QString& text, int value);
  void make_actions();
  void connect_widget();
  vtkHandleSetWidget* widget() const;
  vtkHandleSetRepresentation* drawn() const;
  void refuse(const bindpose::Status& status);
  void drag_began();
  void drag_went_on();
  void drag_ended();
  void placed();
  void warned(vtkObject* caller, unsigned long event, void* sentence);
  void selection_changed();
  void mode_left();
  void list_chosen();
  void show_selection();
  void remember_selection();
  void tell_selection();
  void show_state();
  QString drag_sentence() const;
  QString refusal() const;
  QString mode_sentence() const;
  bool takes_key(const QKeyEvent* event) const;

  Document* document_;
  Viewport* viewport_;
  Posing* posing_;
  SidePanel* panel_;
  RegionPainting* painting_;
  HandleCommands* commands_ = nullptr;
  QActionGroup* modes_ = nullptr;
  QActionGroup* gizmos_ = nullptr;
  QAction* local_ = nullptr;
  QAction* inside_ = nullptr;
  EditTools* tools_ = nullptr;
  ModeBar* bar_ = nullptr;
  QWidget* nothing_ = nullptr; ///< over the picture as long as a mesh has no handles
  int mode_ = pose;
  std::vector<std::string> names_; ///< of the selected handles
  bool is_committing_ = false;
  bool follows_ = false; ///< the list does what the picture did
  bool right_button_ = false; ///< went down on a handle
  QString warning_;
};

#endif
