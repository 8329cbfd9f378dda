#include "app/parts/error_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

namespace app::parts
{

ErrorBar::ErrorBar(QWidget* parent) : QFrame(parent), text_(new QLabel(this))
{
  this->setObjectName("error");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(14, 8, 8, 8);
  this->text_->setWordWrap(true);
  // Allow a width that is smaller than a long word, for example a path. Otherwise such a word would
  // make the window wider.
  this->text_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  this->text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QPushButton(tr("Close"), this);
  close->setFocusPolicy(Qt::TabFocus);
  QObject::connect(close, &QPushButton::clicked, this, &QWidget::hide);
  row->addWidget(this->text_, 1);
  row->addWidget(close, 0, Qt::AlignTop);
  this->hide();
}

void ErrorBar::show_message(const QString& message, ErrorKind kind, const QString& tool_tip)
{
  this->kind_ = kind;
  this->text_->setText(message);
  this->text_->setToolTip(tool_tip);
  this->show();
}

void ErrorBar::succeeded(ErrorKind kind)
{
  if (kind == this->kind_)
  {
    this->hide();
  }
}

QString ErrorBar::message() const
{
  return this->isHidden() ? QString() : this->text_->text();
}

} // namespace app::parts
