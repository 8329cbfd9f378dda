#include "volume_panel.h"

#include "panel_parts.h"
#include "value_row.h"
#include "viewport.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>

VolumePanel::VolumePanel(QWidget* parent) : QFrame(parent)
{
  this->setObjectName("panel");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(7);

  column->addWidget(heading(tr("Slice"), this));
  this->slice_ = new QCheckBox(tr("Show the slice"), this);
  this->slice_->setChecked(true);
  this->slice_->setObjectName("volume.slice");
  this->slice_->setToolTip(tr("Winding numbers on a plane, which the mouse drags"));
  column->addWidget(this->slice_);
  this->orientations_ = add_orientations(column, this);
  this->orientations_->setObjectName("volume.orientation");
  this->position_ = new ValueRow(this);
  this->position_->setObjectName("volume.place");
  this->position_->tell_shares();
  this->position_->setToolTip(tr("Where the slice lies along its normal; the mouse drags it, too"));
  column->addWidget(this->position_);

  column->addSpacing(10);
  column->addWidget(heading(tr("Isosurface"), this));
  this->isosurface_ = new QCheckBox(tr("Show where w is"), this);
  this->isosurface_->setObjectName("volume.isosurface");
  this->isosurface_->setToolTip(
    tr("The surface where the winding number w (1 inside, 0 outside) is this"));
  column->addWidget(this->isosurface_);
  this->level_ = new ValueRow(this);
  this->level_->setObjectName("volume.level");
  this->level_->setToolTip(tr("The winding number on the isosurface"));
  column->addWidget(this->level_);
  this->area_ = new QLabel(this);
  this->area_->setObjectName("note");
  column->addWidget(this->area_);

  column->addSpacing(10);
  column->addWidget(heading(tr("Volume"), this));
  this->cloud_ = new QCheckBox(tr("Show as a cloud"), this);
  this->cloud_->setToolTip(tr("Volume rendering: clear where w is 0, faint inside, dense where the "
                              "surface overlaps or is inside out"));
  this->cloud_->setObjectName("volume.cloud");
  column->addWidget(this->cloud_);

  column->addSpacing(10);
  this->surface_heading_ = heading(tr("Surface"), this);
  column->addWidget(this->surface_heading_);
  this->surface_ = new QComboBox(this);
  this->surface_->setObjectName("volume.surface_look");
  this->surface_->setToolTip(tr("How the surface is drawn around the slice"));
  this->surface_->addItem(tr("Solid"));
  this->surface_->addItem(tr("See-through"));
  this->surface_->addItem(tr("Edges only"));
  this->surface_->addItem(tr("Hidden"));
  this->surface_->setCurrentIndex(Viewport::see_through);
  column->addWidget(this->surface_);

  column->addStretch(1);
  QPushButton* close = button(tr("Close the volume"), this);
  column->addWidget(close);

  QObject::connect(this->slice_, &QCheckBox::toggled, this,
    [this](bool shown)
    {
      for (QAbstractButton* orientation : this->orientations_->buttons())
      {
        orientation->setEnabled(shown);
      }
      this->position_->setEnabled(shown);
      Q_EMIT this->slice_wanted(shown);
    });
  QObject::connect(
    this->orientations_, &QButtonGroup::idClicked, this, &VolumePanel::orientation_chosen);
  QObject::connect(this->position_, &ValueRow::value_chosen, this, &VolumePanel::position_chosen);
  QObject::connect(this->isosurface_, &QCheckBox::toggled, this,
    [this](bool shown)
    {
      this->area_->setVisible(shown);
      Q_EMIT this->isosurface_wanted(shown);
    });
  QObject::connect(this->level_, &ValueRow::value_chosen, this,
    [this](double level)
    {
      this->isosurface_->setChecked(true); // who moves the level wants to see it
      Q_EMIT this->level_chosen(level);
    });
  QObject::connect(this->cloud_, &QCheckBox::toggled, this, &VolumePanel::cloud_wanted);
  QObject::connect(this->surface_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    &VolumePanel::surface_look_chosen);
  QObject::connect(close, &QPushButton::clicked, this, &VolumePanel::close_wanted);
  // What comes and goes keeps its place, so that nothing below it jumps.
  QSizePolicy keeps_place = this->area_->sizePolicy();
  keeps_place.setRetainSizeWhenHidden(true);
  this->area_->setSizePolicy(keeps_place);
  this->area_->hide();
  this->set_area(0.0);
  this->set_has_surface(false);
}

void VolumePanel::set_values(double lowest, double highest)
{
  this->level_->set_range(lowest, highest);
  this->level_->set_value(std::clamp(0.5, lowest, highest));
}

void VolumePanel::set_position(double position, double lowest, double highest)
{
  this->position_->set_range(lowest, highest);
  this->position_->set_value(position);
}

void VolumePanel::set_area(double area)
{
  this->area_->setText(
    area > 0.0 ? tr("Area %1").arg(area, 0, 'g', 5) : tr("There is no such place."));
}

void VolumePanel::set_has_surface(bool there)
{
  this->surface_heading_->setVisible(there);
  this->surface_->setVisible(there);
}

double VolumePanel::level() const
{
  return this->level_->value();
}

int VolumePanel::surface_look() const
{
  return this->surface_->currentIndex();
}
