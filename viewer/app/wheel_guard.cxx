#include "wheel_guard.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QScrollBar>

WheelGuard::WheelGuard(QObject* parent) : QObject(parent)
{
  qApp->installEventFilter(this);
}

bool WheelGuard::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() != QEvent::Polish && event->type() != QEvent::Wheel)
  {
    return false;
  }
  const bool slider =
    qobject_cast<QAbstractSlider*>(watched) && !qobject_cast<QScrollBar*>(watched);
  if (!slider && !qobject_cast<QAbstractSpinBox*>(watched) && !qobject_cast<QComboBox*>(watched))
  {
    return false;
  }
  auto* widget = static_cast<QWidget*>(watched);
  if (event->type() == QEvent::Polish)
  {
    // With WheelFocus, Qt sets the focus before it delivers the wheel event.
    if (widget->focusPolicy() == Qt::WheelFocus)
    {
      widget->setFocusPolicy(Qt::StrongFocus);
    }
    return false;
  }
  if (widget->hasFocus())
  {
    return false;
  }
  event->ignore(); // Qt sends an ignored event to the parent widget.
  return true;
}
