#ifndef app_parts_field_guard_h
#define app_parts_field_guard_h

#include <QObject>

#include <functional>

class QAbstractSpinBox;
class QWidget;

namespace app::parts
{

/// Prevents fields from handling events that are meant for the window.
/// - Number fields, combo boxes and sliders ignore the mouse wheel unless they have the keyboard
///   focus, and the wheel does not give them the focus. The wheel then scrolls the enclosing area.
/// - Undo and redo act on a number field only while a number is being typed in it.
/// - Enter in a number field ends the typing, so that the keys of the 3D view work again.
class FieldGuard : public QObject
{
public:
  /// Install the filter for the events of all widgets of the application. The filter is removed
  /// when the parent is destroyed.
  /// @param on_enter  called after Enter in a number field of the window `parent`; fields of
  /// dialogs do not call it
  FieldGuard(QWidget* parent, std::function<void()> on_enter);

  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void polish(QWidget* widget) const;
  bool block_wheel(QWidget* widget, QEvent* event) const;
  bool block_undo(QAbstractSpinBox* box, QEvent* event) const;

  std::function<void()> on_enter_;
};

} // namespace app::parts

#endif
