#include "app/posing/key_strip.h"

#include "app/parts/panel_parts.h"
#include "app/parts/style.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace app::posing
{

using namespace bindpose;

namespace
{
constexpr int strip_margin = 14;
// maximum horizontal distance in pixels from the center of a key's mark at which a press grabs the
// key
constexpr int grab_distance = 6;

QString seconds_text(double seconds)
{
  return KeyStrip::tr("%1 s").arg(seconds, 0, 'f', 2);
}
} // namespace

// ---- The strip ---------------------------------------------------------------------------------

KeyStrip::KeyStrip(QWidget* parent) : QFrame(parent), track_(new KeyTrack(this))
{
  this->setObjectName("strip");
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(6, 6, 6, 6);
  rows->setSpacing(4);
  auto* line = new QHBoxLayout;
  line->setSpacing(4);
  const auto add = [&](const QString& text, const QString& tip)
  {
    QPushButton* new_button = parts::button(text, this);
    new_button->setToolTip(tip);
    line->addWidget(new_button);
    return new_button;
  };
  this->play_ = add(tr("Play"), tr("Play the key frames (Space)"));
  this->play_->setMinimumWidth(this->play_->fontMetrics().horizontalAdvance(tr("Pause")) + 26);
  this->loop_ = add(tr("Loop"), tr("Repeat from the start when the end is reached"));
  this->loop_->setObjectName("toggle");
  this->loop_->setCheckable(true);
  this->loop_->setChecked(true);
  this->time_label_ = new QLabel(seconds_text(0.0), this);
  this->time_label_->setMinimumWidth(this->time_label_->fontMetrics().horizontalAdvance("00.00 s"));
  this->time_label_->setAlignment(Qt::AlignCenter);
  line->addWidget(this->time_label_);
  this->add_ = add(tr("Set key"), tr("Store the current pose as a key at this time (K)"));
  this->remove_ = add(tr("Delete"), tr("Delete the key at this time"));
  line->addStretch(1);
  this->smooth_ = add(tr("Curved"),
    tr("Positions follow a smooth curve through all keys instead of straight lines.\n"
       "In both cases rotations take the shorter arc, and scale changes linearly."));
  this->smooth_->setObjectName("toggle");
  this->smooth_->setCheckable(true);
  this->rate_ = new QDoubleSpinBox(this);
  this->rate_->setRange(1.0, 240.0);
  this->rate_->setDecimals(0);
  this->rate_->setValue(24.0);
  this->rate_->setSuffix(tr(" /s"));
  this->rate_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  this->rate_->setKeyboardTracking(false);
  this->rate_->setToolTip(tr("Frames per second of an exported film"));
  rows->addLayout(line);
  auto* below = new QHBoxLayout;
  below->setSpacing(6);
  below->addWidget(this->track_, 1);
  below->addWidget(this->rate_, 0, Qt::AlignBottom);
  rows->addLayout(below);

  QObject::connect(this->play_, &QPushButton::clicked, this,
    [this] { Q_EMIT this->play_requested(!this->playing_); });
  QObject::connect(this->loop_, &QPushButton::clicked, this, &KeyStrip::loop_chosen);
  QObject::connect(this->add_, &QPushButton::clicked, this, &KeyStrip::set_key_requested);
  QObject::connect(this->remove_, &QPushButton::clicked, this,
    [this] { Q_EMIT this->remove_requested(this->keys_.index_at(this->time_)); });
  QObject::connect(this->smooth_, &QPushButton::clicked, this, &KeyStrip::smooth_chosen);
  QObject::connect(this->rate_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    &KeyStrip::rate_chosen);
  QObject::connect(this->track_, &KeyTrack::scrubbed, this, &KeyStrip::scrubbed);
  QObject::connect(this->track_, &KeyTrack::scrub_ended, this, &KeyStrip::scrub_ended);
  QObject::connect(this->track_, &KeyTrack::key_moved, this, &KeyStrip::key_moved);
  this->enable();
}

void KeyStrip::set_keys(const KeyFrames& keys)
{
  const QSignalBlocker blocker(this->rate_);
  this->keys_ = keys;
  this->track_->set_keys(keys);
  this->loop_->setChecked(keys.loop);
  this->smooth_->setChecked(keys.interpolation == KeyInterpolation::spline);
  this->rate_->setValue(keys.frames_per_second);
  this->enable();
}

void KeyStrip::set_time(double seconds)
{
  this->time_ = seconds;
  this->time_label_->setText(seconds_text(seconds));
  this->track_->set_time(seconds);
  this->enable();
}

void KeyStrip::set_playing(bool playing)
{
  this->playing_ = playing;
  this->play_->setText(playing ? tr("Pause") : tr("Play"));
  this->enable();
}

void KeyStrip::set_ready(bool ready)
{
  this->ready_ = ready;
  this->enable();
}

void KeyStrip::enable()
{
  this->play_->setEnabled(this->ready_ && (this->playing_ || this->keys_.keys().size() > 1));
  this->add_->setEnabled(this->ready_ && !this->playing_);
  this->remove_->setEnabled(!this->playing_ && this->keys_.index_at(this->time_) >= 0);
  this->track_->setEnabled(this->ready_);
}

// ---- The track ---------------------------------------------------------------------------------

KeyTrack::KeyTrack(QWidget* parent) : QWidget(parent)
{
  this->setFocusPolicy(Qt::TabFocus);
  this->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  this->setToolTip(tr("Drag to move through time; drag a key to another time"));
  this->setAccessibleName(tr("Time"));
}

QSize KeyTrack::sizeHint() const
{
  return { 300, 2 * this->fontMetrics().lineSpacing() + 6 };
}

/// Return the length of the track in seconds. The track has space for another key after the last
/// key.
double KeyTrack::length() const
{
  return std::max(2.0, std::ceil(this->keys_.duration() + 0.5));
}

int KeyTrack::pixel(double seconds) const
{
  return strip_margin +
    static_cast<int>(std::lround(seconds / this->length() * (this->width() - 2 * strip_margin)));
}

double KeyTrack::seconds_at(int x) const
{
  const double seconds =
    static_cast<double>(x - strip_margin) / (this->width() - 2 * strip_margin) * this->length();
  // Round to hundredths of a second, so that the times of keys have few digits.
  return std::clamp(std::round(100.0 * seconds) / 100.0, 0.0, this->length());
}

int KeyTrack::key_at(const QPoint& at) const
{
  for (std::size_t k = 0; k < this->keys_.keys().size(); ++k)
  {
    if (std::abs(this->pixel(this->keys_.keys()[k].time) - at.x()) <= grab_distance)
    {
      return static_cast<int>(k);
    }
  }
  return -1;
}

void KeyTrack::set_keys(const KeyFrames& keys)
{
  this->keys_ = keys;
  this->update();
}

void KeyTrack::set_time(double seconds)
{
  this->time_ = seconds;
  this->update();
}

void KeyTrack::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const bool on = this->isEnabled();
  const int middle = this->height() - this->fontMetrics().lineSpacing() / 2 - 6;
  const QColor line = parts::theme_color(on ? "scroll" : "line"),
               ink = parts::theme_color(on ? "note" : "off");
  painter.setPen(QPen(line, 2));
  painter.drawLine(strip_margin, middle, this->width() - strip_margin, middle);
  // Draw as many time labels as there is space for.
  const double seconds_per_label = this->length() / (this->width() - 2.0 * strip_margin) *
    (this->fontMetrics().horizontalAdvance("000 s") + 14);
  const double steps[] = { 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 300.0, 1800.0 };
  const double* step = std::find_if(
    std::begin(steps), std::end(steps) - 1, [&](double each) { return each >= seconds_per_label; });
  for (double t = 0.0; t <= this->length() + 1e-9; t += *step)
  {
    const int x = this->pixel(t);
    painter.setPen(QPen(line, 1));
    painter.drawLine(x, middle - 4, x, middle + 4);
    painter.setPen(ink);
    const QString text = tr("%1 s").arg(t);
    const int width = this->fontMetrics().horizontalAdvance(text);
    painter.drawText(
      std::clamp(x - width / 2, 0, this->width() - width), this->fontMetrics().ascent() + 1, text);
  }
  if (this->keys_.keys().empty())
  {
    painter.setPen(ink);
    const QRect below(strip_margin + 20, middle - this->fontMetrics().lineSpacing() / 2 - 1,
      this->width() - 2 * strip_margin - 20, this->fontMetrics().lineSpacing() + 2);
    QString hint =
      tr("Pose the shape and click Set key; choose another time, pose again and set another key.");
    int width = this->fontMetrics().horizontalAdvance(hint) + 12;
    if (width > below.width())
    {
      hint = tr("Pose the shape, then click Set key.");
      width = this->fontMetrics().horizontalAdvance(hint) + 12;
    }
    const QRect hint_rectangle(
      below.left(), below.top(), std::min(width, below.width()), below.height());
    painter.fillRect(hint_rectangle, this->palette().window());
    painter.drawText(hint_rectangle, Qt::AlignCenter, hint);
  }
  for (std::size_t k = 0; k < this->keys_.keys().size(); ++k)
  {
    const bool is_dragged = static_cast<int>(k) == this->dragged_key_ && this->moved_;
    const double time = is_dragged ? this->dragged_time_ : this->keys_.keys()[k].time;
    const int x = this->pixel(time);
    const bool is_current = std::abs(time - this->time_) < 5e-4;
    painter.setPen(QPen(parts::theme_color("key_edge"), 1.2));
    painter.setBrush(parts::theme_color(is_current || is_dragged ? "key_now" : "key"));
    const QPoint diamond[4] = { { x, middle - 6 }, { x + 6, middle }, { x, middle + 6 },
      { x - 6, middle } };
    painter.drawPolygon(diamond, 4);
  }
  const int time_x = this->pixel(std::min(this->time_, this->length()));
  painter.setPen(QPen(parts::theme_color(on ? "accent" : "accent_off"), 2));
  painter.drawLine(time_x, 2 + this->fontMetrics().lineSpacing(), time_x, this->height() - 1);
  if (this->hasFocus())
  {
    painter.setPen(QPen(parts::theme_color("accent"), 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(this->rect().adjusted(0, 0, -1, -1), 4, 4);
  }
}

void KeyTrack::mousePressEvent(QMouseEvent* event)
{
  if (event->button() != Qt::LeftButton)
  {
    return;
  }
  this->dragged_key_ = this->key_at(event->pos());
  this->moved_ = false;
  this->scrubbing_ = true;
  Q_EMIT this->scrubbed(this->dragged_key_ >= 0
      ? this->keys_.keys()[static_cast<std::size_t>(this->dragged_key_)].time
      : this->seconds_at(event->x()));
}

void KeyTrack::mouseMoveEvent(QMouseEvent* event)
{
  if (this->dragged_key_ >= 0)
  {
    const double time = this->keys_.keys()[static_cast<std::size_t>(this->dragged_key_)].time;
    this->moved_ = this->moved_ || std::abs(event->x() - this->pixel(time)) > 3;
    this->dragged_time_ = this->seconds_at(event->x());
    this->update();
  }
  else if (this->scrubbing_)
  {
    Q_EMIT this->scrubbed(this->seconds_at(event->x()));
  }
}

void KeyTrack::mouseReleaseEvent(QMouseEvent* event)
{
  if (event->button() != Qt::LeftButton || !this->scrubbing_)
  {
    return;
  }
  const int key = this->moved_ ? this->dragged_key_ : -1;
  this->dragged_key_ = -1;
  this->moved_ = false;
  this->scrubbing_ = false;
  Q_EMIT this->scrub_ended();
  if (key >= 0)
  {
    Q_EMIT this->key_moved(key, this->dragged_time_);
  }
}

void KeyTrack::keyPressEvent(QKeyEvent* event)
{
  const double step = 1.0 / this->keys_.frames_per_second;
  const int direction = event->key() == Qt::Key_Left ? -1 : event->key() == Qt::Key_Right ? 1 : 0;
  if (direction == 0)
  {
    QWidget::keyPressEvent(event);
    return;
  }
  Q_EMIT this->scrubbed(std::clamp(this->time_ + direction * step, 0.0, this->length()));
  Q_EMIT this->scrub_ended();
}

} // namespace app::posing
