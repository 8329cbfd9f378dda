#include "app/parts/bar_stack.h"

#include <QEvent>
#include <QVBoxLayout>

namespace app::parts
{

namespace
{
constexpr int bar_margin = 10; // pixels
}

BarStack::BarStack(QWidget* view_widget) : QWidget(view_widget), column_(new QVBoxLayout(this))
{
  this->column_->setContentsMargins(0, 0, 0, 0);
  this->column_->setSpacing(6);
  this->setCursor(Qt::ArrowCursor); // use the arrow instead of the cursor of the 3D view below
  view_widget->installEventFilter(this);
  this->hide();
}

void BarStack::add(QWidget* bar)
{
  this->column_->addWidget(bar);
  bar->installEventFilter(this);
}

void BarStack::begin_below(QWidget* widget)
{
  this->widget_above_ = widget;
  widget->installEventFilter(this);
}

bool BarStack::event(QEvent* event)
{
  const bool result = QWidget::event(event);
  if (event->type() == QEvent::LayoutRequest) // the size of a bar has changed with its text
  {
    this->arrange();
  }
  return result;
}

bool BarStack::eventFilter(QObject* watched, QEvent* event)
{
  const QEvent::Type type = event->type();
  const bool is_bar = watched != this->widget_above_ && watched != this->parentWidget();
  if (is_bar ? type == QEvent::ShowToParent || type == QEvent::HideToParent
             : type == QEvent::Resize || type == QEvent::Move || type == QEvent::Show ||
        type == QEvent::Hide)
  {
    this->arrange();
  }
  return QWidget::eventFilter(watched, event);
}

void BarStack::arrange()
{
  bool any_visible = false;
  for (int k = 0; k < this->column_->count(); ++k)
  {
    any_visible = any_visible || !this->column_->itemAt(k)->widget()->isHidden();
  }
  this->setVisible(any_visible);
  if (any_visible)
  {
    const int top = bar_margin +
      (this->widget_above_ && this->widget_above_->isVisible()
          ? this->widget_above_->geometry().bottom()
          : 0);
    const int width = this->parentWidget()->width() - 2 * bar_margin;
    this->column_->invalidate();
    this->setGeometry(bar_margin, top, width, this->column_->totalHeightForWidth(width));
    this->column_->activate();
    this->raise();
  }
}

} // namespace app::parts
