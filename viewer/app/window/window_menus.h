#ifndef app_window_window_menus_h
#define app_window_window_menus_h

#include <QObject>

class Document;
class QAction;
class QActionGroup;
class QMainWindow;
class QMenu;

namespace app::handles
{
class HandleEditing;
class ShapeHandles;
} // namespace app::handles
namespace app::posing
{
class KeyStrip;
class PoseController;
} // namespace app::posing
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

class Exports;
class PanelColumn;
class WindowSessions;

/// The window, and the parts of the window whose commands are in the menus.
struct MenuParts
{
  QMainWindow* window;
  Document* document;
  view::Viewport* viewport;
  PanelColumn* panels;
  handles::HandleEditing* editing;
  handles::ShapeHandles* shape_handles;
  weights::Binding* binding;
  posing::PoseController* posing;
  posing::KeyStrip* strip;
  WindowSessions* sessions;
  Exports* exports;
};

/// The menus of the window. Entries that do not apply are disabled. window_keys.h defines the keys.
class WindowMenus : public QObject
{
  Q_OBJECT

public:
  explicit WindowMenus(const MenuParts& parts);

  /// The state of the window that determines which entries are enabled or checked.
  struct State
  {
    bool is_empty; ///< no file is open
    bool is_planar; ///< the shape can be shown in 2D
    bool shows_timeline;
  };
  /// Update which entries are enabled and checked.
  void update(const State& state);
  void show_method(int method);

Q_SIGNALS:
  // Emitted when the user has chosen a menu entry.
  void open_requested();
  void flat_view_requested(bool flat);
  void outlines_requested(bool shown);
  void look_requested(bool shown);
  void timeline_requested(bool shown);
  void method_requested(int method);

private:
  template <typename Action>
  QAction* add(QMenu* menu, const QString& text, const char* name, Action action);
  void add_file_menu();
  void add_edit_menu();
  void add_view_menu();

  MenuParts parts_;
  QAction* save_ = nullptr;
  QAction* save_as_ = nullptr;
  QAction* export_shape_ = nullptr;
  QAction* export_rig_ = nullptr;
  QAction* export_pose_ = nullptr;
  QAction* export_film_ = nullptr;
  QAction* flat_view_ = nullptr;
  QAction* outlines_ = nullptr;
  QAction* look_ = nullptr;
  QAction* timeline_ = nullptr;
  QAction* find_ = nullptr;
  QAction* bind_ = nullptr;
  QAction* rest_pose_ = nullptr;
  QActionGroup* methods_ = nullptr;
};

} // namespace app::window

#endif
