#include "app/tets/tet_panel.h"

#include "app/parts/option_widgets.h"
#include "app/parts/panel_parts.h"
#include "app/parts/value_row.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace app::tets
{

TetPanel::TetPanel(QWidget* parent) : QFrame(parent)
{
  this->setObjectName("panel");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(7);
  const auto keep_size_when_hidden = [](QWidget* widget)
  {
    // Hidden widgets keep their space, so that the widgets below them do not move.
    QSizePolicy policy = widget->sizePolicy();
    policy.setRetainSizeWhenHidden(true);
    widget->setSizePolicy(policy);
  };
  const auto note = [this]
  {
    auto* line = new QLabel(this);
    line->setObjectName("note");
    return line;
  };

  column->addWidget(parts::heading(tr("Tets"), this));
  this->method_ = parts::option_box("tets.method", this);
  this->method_->setToolTip(
    tr("Constrained: keeps the triangles of the surface.\n"
       "Remeshed: well-shaped tets.\n"
       "Embedding lattice: cubes that contain the surface but do not follow it.\n"
       "Alpha wrap: the inside of a wrapping surface; open surfaces become shells.\n"
       "fTetWild: available if that program is installed.\n"
       "Whole hull: also contains the outside tets, to show how tets are classified."));
  column->addWidget(this->method_);
  auto* buttons = new QHBoxLayout;
  this->make_ = parts::button(tr("Make tets"), this);
  this->make_->setObjectName("primary");
  this->make_->setToolTip(tr("Fill the surface with tets in the background"));
  this->cancel_ = parts::button(tr("Cancel"), this);
  this->cancel_->setToolTip(tr("Cancel; the tets are unchanged"));
  buttons->addWidget(this->make_, 1);
  buttons->addWidget(this->cancel_);
  column->addLayout(buttons);
  this->bar_ = new QProgressBar(this);
  this->bar_->setRange(0, 1000);
  this->bar_->setTextVisible(false);
  keep_size_when_hidden(this->bar_);
  column->addWidget(this->bar_);
  this->note_ = note();
  this->note_->setWordWrap(true);
  this->note_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  this->note_->setFixedHeight(2 * this->note_->fontMetrics().lineSpacing() + 2);
  column->addWidget(this->note_);

  this->tets_ = new QCheckBox(tr("Show the tets"), this);
  this->tets_->setObjectName("tets.shown");
  this->tets_->setToolTip(tr("Show the tets (tetrahedra) at rest instead of the surface"));
  column->addWidget(this->tets_);
  this->colors_ = parts::option_box("tets.colors", this);
  this->colors_->setToolTip(
    tr("Winding number: at the center of each tet.\n"
       "Label: inside or outside, and where the label contradicts the winding number.\n"
       "Quality: the smallest dihedral angle.\n"
       "Method: the method that made the tets."));
  column->addWidget(this->colors_);

  column->addSpacing(10);
  column->addWidget(parts::heading(tr("Cut"), this));
  this->cut_ = new QCheckBox(tr("Cut the tets"), this);
  this->cut_->setChecked(true);
  this->cut_->setObjectName("tets.cut");
  this->cut_->setToolTip(
    tr("Hide the tets whose center is in front of a plane; the mouse can drag the plane"));
  column->addWidget(this->cut_);
  this->orientations_ = parts::orientation_segments(column, this, "tets.orientation");
  this->position_ = new parts::ValueRow(this);
  this->position_->setObjectName("tets.place");
  this->position_->set_option_is_fraction();
  this->position_->setToolTip(
    tr("Position of the plane along its normal; the mouse can also drag the plane"));
  column->addWidget(this->position_);
  this->other_side_ = new QCheckBox(tr("Keep the other side"), this);
  this->other_side_->setObjectName("tets.other_side");
  this->other_side_->setToolTip(
    tr("Show the tets in front of the plane instead of those behind it"));
  column->addWidget(this->other_side_);
  this->count_ = note();
  keep_size_when_hidden(this->count_);
  column->addWidget(this->count_);

  column->addSpacing(10);
  this->shrink_label_ = parts::heading(tr("Size of each tet"), this);
  column->addWidget(this->shrink_label_);
  this->shrink_ = parts::option_row("tets.shrink", this);
  this->shrink_->setToolTip(tr("Scale of each tet; below 1 there are gaps between the tets"));
  column->addWidget(this->shrink_);

  column->addSpacing(10);
  column->addWidget(parts::heading(tr("Surface"), this));
  this->defects_ = new QCheckBox(tr("Show its defects"), this);
  this->defects_->setToolTip(
    tr("Mark open, intersecting and duplicate parts, each type in its own color"));
  this->defects_->setObjectName("defects.shown");
  column->addWidget(this->defects_);
  this->defects_note_ = note();
  keep_size_when_hidden(this->defects_note_);
  column->addWidget(this->defects_note_);
  column->addStretch(1);

  QObject::connect(this->make_, &QPushButton::clicked, this,
    [this] { Q_EMIT this->tets_requested(this->method_->currentIndex()); });
  QObject::connect(this->cancel_, &QPushButton::clicked, this,
    [this]
    {
      this->set_note(tr("Stopping …"));
      Q_EMIT this->cancel_requested();
    });
  QObject::connect(this->tets_, &QCheckBox::toggled, this,
    [this](bool shown)
    {
      this->enable();
      Q_EMIT this->show_tets_requested(shown);
    });
  QObject::connect(this->cut_, &QCheckBox::toggled, this,
    [this](bool cut)
    {
      this->enable();
      Q_EMIT this->cut_requested(cut);
    });
  QObject::connect(this->other_side_, &QCheckBox::toggled, this, &TetPanel::other_side_requested);
  QObject::connect(
    this->orientations_, &QButtonGroup::idClicked, this, &TetPanel::orientation_chosen);
  QObject::connect(
    this->position_, &parts::ValueRow::value_chosen, this, &TetPanel::position_chosen);
  QObject::connect(this->shrink_, &parts::ValueRow::value_chosen, this, &TetPanel::shrink_chosen);
  QObject::connect(this->colors_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    &TetPanel::colors_chosen);
  QObject::connect(this->defects_, &QCheckBox::toggled, this, &TetPanel::defects_requested);
  this->set_state(false, false, false);
}

void TetPanel::set_state(bool has_surface, bool is_making_tets, bool has_tets)
{
  this->has_tets_ = has_tets;
  this->method_->setEnabled(has_surface && !is_making_tets);
  this->make_->setText(has_tets ? tr("Make tets again") : tr("Make tets"));
  this->make_->setEnabled(has_surface && !is_making_tets);
  this->cancel_->setVisible(is_making_tets);
  this->bar_->setValue(0);
  this->bar_->setVisible(is_making_tets);
  this->defects_->setEnabled(has_surface);
  this->enable();
}

/// Enable the widgets that apply to the available and the displayed data.
void TetPanel::enable()
{
  const bool shown = this->has_tets_ && this->tets_->isChecked();
  this->tets_->setEnabled(this->has_tets_);
  for (QWidget* widget : { static_cast<QWidget*>(this->cut_), static_cast<QWidget*>(this->colors_),
         static_cast<QWidget*>(this->shrink_label_), static_cast<QWidget*>(this->shrink_) })
  {
    widget->setEnabled(shown);
  }
  const bool cut = shown && this->cut_->isChecked();
  this->position_->setEnabled(cut);
  this->other_side_->setEnabled(cut);
  for (QAbstractButton* orientation : this->orientations_->buttons())
  {
    orientation->setEnabled(cut);
  }
  this->count_->setVisible(shown);
}

void TetPanel::set_progress(double fraction, const QString& phase)
{
  this->bar_->setValue(static_cast<int>(1000.0 * fraction));
  if (this->note_->text() != tr("Stopping …"))
  {
    this->set_note(parts::progress_note(fraction, phase));
  }
}

void TetPanel::set_note(const QString& text)
{
  this->note_->setText(text);
}

void TetPanel::set_position(double position, double lowest, double highest)
{
  this->position_->set_range(lowest, highest);
  this->position_->set_value(position);
}

void TetPanel::set_count(qlonglong shown, qlonglong all)
{
  this->count_->setText(shown == 0 ? tr("There are no tets on this side.")
      : shown == all               ? tr("All %L1 tets").arg(all)
                                   : tr("%L1 of %L2 tets").arg(shown).arg(all));
}

void TetPanel::set_defects_note(const QString& text)
{
  this->defects_note_->setText(text);
}

bool TetPanel::wants_tets() const
{
  return this->tets_->isChecked();
}

void TetPanel::show_tets(bool shown)
{
  this->tets_->setChecked(shown);
}

bool TetPanel::wants_defects() const
{
  return this->defects_->isChecked();
}

void TetPanel::show_defects(bool shown)
{
  this->defects_->setChecked(shown);
}

void TetPanel::set_colors(int colors)
{
  const QSignalBlocker blocker(this->colors_);
  this->colors_->setCurrentIndex(colors);
}

} // namespace app::tets
