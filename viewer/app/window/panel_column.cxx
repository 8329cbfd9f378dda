#include "app/window/panel_column.h"

#include "app/handles/handle_tree.h"
#include "app/handles/side_panel.h"
#include "app/parts/panel_parts.h"
#include "app/tets/tet_panel.h"
#include "app/volume/volume_panel.h"
#include "app/weights/weight_panel.h"

#include <QButtonGroup>
#include <QFrame>
#include <QHBoxLayout>
#include <QPushButton>
#include <QScrollArea>
#include <QSplitter>
#include <QStyle>
#include <QVBoxLayout>
#include <QVariant>

#include <algorithm>

namespace app::window
{

namespace
{
constexpr int panel_count = 4;
} // namespace

PanelColumn::PanelColumn(QWidget* parent)
  : QWidget(parent), button_row_(new QFrame(this)), splitter_(new QSplitter(Qt::Vertical, this)),
    handles_(new handles::HandleTree(this)), buttons_(new QButtonGroup(this)),
    side_(new handles::SidePanel(this->handles_, this)), weight_(new weights::WeightPanel(this)),
    tet_(new tets::TetPanel(this)), volume_(new volume::VolumePanel(this))
{
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  this->button_row_->setObjectName("panel");
  auto* row = new QHBoxLayout(this->button_row_);
  row->setContentsMargins(16, 14, 16, 0);
  row->setSpacing(0);
  const char* const names[] = { QT_TR_NOOP("Pose"), QT_TR_NOOP("Weights"), QT_TR_NOOP("Tets"),
    QT_TR_NOOP("Volume") };
  const char* const tips[] = { QT_TR_NOOP("Bind handles, and drag them"),
    QT_TR_NOOP("Show the weights of each handle"),
    QT_TR_NOOP("Fill the surface with tets, and show its defects"),
    QT_TR_NOOP("Slices and isosurfaces of winding numbers") };
  for (int k = 0; k < panel_count; ++k)
  {
    QPushButton* segment = parts::button(tr(names[k]), this->button_row_);
    segment->setObjectName("segment");
    segment->setCheckable(true);
    segment->setToolTip(tr(tips[k]));
    this->buttons_->addButton(segment, k);
    // Make the widths of the buttons proportional to their texts, so that all four texts fit.
    row->addWidget(segment, segment->sizeHint().width());
  }
  column->addWidget(this->button_row_);
  this->splitter_->setChildrenCollapsible(false);
  this->splitter_->addWidget(this->handles_);
  auto* panels = new QWidget(this->splitter_);
  auto* below = new QVBoxLayout(panels);
  below->setContentsMargins(0, 0, 0, 0);
  below->setSpacing(0);
  // All panels have the same width, so that the 3D view keeps its size.
  const int width = this->side_->sizeHint().width();
  this->panels_ = { this->side_, this->scrolled(this->weight_, width),
    this->scrolled(this->tet_, width), this->scrolled(this->volume_, width) };
  for (QWidget* panel : this->panels_)
  {
    below->addWidget(panel, 1);
  }
  this->splitter_->addWidget(panels);
  this->splitter_->setStretchFactor(0, 1);
  this->splitter_->setStretchFactor(1, 0);
  column->addWidget(this->splitter_, 1);
  QObject::connect(
    this->splitter_, &QSplitter::splitterMoved, this, [this] { this->height_set_by_user_ = true; });
  QObject::connect(this->buttons_, &QButtonGroup::idClicked, this, &PanelColumn::show_panel);
  this->set_open(false, false, false);
}

/// Return a scroll area with the panel, because a small window cannot show all of it.
QWidget* PanelColumn::scrolled(QFrame* panel, int width)
{
  auto* scroll = new QScrollArea(this);
  scroll->setObjectName("panel_scroll");
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setFixedWidth(width);
  scroll->setWidget(panel);
  return scroll;
}

/// Give the list of handles the height that the panel does not need, but at most half of the total
/// height. Do nothing after the user has dragged the border.
void PanelColumn::distribute_height()
{
  constexpr int panel_height = 540;
  constexpr int minimum_height = 180;
  if (!this->height_set_by_user_ && !this->handles_->isHidden())
  {
    const int height = this->splitter_->height();
    const int list = std::max(minimum_height, std::min(height - panel_height, height / 2));
    this->splitter_->setSizes({ list, std::max(minimum_height, height - list) });
  }
}

void PanelColumn::resizeEvent(QResizeEvent* event)
{
  QWidget::resizeEvent(event);
  this->distribute_height();
}

void PanelColumn::set_open(bool volume, bool shape, bool surface)
{
  this->has_shape_ = shape;
  const bool open[] = { shape, surface, surface, surface || volume };
  this->button_row_->setVisible(surface || (shape && volume));
  const auto buttons = this->buttons_->buttons();
  QList<QAbstractButton*> row;
  for (int k = 0; k < panel_count; ++k)
  {
    buttons[k]->setVisible(open[k]);
    if (open[k])
    {
      row << buttons[k];
    }
  }
  for (int k = 0; k < row.size(); ++k)
  {
    // Draw one line between adjacent buttons. In the style sheet the last button has no left
    // border, so the button before it needs a right border.
    row[k]->setProperty("place",
      k == 0                  ? "first"
        : k + 1 == row.size() ? "last"
        : k + 2 == row.size() ? "middle"
                              : "second");
  }
  for (QAbstractButton* each : buttons)
  {
    each->style()->unpolish(each); // make the style read the property again
    each->style()->polish(each);
  }
  const int shown = this->buttons_->checkedId();
  if (shown < 0 || !open[shown])
  {
    this->show_panel(volume && !shape ? volume_slice : bind_and_pose);
  }
  else
  {
    this->show_handles();
  }
}

void PanelColumn::show_handles()
{
  const int panel = this->shown_panel();
  const bool shown = this->has_shape_ && (panel == bind_and_pose || panel == weights);
  if (this->handles_->isHidden() == shown)
  {
    this->handles_->setVisible(shown);
    this->distribute_height();
  }
}

int PanelColumn::shown_panel() const
{
  return this->buttons_->checkedId();
}

void PanelColumn::show_panel(int panel)
{
  if (!this->buttons_->button(panel) || this->buttons_->button(panel)->isHidden())
  {
    panel = bind_and_pose; // a session may contain a panel that is not available
  }
  this->buttons_->button(panel)->setChecked(true);
  for (QWidget* each : this->panels_)
  {
    // Hide all panels first. If two were visible for a moment, the window would grow.
    each->setVisible(false);
  }
  this->panels_[panel]->setVisible(true);
  this->show_handles();
  Q_EMIT this->panel_shown(panel);
}

} // namespace app::window
