#ifndef app_handles_handle_editing_h
#define app_handles_handle_editing_h

#include <QObject>
#include <QPoint>

class Document;
class QAction;
class QActionGroup;
class QKeyEvent;
class QLabel;
class QMenu;
class vtkHandleSetRepresentation;
class vtkHandleSetWidget;
class vtkObject;

namespace app::posing
{
class PoseController;
} // namespace app::posing
namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::handles
{

class EditTools;
class HandleCommands;
class HandleSelection;
class ModeBar;
class RegionPainting;
class SidePanel;

/// Interactive editing of handles with the handle widget and the region brush. This class owns the
/// row of tools, switches the edit modes, and writes messages for the status line. Each edit is one
/// undo step of the document.
///
/// While rest positions are edited or regions are painted, the shape is shown at rest.
class HandleEditing : public QObject
{
  Q_OBJECT

public:
  /// The edit modes of vtkHandleSetRepresentation, and paint_regions.
  enum Mode
  {
    pose = 0,
    move_rest = 1,
    add_points = 2,
    add_bones = 3,
    add_cage = 4,
    paint_regions = 5
  };

  HandleEditing(Document* document, view::Viewport* viewport, posing::PoseController* posing,
    SidePanel* panel, QAction* auto_rig);

  /// Return the row of tools, to be placed above the 3D view.
  EditTools* tools() const { return this->tools_; }
  /// Return the bar with the options of an edit mode, to be placed in the upper left corner of the
  /// 3D view.
  ModeBar* mode_bar() const { return this->bar_; }
  HandleSelection* selection() const { return this->selection_; }
  HandleCommands* commands() const { return this->commands_; }
  void fill_menu(QMenu* menu);
  /// Return the action of a tool by its name in window_keys.h; null if there is none.
  QAction* action(const QString& name) const;

  int mode() const { return this->mode_; }
  void set_mode(int mode);
  /// Set whether the mode `pose` draws the handles at rest. They can then be selected but not
  /// dragged.
  void show_rest(bool shown);
  /// Handle Esc by the first of these actions that is possible: cancel a drag or a stroke, remove
  /// the last vertex of an unfinished cage, leave the edit mode.
  void step_back();

  /// Show the context menu of the handle at this position of the viewport. Return false if there is
  /// no handle.
  bool show_menu(const QPoint& position);

  /// Update after changes of the document. `parts` combines the flags of the changed parts.
  void document_changed(int parts);
  /// Cancel the interaction that the mouse or a key has begun.
  void cancel_interaction();
  /// Return the sentence for the status line, or an empty string. It is a warning if the last
  /// action was refused.
  QString message() const;
  bool is_warning() const { return !this->warning_.isEmpty(); }

  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  /// Emitted when the mode has changed, before the 3D view and the tools show the new mode.
  void mode_changed(int mode);
  void status_text_changed();
  /// Emitted during a drag when poses or rest positions have changed.
  void moved();
  /// Emitted with the handle that was selected last; -1: no handle.
  void handle_selected(int handle);
  void edit_refused(const QString& message);

private:
  QAction* add_action(QActionGroup* group, const char* name, const QString& text, int value);
  void make_actions();
  void connect_widget();
  vtkHandleSetWidget* widget() const;
  vtkHandleSetRepresentation* representation() const;
  void drag_began();
  void drag_continued();
  void drag_ended();
  void handle_placed();
  void show_warning(vtkObject* caller, unsigned long event, void* message);
  void selection_changed();
  void widget_mode_changed();
  void list_chosen();
  void show_state();
  QString drag_hint() const;
  QString refusal() const;
  QString mode_hint() const;
  bool takes_key(const QKeyEvent* event) const;

  Document* document_;
  view::Viewport* viewport_;
  posing::PoseController* posing_;
  SidePanel* panel_;
  HandleSelection* selection_;
  RegionPainting* painting_;
  HandleCommands* commands_ = nullptr;
  QActionGroup* modes_ = nullptr;
  QActionGroup* gizmos_ = nullptr;
  QAction* local_ = nullptr;
  QAction* inside_ = nullptr;
  EditTools* tools_ = nullptr;
  ModeBar* bar_ = nullptr;
  QWidget* start_card_ = nullptr; ///< shown over the 3D view while a mesh has no handles
  int mode_ = pose;
  bool is_updating_list_ =
    false; ///< true while the list is updated from the selection in the 3D view
  bool right_pressed_on_handle_ = false; ///< true: the right button was pressed on a handle
  QString warning_;
};

} // namespace app::handles

#endif
