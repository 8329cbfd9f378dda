#ifndef app_tour_simulated_user_h
#define app_tour_simulated_user_h

#include <QEvent>
#include <QPoint>
#include <QSize>
#include <QString>
#include <QStringList>
#include <QVariant>

#include <functional>

class QAction;

namespace app::view
{
class Viewport;
} // namespace app::view
namespace app::window
{
class MainWindow;
} // namespace app::window

namespace app::tour
{

/// Simulates a user of the window, for tours and tests: mouse events on the 3D view, keys, menu
/// entries, buttons and options. Each action uses the widget that a user would use. If a user could
/// not perform an action, because a widget is disabled or missing, the function returns a sentence
/// with the reason.
class SimulatedUser
{
public:
  explicit SimulatedUser(window::MainWindow* window) : window_(window) {}

  /// Return the 3D view of the window.
  view::Viewport* viewport() const;

  // ---- The mouse on the 3D view; positions in pixels from its upper left corner ----
  /// Convert a position in fractions of the view's width and height to pixels.
  QPoint pixel_of_fractions(double x, double y) const;
  /// Find the screen position of a posed handle, between its head (`bone_fraction` is 0) and its
  /// tail (1). Return a sentence if there is no such handle.
  QString find_handle_position(const QString& handle, double bone_fraction, QPoint& position) const;
  /// Find the position at which the mouse can best grab a part of the selected handle's gizmo.
  /// Return a sentence if the part is not visible.
  QString find_gizmo_position(int part, QPoint& position) const;
  void press(const QPoint& position, Qt::MouseButton button, Qt::KeyboardModifiers held = {});
  void move(const QPoint& position, Qt::KeyboardModifiers held = {});
  void release(const QPoint& position, Qt::MouseButton button, Qt::KeyboardModifiers held = {});
  void double_click(
    const QPoint& position, Qt::MouseButton button, Qt::KeyboardModifiers held = {});
  void wheel(const QPoint& position, double turns, Qt::KeyboardModifiers held = {});
  /// Move the mouse off the 3D view, as a user does before using another widget.
  void leave();
  /// Click on the track of the key frames at this time.
  void scrub(double seconds);
  /// Return the buttons that are pressed.
  Qt::MouseButtons buttons() const { return this->buttons_; }

  // ---- Other actions; they return a sentence on failure, otherwise an empty string ----
  /// Drop a file on the window.
  QString drop(const QString& file);
  /// Replace the text of the visible field that has this accessible name.
  QString type(const QString& text, const QString& field);
  /// Press a key: trigger the menu entry with this shortcut or, if there is none, send the key to
  /// the widget with the keyboard focus.
  QString press_key(const QString& keys);
  /// Trigger an action by its object name.
  QString trigger(const QString& action);
  /// Click the visible button with this text. `text` must not contain the ampersands of the
  /// button's text or the mark in front of a section's name.
  QString push_button(const QString& text);
  /// Choose a value of an option with the widget whose object name is the option's key.
  QString choose(const QString& option, const QVariant& value);
  QString show_panel(const QString& name);
  QString select(const QString& handle);
  /// Set the mode of the selected handles; `mode` is one of bindpose::handle_mode_words.
  QString set_mode(const QString& mode);
  static const QStringList& panel_names();

  /// Return the object names of all menu entries.
  QStringList actions() const;
  QAction* action(const QString& name) const;

private:
  int number_of(const QString& handle) const; ///< index of a handle by name; -1: no such handle
  QPoint from_display(const double* pixel) const;
  void send(QEvent::Type type, const QPoint& position, Qt::MouseButton button,
    Qt::MouseButtons held, Qt::KeyboardModifiers keys);

  window::MainWindow* window_;
  Qt::MouseButtons buttons_;
};

/// Report whether nothing runs in the background, nothing plays, and the displayed shape is that of
/// the current pose.
bool is_idle(const window::MainWindow* window);

/// Run the event loop until the condition is true. The condition is checked after every event and
/// every few milliseconds. Return false if it is not true after this many seconds.
bool wait_until(const std::function<bool()>& condition, double seconds);

} // namespace app::tour

#endif
