#include "app/parts/notice_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

namespace app::parts
{

NoticeBar::NoticeBar(QWidget* parent)
  : QFrame(parent), text_(new QLabel(this)), row_(new QHBoxLayout(this))
{
  this->setObjectName("notice");
  this->row_->setContentsMargins(14, 6, 8, 6);
  this->text_->setWordWrap(true);
  // Allow a width that is smaller than a long word, for example a path. Otherwise such a word would
  // make the window wider.
  this->text_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  this->text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  this->row_->addWidget(this->text_, 1);
  this->hide();
}

QPushButton* NoticeBar::add_button(const QString& text)
{
  auto* button = new QPushButton(text, this);
  button->setFocusPolicy(Qt::TabFocus);
  this->row_->addWidget(button, 0, Qt::AlignVCenter);
  this->buttons_ << button;
  return button;
}

void NoticeBar::offer(const QString& message, const QList<Choice>& choices, const QString& close)
{
  for (QPushButton* button : this->buttons_)
  {
    button->hide();
    // do not delete the button now, because a click on it may have caused this call
    button->deleteLater();
  }
  this->buttons_.clear();
  this->set_message(message);
  for (const Choice& choice : choices)
  {
    QObject::connect(this->add_button(choice.text), &QPushButton::clicked, this,
      [this, action = choice.action]
      {
        this->hide();
        action();
      });
  }
  if (!close.isEmpty())
  {
    QObject::connect(this->add_button(close), &QPushButton::clicked, this,
      [this]
      {
        this->hide();
        Q_EMIT this->closed();
      });
  }
  this->show();
}

void NoticeBar::set_message(const QString& message, const QString& tool_tip)
{
  this->text_->setText(message);
  this->text_->setToolTip(tool_tip);
}

QString NoticeBar::message() const
{
  return this->isHidden() ? QString() : this->text_->text();
}

} // namespace app::parts
