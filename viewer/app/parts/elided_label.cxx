#include "app/parts/elided_label.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>

namespace app::parts
{

QString ElidedLabel::shown() const
{
  return this->fontMetrics().elidedText(this->text(), Qt::ElideRight, this->contentsRect().width());
}

QSize ElidedLabel::minimumSizeHint() const
{
  return { 0, this->QLabel::minimumSizeHint().height() };
}

bool ElidedLabel::event(QEvent* event)
{
  if (event->type() == QEvent::ToolTip && this->shown() != this->text())
  {
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), this->text(), this);
    return true;
  }
  return QLabel::event(event);
}

void ElidedLabel::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  painter.setPen(this->palette().color(this->foregroundRole()));
  painter.drawText(this->contentsRect(), Qt::AlignLeft | Qt::AlignVCenter, this->shown());
}

} // namespace app::parts
