#include "app/handles/edit_tools.h"

#include "app/parts/panel_parts.h"

#include <QAction>
#include <QCheckBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>

#include <algorithm>
#include <cmath>

namespace app::handles
{

namespace
{
constexpr int row_margin = 5;
constexpr int group_spacing = 6; // pixels between groups of buttons
constexpr int button_spacing = 2; // pixels between buttons of a group

/// Range of the logarithmic slider for the radius of the brush, as fractions of the shape's
/// diagonal.
constexpr double minimum_radius = 0.002;
constexpr double maximum_radius = 0.5;
constexpr int radius_steps = 200;

int radius_to_step(double radius)
{
  const double fraction =
    std::log(radius / minimum_radius) / std::log(maximum_radius / minimum_radius);
  return static_cast<int>(std::lround(radius_steps * std::clamp(fraction, 0.0, 1.0)));
}
} // namespace

// ---- The row of tools --------------------------------------------------------------------------

EditTools::EditTools(const QList<QList<QAction*>>& groups, QWidget* parent) : QFrame(parent)
{
  this->setObjectName("tools");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(row_margin, 5, row_margin, 5);
  row->setSpacing(button_spacing);
  for (const QList<QAction*>& group : groups)
  {
    if (!this->buttons_.empty())
    {
      row->addSpacing(group_spacing);
    }
    QList<QToolButton*> buttons;
    for (QAction* action : group)
    {
      auto* button = new QToolButton(this);
      button->setDefaultAction(action);
      button->setAutoRaise(true);
      button->setIconSize(QSize(20, 20));
      button->setFocusPolicy(Qt::TabFocus);
      button->setAccessibleName(action->toolTip());
      row->addWidget(button);
      buttons << button;
    }
    this->buttons_ << buttons;
  }
  row->addStretch(1);
  this->show_button_texts(0);
}

void EditTools::show_button_texts(int groups)
{
  for (int group = 0; group < this->buttons_.size(); ++group)
  {
    for (QToolButton* button : this->buttons_[group])
    {
      button->setToolButtonStyle(
        group < groups ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
    }
  }
}

int EditTools::width_with_texts(int groups) const
{
  int width = 2 * row_margin + (this->buttons_.size() - 1) * group_spacing;
  for (int group = 0; group < this->buttons_.size(); ++group)
  {
    for (const QToolButton* button : this->buttons_[group])
    {
      // Width of a button: spacing, padding, icon and, if shown, a gap and the text.
      const int text = button->fontMetrics().horizontalAdvance(button->text()) + 8;
      width += button_spacing + 20 + 14 + 4 + (group < groups ? text : 0);
    }
  }
  return width;
}

QSize EditTools::minimumSizeHint() const
{
  return { this->width_with_texts(0), this->QFrame::minimumSizeHint().height() };
}

void EditTools::fit()
{
  int groups = this->buttons_.size();
  while (groups > 0 && this->width_with_texts(groups) > this->width())
  {
    --groups;
  }
  this->show_button_texts(groups);
}

void EditTools::resizeEvent(QResizeEvent* event)
{
  QFrame::resizeEvent(event);
  this->fit();
}

bool EditTools::event(QEvent* event)
{
  const bool is_font_change =
    event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange;
  const bool result = QFrame::event(event);
  if (is_font_change)
  {
    this->fit();
  }
  return result;
}

// ---- The bar of a mode -------------------------------------------------------------------------

ModeBar::ModeBar(QAction* inside, QWidget* parent) : QFrame(parent)
{
  this->setObjectName("mode");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 5, 6, 5);
  row->setSpacing(10);
  this->title_ = new QLabel(this);
  this->title_->setObjectName("heading");
  row->addWidget(this->title_);
  this->inside_ = new QCheckBox(tr("Inside the shape"), this);
  this->inside_->setToolTip(inside->toolTip());
  this->inside_->setFocusPolicy(Qt::TabFocus);
  this->inside_->setChecked(inside->isChecked());
  QObject::connect(this->inside_, &QCheckBox::clicked, inside, &QAction::trigger);
  QObject::connect(inside, &QAction::toggled, this->inside_, &QCheckBox::setChecked);
  row->addWidget(this->inside_);
  this->end_cage_ = parts::button(tr("Leave cage open"), this);
  this->end_cage_->setToolTip(tr("End the cage without closing it (Enter or double click)"));
  row->addWidget(this->end_cage_);
  this->brush_ = new QLabel(tr("Brush"), this);
  row->addWidget(this->brush_);
  this->radius_ = new QSlider(Qt::Horizontal, this);
  this->radius_->setRange(0, radius_steps);
  this->radius_->setFixedWidth(110);
  this->radius_->setFocusPolicy(Qt::TabFocus);
  this->radius_->setToolTip(tr("Radius of the brush ([ and ], or Shift + wheel)"));
  row->addWidget(this->radius_);
  this->new_region_ = parts::button(tr("New region"), this);
  this->new_region_->setToolTip(tr("Start a new region with the next stroke"));
  row->addWidget(this->new_region_);
  QPushButton* done = parts::button(tr("Done"), this);
  done->setToolTip(tr("Back to posing (Esc)"));
  row->addWidget(done);
  QObject::connect(this->end_cage_, &QPushButton::clicked, this, &ModeBar::end_cage_requested);
  QObject::connect(this->new_region_, &QPushButton::clicked, this, &ModeBar::new_region_requested);
  QObject::connect(this->radius_, &QSlider::valueChanged, this,
    [this](int step)
    {
      Q_EMIT this->radius_chosen(
        minimum_radius * std::pow(maximum_radius / minimum_radius, step / double{ radius_steps }));
    });
  QObject::connect(done, &QPushButton::clicked, this, &ModeBar::done_requested);
  this->hide();
}

void ModeBar::show_state(const State& state)
{
  this->title_->setText(state.title);
  this->inside_->setVisible(state.shows_inside);
  this->end_cage_->setVisible(state.cage);
  this->end_cage_->setEnabled(state.making_cage);
  this->brush_->setVisible(state.shows_brush);
  this->radius_->setVisible(state.shows_brush);
  this->new_region_->setVisible(state.shows_brush);
  this->new_region_->setEnabled(state.has_region);
  const QSignalBlocker blocker(this->radius_);
  this->radius_->setValue(radius_to_step(state.radius));
  this->setVisible(!state.title.isEmpty());
}

} // namespace app::handles
