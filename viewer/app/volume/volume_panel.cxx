#include "app/volume/volume_panel.h"

#include "app/parts/option_widgets.h"
#include "app/parts/panel_parts.h"
#include "app/parts/value_row.h"
#include "app/view/viewport.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>

namespace app::volume
{

namespace
{
/// Numbers of samples along the longest side of the grid: coarse, medium, fine.
constexpr int resolutions[] = { 48, 96, 192 };

void keep_size_when_hidden(QWidget* widget)
{
  // Hidden widgets keep their space, so that the widgets below them do not move.
  QSizePolicy policy = widget->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  widget->setSizePolicy(policy);
}
} // namespace

VolumePanel::VolumePanel(QWidget* parent) : QFrame(parent)
{
  this->setObjectName("panel");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(7);

  column->addWidget(parts::heading(tr("Winding numbers"), this));
  this->samples_ = parts::option_box("volume.samples", this);
  for (int k = 0; k < this->samples_->count(); ++k)
  {
    this->samples_->setItemText(
      k, tr("%1: %2 samples").arg(this->samples_->itemText(k)).arg(resolutions[k]));
  }
  this->samples_->setToolTip(tr("Samples along the longest side of the grid around the surface; "
                                "twice as many samples need eight times the memory"));
  column->addWidget(this->samples_);
  auto* buttons = new QHBoxLayout;
  this->compute_ = parts::button(tr("Compute"), this);
  this->compute_->setObjectName("primary");
  this->compute_->setToolTip(tr("Compute in the background how many times the surface winds around "
                                "each sample: 1 inside, 0 outside"));
  this->cancel_ = parts::button(tr("Cancel"), this);
  this->cancel_->setToolTip(tr("Cancel; the volume is unchanged"));
  buttons->addWidget(this->compute_, 1);
  buttons->addWidget(this->cancel_);
  column->addLayout(buttons);
  this->bar_ = new QProgressBar(this);
  this->bar_->setRange(0, 1000);
  this->bar_->setTextVisible(false);
  keep_size_when_hidden(this->bar_);
  column->addWidget(this->bar_);
  this->note_ = new QLabel(this);
  this->note_->setObjectName("note");
  this->note_->setFixedHeight(this->note_->fontMetrics().lineSpacing() + 2);
  column->addWidget(this->note_);

  column->addSpacing(10);
  column->addWidget(parts::heading(tr("Slice"), this));
  this->slice_ = new QCheckBox(tr("Show the slice"), this);
  this->slice_->setChecked(true);
  this->slice_->setObjectName("volume.slice");
  this->slice_->setToolTip(tr("Show winding numbers on a plane that the mouse can drag"));
  column->addWidget(this->slice_);
  this->orientations_ = parts::orientation_segments(column, this, "volume.orientation");
  this->position_ = new parts::ValueRow(this);
  this->position_->setObjectName("volume.place");
  this->position_->set_option_is_fraction();
  this->position_->setToolTip(
    tr("Position of the slice along its normal; the mouse can also drag the slice"));
  column->addWidget(this->position_);

  column->addSpacing(10);
  column->addWidget(parts::heading(tr("Isosurface"), this));
  this->isosurface_ = new QCheckBox(tr("Isosurface where w is"), this);
  this->isosurface_->setObjectName("volume.isosurface");
  this->isosurface_->setToolTip(
    tr("Show the surface where the winding number w (1 inside, 0 outside) has this value"));
  column->addWidget(this->isosurface_);
  this->level_ = new parts::ValueRow(this);
  this->level_->setObjectName("volume.level");
  this->level_->setToolTip(tr("The winding number on the isosurface"));
  column->addWidget(this->level_);
  this->area_ = new QLabel(this);
  this->area_->setObjectName("note");
  column->addWidget(this->area_);

  column->addSpacing(10);
  column->addWidget(parts::heading(tr("Volume"), this));
  this->cloud_ = new QCheckBox(tr("Show as a cloud"), this);
  this->cloud_->setToolTip(tr("Volume rendering: clear where w is 0, faint inside, dense where the "
                              "surface overlaps itself or is inside out"));
  this->cloud_->setObjectName("volume.cloud");
  column->addWidget(this->cloud_);

  column->addSpacing(10);
  this->surface_heading_ = parts::heading(tr("Surface"), this);
  column->addWidget(this->surface_heading_);
  this->surface_ = parts::option_box("volume.surface_look", this);
  this->surface_->setToolTip(tr("Drawing style of the surface around the slice"));
  column->addWidget(this->surface_);

  column->addStretch(1);
  this->close_ = parts::button(tr("Close the volume"), this);
  column->addWidget(this->close_);

  QObject::connect(this->compute_, &QPushButton::clicked, this, &VolumePanel::compute_requested);
  QObject::connect(this->cancel_, &QPushButton::clicked, this,
    [this]
    {
      this->set_note(tr("Stopping …"));
      Q_EMIT this->cancel_requested();
    });
  QObject::connect(this->slice_, &QCheckBox::toggled, this,
    [this](bool shown)
    {
      this->enable();
      Q_EMIT this->slice_requested(shown);
    });
  QObject::connect(
    this->orientations_, &QButtonGroup::idClicked, this, &VolumePanel::orientation_chosen);
  QObject::connect(
    this->position_, &parts::ValueRow::value_chosen, this, &VolumePanel::position_chosen);
  QObject::connect(this->isosurface_, &QCheckBox::toggled, this,
    [this](bool shown)
    {
      this->area_->setVisible(shown);
      Q_EMIT this->isosurface_requested(shown);
    });
  QObject::connect(this->level_, &parts::ValueRow::value_chosen, this,
    [this](double level)
    {
      // Show the isosurface, because a change of the level has no visible effect while the
      // isosurface is hidden.
      this->isosurface_->setChecked(true);
      Q_EMIT this->level_chosen(level);
    });
  QObject::connect(this->cloud_, &QCheckBox::toggled, this, &VolumePanel::cloud_requested);
  QObject::connect(this->surface_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    &VolumePanel::surface_appearance_chosen);
  QObject::connect(this->close_, &QPushButton::clicked, this, &VolumePanel::close_requested);
  keep_size_when_hidden(this->area_);
  this->area_->hide();
  this->set_area(0.0);
  this->set_state(false, false, false);
}

void VolumePanel::set_state(bool has_surface, bool computing, bool has_volume)
{
  this->has_volume_ = has_volume;
  this->samples_->setEnabled(has_surface && !computing);
  this->compute_->setText(has_volume ? tr("Compute again") : tr("Compute"));
  this->compute_->setEnabled(has_surface && !computing);
  this->cancel_->setVisible(computing);
  this->bar_->setVisible(computing);
  if (!computing)
  {
    this->bar_->setValue(0);
  }
  this->surface_heading_->setVisible(has_surface);
  this->surface_->setVisible(has_surface);
  this->enable();
}

/// Enable the widgets that apply. Without a volume, widgets for display are disabled.
void VolumePanel::enable()
{
  for (QWidget* widget :
    { static_cast<QWidget*>(this->slice_), static_cast<QWidget*>(this->isosurface_),
      static_cast<QWidget*>(this->level_), static_cast<QWidget*>(this->cloud_),
      static_cast<QWidget*>(this->surface_), static_cast<QWidget*>(this->close_) })
  {
    widget->setEnabled(this->has_volume_);
  }
  const bool sliced = this->has_volume_ && this->slice_->isChecked();
  for (QAbstractButton* orientation : this->orientations_->buttons())
  {
    orientation->setEnabled(sliced);
  }
  this->position_->setEnabled(sliced);
}

void VolumePanel::set_progress(double fraction, const QString& phase)
{
  this->bar_->setValue(static_cast<int>(1000.0 * fraction));
  if (this->note_->text() != tr("Stopping …"))
  {
    this->set_note(parts::progress_note(fraction, phase));
  }
}

void VolumePanel::set_note(const QString& text)
{
  this->note_->setText(text);
}

int VolumePanel::samples() const
{
  return resolutions[this->samples_->currentIndex()];
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
    area > 0.0 ? tr("Area %1").arg(area, 0, 'g', 5) : tr("No point has this value."));
}

double VolumePanel::level() const
{
  return this->level_->value();
}

int VolumePanel::surface_appearance() const
{
  return this->surface_->currentIndex();
}

} // namespace app::volume
