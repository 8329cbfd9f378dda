#include "app/parts/value_row.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QSlider>

#include <algorithm>
#include <cmath>

namespace app::parts
{

namespace
{
constexpr int slider_steps = 1000;
} // namespace

ValueRow::ValueRow(QWidget* parent)
  : QWidget(parent), slider_(new QSlider(Qt::Horizontal, this)), field_(new QDoubleSpinBox(this))
{
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8);
  this->slider_->setRange(0, slider_steps);
  this->slider_->setPageStep(slider_steps / 20);
  this->slider_->setMinimumWidth(80);
  this->field_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  this->field_->setKeyboardTracking(false); // emit no signals while a number is being typed
  this->field_->setAlignment(Qt::AlignRight);
  this->field_->setFixedWidth(this->field_->fontMetrics().horizontalAdvance("-0000.0000") + 18);
  row->addWidget(this->slider_, 1);
  row->addWidget(this->field_);
  QObject::connect(this->slider_, &QSlider::valueChanged, this,
    [this](int step)
    {
      const double span = this->field_->maximum() - this->field_->minimum();
      const QSignalBlocker blocker(this->field_);
      this->field_->setValue(this->field_->minimum() + span * step / slider_steps);
      Q_EMIT this->value_chosen(this->field_->value());
    });
  QObject::connect(this->field_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    [this](double value)
    {
      this->set_value(value);
      Q_EMIT this->value_chosen(this->field_->value());
    });
}

void ValueRow::set_range(double lowest, double highest)
{
  const QSignalBlocker blocker(this->field_);
  // Use enough digits to show the smallest change of the slider.
  const double step = (highest - lowest) / slider_steps;
  const int digits =
    step > 0.0 ? std::clamp(static_cast<int>(std::ceil(-std::log10(step))), 0, 8) : 3;
  this->field_->setDecimals(digits);
  this->field_->setRange(lowest, highest);
  this->field_->setSingleStep(10.0 * step);
}

void ValueRow::set_value(double value)
{
  const QSignalBlocker blocker(this->field_);
  const QSignalBlocker quiet_too(this->slider_);
  this->field_->setValue(value);
  const double span = this->field_->maximum() - this->field_->minimum();
  if (!this->slider_->isSliderDown()) // a slider that is dragged must stay under the mouse
  {
    this->slider_->setValue(span > 0.0
        ? static_cast<int>(std::lround(slider_steps * (value - this->field_->minimum()) / span))
        : 0);
  }
}

double ValueRow::value() const
{
  return this->field_->value();
}

void ValueRow::choose(double option)
{
  const double span = this->field_->maximum() - this->field_->minimum();
  this->set_value(this->option_is_fraction_ ? this->field_->minimum() + option * span : option);
  Q_EMIT this->value_chosen(this->value());
}

} // namespace app::parts
