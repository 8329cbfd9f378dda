#include "panel_column.h"

#include "side_panel.h"
#include "volume_panel.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QPushButton>
#include <QVariant>
#include <QVBoxLayout>

PanelColumn::PanelColumn(QWidget* parent)
  : QWidget(parent), choice_(new QFrame(this)), buttons_(new QButtonGroup(this)),
    side_(new SidePanel(this)), volume_(new VolumePanel(this))
{
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  this->choice_->setObjectName("panel");
  auto* row = new QHBoxLayout(this->choice_);
  row->setContentsMargins(16, 14, 16, 0);
  row->setSpacing(0);
  const char* const names[] = { QT_TR_NOOP("Bind and pose"), QT_TR_NOOP("Volume") };
  const char* const places[] = { "first", "last" };
  for (int k = 0; k < 2; ++k)
  {
    auto* segment = new QPushButton(tr(names[k]), this->choice_);
    segment->setObjectName("segment");
    segment->setProperty("place", places[k]);
    segment->setFocusPolicy(Qt::TabFocus);
    segment->setCheckable(true);
    this->buttons_->addButton(segment, k);
    row->addWidget(segment, 1);
  }
  column->addWidget(this->choice_);
  column->addWidget(this->side_, 1);
  column->addWidget(this->volume_, 1);
  // Equally wide, so that the picture does not jump.
  this->volume_->setFixedWidth(this->side_->sizeHint().width());
  QObject::connect(this->buttons_, &QButtonGroup::idClicked, this,
    [this](int which) { this->show_volume(which == 1); });
  this->set_open(false, false);
}

void PanelColumn::set_open(bool volume, bool shape)
{
  this->choice_->setVisible(volume && shape);
  if (!volume)
  {
    this->show_volume(false);
  }
}

void PanelColumn::show_volume(bool shown)
{
  this->buttons_->button(shown ? 1 : 0)->setChecked(true);
  this->volume_->setVisible(shown);
  this->side_->setVisible(!shown);
}
