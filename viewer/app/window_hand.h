#ifndef window_hand_h
#define window_hand_h

#include <QEvent>
#include <QPoint>
#include <QSize>
#include <QString>
#include <QStringList>
#include <QVariant>

#include <functional>

class MainWindow;
class QAction;

/// A person's hand in the window, for tours and tests: events of the mouse on the picture, keys,
/// entries of the menus, buttons and options, each through the widget that a person would use. What
/// a person could not do either, because it is disabled or not there, is one sentence.
class WindowHand
{
public:
  explicit WindowHand(MainWindow* window) : window_(window) {}

  // ---- The mouse on the picture; places in pixels from its upper left corner ----
  QPoint place(double x, double y) const; ///< of shares of its width and height
  /// Where a posed handle is: between its head (0) and its tail (1). A sentence without one.
  QString place_of(const QString& handle, double along, QPoint& at) const;
  /// Where a part of the selected handle's gizmo is best grabbed. A sentence where it is not seen.
  QString place_of_gizmo(int part, QPoint& at) const;
  void press(const QPoint& at, Qt::MouseButton button, Qt::KeyboardModifiers held = {});
  void move(const QPoint& at, Qt::KeyboardModifiers held = {});
  void release(const QPoint& at, Qt::MouseButton button, Qt::KeyboardModifiers held = {});
  void double_click(const QPoint& at, Qt::MouseButton button, Qt::KeyboardModifiers held = {});
  void wheel(const QPoint& at, double turns, Qt::KeyboardModifiers held = {});
  /// The mouse is elsewhere; as it is for whatever is not on the picture.
  void leave();
  /// The mouse on the key frames' track.
  void scrub(double seconds);
  /// Buttons that are held.
  Qt::MouseButtons buttons() const { return this->buttons_; }

  // ---- Everything else; a sentence, or empty ----
  /// Drop a file on the window.
  QString drop(const QString& file);
  /// Replace the text of the visible field that has this accessible name.
  QString type(const QString& text, const QString& field);
  /// What has the keyboard gets the key, or the entry of the menus whose shortcut it is.
  QString press_key(const QString& keys);
  /// By its object name.
  QString trigger(const QString& action);
  /// A button that is seen, by its text, without the marks of menus and sections.
  QString push(const QString& text);
  /// Through the widget with the option's key as its name.
  QString choose(const QString& option, const QVariant& value);
  QString show_panel(const QString& name);
  QString select(const QString& handle);
  /// What the selected handles fix: a word of bindpose::handle_mode_words.
  QString set_mode(const QString& mode);
  static const QStringList& panel_names();

  /// Object names of all entries of the menus.
  QStringList actions() const;
  QAction* action(const QString& name) const;

private:
  int number_of(const QString& handle) const; ///< -1: there is none
  QPoint from_display(const double* pixel) const;
  void send(QEvent::Type type, const QPoint& at, Qt::MouseButton button, Qt::MouseButtons held,
    Qt::KeyboardModifiers keys);

  MainWindow* window_;
  Qt::MouseButtons buttons_;
};

/// Nothing runs beside the window, nothing plays, and the shape is that of the pose.
bool is_idle(const MainWindow* window);

/// Lets the event loop run until the condition holds, which is looked at after every event and
/// every few milliseconds; false when so many seconds have passed without.
bool wait_until(const std::function<bool()>& condition, double seconds);

#endif
