#include "panel_column.h"

#include "panel_parts.h"
#include "side_panel.h"
#include "tet_panel.h"
#include "volume_panel.h"
#include "weight_panel.h"

#include <QButtonGroup>
#include <QFrame>
#include <QHBoxLayout>
#include <QPushButton>
#include <QStyle>
#include <QVBoxLayout>
#include <QVariant>

namespace
{
constexpr int panel_count = 4;
} // namespace

PanelColumn::PanelColumn(QWidget* parent)
  : QWidget(parent), choice_(new QFrame(this)), buttons_(new QButtonGroup(this)),
    side_(new SidePanel(this)), weight_(new WeightPanel(this)), tet_(new TetPanel(this)),
    volume_(new VolumePanel(this))
{
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  this->choice_->setObjectName("panel");
  auto* row = new QHBoxLayout(this->choice_);
  row->setContentsMargins(16, 14, 16, 0);
  row->setSpacing(0);
  const char* const names[] = { QT_TR_NOOP("Pose"), QT_TR_NOOP("Weights"), QT_TR_NOOP("Tets"),
    QT_TR_NOOP("Volume") };
  const char* const tips[] = { QT_TR_NOOP("Bind handles, and drag them"),
    QT_TR_NOOP("Look at the weights of each handle"),
    QT_TR_NOOP("Fill the surface with tets; see where it is unclean"),
    QT_TR_NOOP("Slices and isosurfaces of winding numbers") };
  for (int k = 0; k < panel_count; ++k)
  {
    QPushButton* segment = button(tr(names[k]), this->choice_);
    segment->setObjectName("segment");
    segment->setCheckable(true);
    segment->setToolTip(tr(tips[k]));
    this->buttons_->addButton(segment, k);
    row->addWidget(segment, segment->sizeHint().width()); // four words leave no room to share
  }
  column->addWidget(this->choice_);
  for (QFrame* panel : { static_cast<QFrame*>(this->side_), static_cast<QFrame*>(this->weight_),
         static_cast<QFrame*>(this->tet_), static_cast<QFrame*>(this->volume_) })
  {
    column->addWidget(panel, 1);
    // Equally wide, so that the picture does not jump.
    if (panel != this->side_)
    {
      panel->setFixedWidth(this->side_->sizeHint().width());
    }
  }
  QObject::connect(this->buttons_, &QButtonGroup::idClicked, this, &PanelColumn::show_panel);
  this->set_open(false, false, false);
}

void PanelColumn::set_open(bool volume, bool shape, bool surface)
{
  const bool open[] = { shape, surface, surface, volume };
  this->choice_->setVisible(shape + surface + volume > 1);
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
    // One line between two: only the last but one has a right one, next to the last's none.
    row[k]->setProperty("place",
      k == 0                  ? "first"
        : k + 1 == row.size() ? "last"
        : k + 2 == row.size() ? "middle"
                              : "second");
  }
  for (QAbstractButton* each : buttons)
  {
    each->style()->unpolish(each); // the style looks at the place again
    each->style()->polish(each);
  }
  const int shown = this->buttons_->checkedId();
  if (shown < 0 || !open[shown])
  {
    this->show_panel(volume && !shape ? volume_slice : bind_and_pose);
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
    panel = bind_and_pose; // of a session that had something else open
  }
  this->buttons_->button(panel)->setChecked(true);
  QFrame* const panels[] = { this->side_, this->weight_, this->tet_, this->volume_ };
  for (QFrame* each : panels)
  {
    each->setVisible(false); // first: the window grows where two must fit for a moment
  }
  panels[panel]->setVisible(true);
  Q_EMIT this->panel_shown(panel);
}
