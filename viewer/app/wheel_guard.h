#ifndef wheel_guard_h
#define wheel_guard_h

#include <QObject>

/// Number fields, combo boxes and sliders ignore the mouse wheel unless they have the keyboard
/// focus, and the wheel does not give them the focus. The wheel then scrolls the enclosing area.
class WheelGuard : public QObject
{
public:
  /// Filters the events of all widgets of the application during the lifetime of the parent.
  explicit WheelGuard(QObject* parent);

  bool eventFilter(QObject* watched, QEvent* event) override;
};

#endif
