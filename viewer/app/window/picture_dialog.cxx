#include "app/window/picture_dialog.h"

#include "app/parts/panel_parts.h"
#include "app/view/viewport.h"

#include "document/user_settings.h"
#include "pictures/window_picture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>

namespace app::window
{

namespace
{
const char* const scale_key = "picture/scale";
const char* const transparent_key = "picture/transparent";
} // namespace

PictureDialog::PictureDialog(view::Viewport* viewport, QWidget* parent)
  : QDialog(parent), viewport_(viewport), scale_(new QComboBox(this)),
    transparent_(new QCheckBox(tr("Transparent background"), this)), size_(new QLabel(this)),
    save_(parts::button(tr("Export…"), this))
{
  this->setWindowTitle(tr("Export picture"));
  auto* rows = new QGridLayout(this);
  rows->setContentsMargins(16, 14, 16, 14);
  rows->setHorizontalSpacing(12);
  rows->setVerticalSpacing(9);
  for (int factor = 1; factor <= bindpose::largest_scale_factor; ++factor)
  {
    this->scale_->addItem(tr("%1 ×").arg(factor));
  }
  this->scale_->setObjectName(scale_key);
  this->scale_->setAccessibleName(tr("Scale factor"));
  this->scale_->setToolTip(tr("Pixels of the picture per pixel of the view, in each direction; "
                              "lines, points, text and scalar bars are scaled by the same factor"));
  this->transparent_->setObjectName(transparent_key);
  this->transparent_->setToolTip(tr("Make the background transparent, so that the picture can be "
                                    "placed over other colors; text keeps its color"));
  this->size_->setObjectName("note");
  this->size_->setWordWrap(true);
  this->size_->setMinimumWidth(300);
  this->size_->setFixedHeight(2 * this->size_->fontMetrics().lineSpacing() + 2);
  this->size_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  rows->addWidget(new QLabel(tr("Scale factor"), this), 0, 0);
  rows->addWidget(this->scale_, 0, 1);
  rows->addWidget(this->size_, 1, 0, 1, 3);
  rows->addWidget(this->transparent_, 2, 0, 1, 3);
  rows->setColumnStretch(2, 1);
  auto* buttons = new QHBoxLayout;
  auto* cancel = parts::button(tr("Cancel"), this);
  this->save_->setObjectName("primary");
  this->save_->setDefault(true);
  buttons->setSpacing(8);
  buttons->addStretch(1);
  buttons->addWidget(cancel);
  buttons->addWidget(this->save_);
  rows->addLayout(buttons, 3, 0, 1, 3);

  const auto settings = user_settings();
  const int factor = settings->value(scale_key, 1).toInt();
  this->scale_->setCurrentIndex(qBound(1, factor, bindpose::largest_scale_factor) - 1);
  this->transparent_->setChecked(settings->value(transparent_key, false).toBool());
  QObject::connect(this->scale_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    &PictureDialog::update_size);
  QObject::connect(this->save_, &QPushButton::clicked, this, &PictureDialog::accept);
  QObject::connect(cancel, &QPushButton::clicked, this, &PictureDialog::reject);
  this->update_size();
}

int PictureDialog::scale() const
{
  return this->scale_->currentIndex() + 1;
}

bool PictureDialog::is_transparent() const
{
  return this->transparent_->isChecked();
}

QString PictureDialog::size_note() const
{
  return this->size_->text();
}

void PictureDialog::update_size()
{
  const QSize size = this->viewport_->picture_size(this->scale());
  const bindpose::Status status = bindpose::check_picture_size(size.width(), size.height());
  this->save_->setEnabled(status.ok());
  this->size_->setText(status.ok()
      ? tr("%L1 × %L2 pixels").arg(size.width()).arg(size.height())
      : parts::capitalized(QString::fromStdString(status.message)) + '.');
}

void PictureDialog::accept()
{
  const auto settings = user_settings();
  settings->setValue(scale_key, this->scale());
  settings->setValue(transparent_key, this->is_transparent());
  this->QDialog::accept();
}

} // namespace app::window
