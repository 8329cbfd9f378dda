#ifndef window_menus_h
#define window_menus_h

#include <QObject>

class MainWindow;
class QAction;
class QActionGroup;
class QMenu;

/// The menus of the window. Entries that do not apply are disabled. window_keys.h defines the keys.
class WindowMenus : public QObject
{
  Q_OBJECT

public:
  explicit WindowMenus(MainWindow* window);

  /// Update which entries are enabled.
  void update();
  void show_method(int method);

private:
  template <typename Action>
  QAction* add(QMenu* menu, const QString& text, const char* name, Action action);
  void add_file_menu();
  void add_edit_menu();
  void add_view_menu();

  MainWindow* window_;
  QAction* save_ = nullptr;
  QAction* save_as_ = nullptr;
  QAction* export_shape_ = nullptr;
  QAction* export_rig_ = nullptr;
  QAction* export_pose_ = nullptr;
  QAction* export_film_ = nullptr;
  QAction* flat_view_ = nullptr;
  QAction* outlines_ = nullptr;
  QAction* timeline_ = nullptr;
  QAction* find_ = nullptr;
  QAction* bind_ = nullptr;
  QAction* rest_pose_ = nullptr;
  QActionGroup* methods_ = nullptr;
};

#endif
