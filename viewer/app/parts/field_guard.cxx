#include "app/parts/field_guard.h"

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QScrollBar>

namespace app::parts
{

FieldGuard::FieldGuard(QWidget* parent, std::function<void()> on_enter)
  : QObject(parent), on_enter_(std::move(on_enter))
{
  qApp->installEventFilter(this);
}

bool FieldGuard::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() != QEvent::Polish && event->type() != QEvent::Wheel &&
    event->type() != QEvent::ShortcutOverride)
  {
    return false;
  }
  auto* box = qobject_cast<QAbstractSpinBox*>(watched);
  if (event->type() == QEvent::ShortcutOverride)
  {
    return box && this->block_undo(box, event);
  }
  const bool slider =
    qobject_cast<QAbstractSlider*>(watched) && !qobject_cast<QScrollBar*>(watched);
  if (!slider && !box && !qobject_cast<QComboBox*>(watched))
  {
    return false;
  }
  auto* widget = static_cast<QWidget*>(watched);
  if (event->type() == QEvent::Polish)
  {
    this->polish(widget);
    return false;
  }
  return this->block_wheel(widget, event);
}

void FieldGuard::polish(QWidget* widget) const
{
  // Replace the policy WheelFocus. With WheelFocus, Qt gives the widget the focus before the wheel
  // event arrives, so block_wheel() would not block the event.
  if (widget->focusPolicy() == Qt::WheelFocus)
  {
    widget->setFocusPolicy(Qt::StrongFocus);
  }
  auto* box = qobject_cast<QAbstractSpinBox*>(widget);
  if (auto* text = box ? box->findChild<QLineEdit*>() : nullptr)
  {
    QObject::connect(
      box, &QAbstractSpinBox::editingFinished, text, [text] { text->setModified(false); });
    QObject::connect(text, &QLineEdit::returnPressed, this,
      [this, box]
      {
        if (box->window() == this->parent())
        {
          this->on_enter_();
        }
      });
  }
}

bool FieldGuard::block_wheel(QWidget* widget, QEvent* event) const
{
  if (widget->hasFocus())
  {
    return false;
  }
  event->ignore(); // Qt sends an ignored event to the parent widget.
  return true;
}

bool FieldGuard::block_undo(QAbstractSpinBox* box, QEvent* event) const
{
  const auto* key = static_cast<QKeyEvent*>(event);
  const auto* text = box->findChild<QLineEdit*>();
  if (!(key->matches(QKeySequence::Undo) || key->matches(QKeySequence::Redo)) ||
    (text && text->isModified()))
  {
    return false;
  }
  event->ignore(); // The field ignores the key, so Qt searches for a shortcut of the window.
  return true;
}

} // namespace app::parts
