#include "app/view/section.h"

#include "app/parts/panel_parts.h"

#include <QPushButton>
#include <QVBoxLayout>

namespace app::view
{

Section::Section(const QString& title, const QString& tip, bool open, QWidget* parent)
  : QWidget(parent), title_(title), header_(parts::button(title, this)), body_(new QWidget(this)),
    column_(new QVBoxLayout(body_))
{
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(5);
  this->header_->setObjectName("section");
  this->header_->setCheckable(true);
  this->header_->setToolTip(tip);
  this->column_->setContentsMargins(0, 0, 0, 4);
  this->column_->setSpacing(6);
  rows->addWidget(this->header_);
  rows->addWidget(this->body_);
  QObject::connect(this->header_, &QPushButton::toggled, this, &Section::set_open);
  this->set_open(open);
}

void Section::set_open(bool open)
{
  this->header_->setChecked(open);
  this->header_->setText((open ? QStringLiteral("▾  ") : QStringLiteral("▸  ")) + this->title_);
  this->body_->setVisible(open);
}

bool Section::is_open() const
{
  return this->header_->isChecked();
}

} // namespace app::view
