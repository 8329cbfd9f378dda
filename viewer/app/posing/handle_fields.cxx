#include "app/posing/handle_fields.h"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>

namespace app::posing
{

using namespace bindpose;

HandleFields::HandleFields(QWidget* parent) : QWidget(parent)
{
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(4);
  const auto field = [this](QWidget* in, double lowest, double highest, double step, int digits)
  {
    auto* box = new QDoubleSpinBox(in);
    box->setRange(lowest, highest);
    box->setSingleStep(step);
    box->setDecimals(digits);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setKeyboardTracking(false); // emit no signals while a number is being typed
    box->setAlignment(Qt::AlignRight);
    box->setMinimumWidth(box->fontMetrics().horizontalAdvance("-00.000") + 14);
    return box;
  };
  this->count_ = new QLabel(this);
  this->count_->setObjectName("note");
  rows->addWidget(this->count_);
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(4);
  grid->setVerticalSpacing(4);
  grid->setColumnStretch(1, 1);
  grid->setColumnStretch(2, 1);
  grid->setColumnStretch(3, 1);
  const auto label = [&](QGridLayout* in, int row, const QString& text, const QString& tip)
  {
    auto* name = new QLabel(text, this);
    name->setToolTip(tip);
    in->addWidget(name, row, 0);
    return name;
  };
  this->names_ = { label(grid, 0, tr("Move"),
                     tr("Translation along x, y and z, relative to the parent")),
    label(grid, 1, tr("Turn °"),
      tr("Rotation about x, then y, then z, through the position of the handle")),
    label(grid, 2, tr("Scale"), tr("Scale factor; 1 is the size at rest")) };
  for (int k = 0; k < 3; ++k)
  {
    this->fields_[k] = field(this, -1e6, 1e6, 0.01, 3);
    this->fields_[3 + k] = field(this, -360.0, 360.0, 5.0, 1);
    this->fields_[3 + k]->setWrapping(true);
    grid->addWidget(this->fields_[k], 0, 1 + k);
    grid->addWidget(this->fields_[3 + k], 1, 1 + k);
  }
  this->fields_[6] = field(this, 0.001, 1000.0, 0.05, 3);
  grid->addWidget(this->fields_[6], 2, 1);
  rows->addLayout(grid);
  this->bone_rows_ = new QWidget(this);
  auto* bone = new QGridLayout(this->bone_rows_);
  bone->setContentsMargins(0, 0, 0, 0);
  bone->setHorizontalSpacing(4);
  bone->setVerticalSpacing(4);
  bone->setColumnStretch(1, 1);
  bone->setColumnStretch(2, 1);
  bone->setColumnStretch(3, 1);
  label(bone, 0, tr("Stretch"),
    tr("Length divided by the length at rest; visible with the method Stretch"));
  label(bone, 1, tr("Twist °"),
    tr("Rotation about the bone at head and tail; visible with the method Stretch"));
  this->fields_[7] = field(this->bone_rows_, 0.001, 1000.0, 0.05, 3);
  bone->addWidget(this->fields_[7], 0, 1);
  for (int k = 0; k < 2; ++k)
  {
    this->fields_[8 + k] = field(this->bone_rows_, -3600.0, 3600.0, 5.0, 1);
    bone->addWidget(this->fields_[8 + k], 1, 1 + k);
  }
  rows->addWidget(this->bone_rows_);
  for (std::size_t k = 0; k < this->fields_.size(); ++k)
  {
    QDoubleSpinBox* each = this->fields_[k];
    QObject::connect(each, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
      [this, k] { Q_EMIT this->values_chosen(static_cast<int>(k)); });
    QObject::connect(each, &QAbstractSpinBox::editingFinished, this, &HandleFields::edit_ended);
  }
  this->layer_row_ = new QWidget(this);
  auto* layer = new QGridLayout(this->layer_row_);
  layer->setContentsMargins(0, 0, 0, 0);
  layer->setHorizontalSpacing(4);
  layer->setColumnStretch(2, 1);
  label(layer, 0, tr("Layer"), tr("Where the shape overlaps itself, the larger layer is in front"));
  this->layer_ = field(this->layer_row_, -1000.0, 1000.0, 1.0, 1);
  this->layer_->setToolTip(
    tr("Layer of the handle: where the shape overlaps itself,\nthe larger layer is in front"));
  this->layer_->setAccessibleName(tr("Layer"));
  layer->addWidget(this->layer_, 0, 1);
  QObject::connect(this->layer_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
    &HandleFields::layer_chosen);
  rows->addWidget(this->layer_row_);
  this->shear_note_ = new QLabel(tr("The handle also has a shear or nonuniform scale."), this);
  this->shear_note_->setObjectName("note");
  this->shear_note_->setToolTip(
    tr("Typing a number in any of these fields removes the shear or nonuniform scale"));
  this->shear_note_->setWordWrap(true);
  rows->addWidget(this->shear_note_);
  // Names for users of screen readers, who cannot see the grid.
  const char* const names[] = { QT_TR_NOOP("Move along x"), QT_TR_NOOP("Move along y"),
    QT_TR_NOOP("Move along z"), QT_TR_NOOP("Turn about x, degrees"),
    QT_TR_NOOP("Turn about y, degrees"), QT_TR_NOOP("Turn about z, degrees"), QT_TR_NOOP("Scale"),
    QT_TR_NOOP("Stretch"), QT_TR_NOOP("Twist at the head, degrees"),
    QT_TR_NOOP("Twist at the tail, degrees") };
  for (std::size_t k = 0; k < this->fields_.size(); ++k)
  {
    this->fields_[k]->setToolTip(tr(names[k]));
    this->fields_[k]->setAccessibleName(tr(names[k]));
  }
  this->show_values(nullptr, {}, false);
  this->show_layer({});
  this->show_count(QString(), 0);
}

void HandleFields::show_values(const Handle* handle, const HandleValues& values, bool free)
{
  const double numbers[10] = { values.translate.x(), values.translate.y(), values.translate.z(),
    values.degrees.x(), values.degrees.y(), values.degrees.z(), values.scale, values.stretch,
    values.twist[0], values.twist[1] };
  const bool bone = handle && handle->kind == HandleKind::bone;
  for (std::size_t k = 0; k < this->fields_.size(); ++k)
  {
    const QSignalBlocker blocker(this->fields_[k]);
    if (!this->fields_[k]->hasFocus() || this->fields_[k]->value() != numbers[k])
    {
      this->fields_[k]->setValue(numbers[k]);
    }
    this->fields_[k]->setEnabled(handle && !free);
  }
  for (QLabel* name : this->names_)
  {
    name->setEnabled(handle && !free);
  }
  this->bone_rows_->setVisible(bone);
  this->shear_note_->setVisible(handle && values.is_approximate);
}

void HandleFields::show_count(const QString& name, int count)
{
  const QString text_format = tr("%1 selected; values of %2:").arg(count);
  const int available_width =
    this->width() - this->fontMetrics().horizontalAdvance(text_format.arg(QString()));
  this->count_->setText(text_format.arg(
    this->fontMetrics().elidedText(name, Qt::ElideMiddle, std::max(available_width, 60))));
  this->count_->setToolTip(name);
  this->count_->setVisible(count > 1);
}

void HandleFields::show_layer(const std::optional<double>& layer)
{
  const QSignalBlocker blocker(this->layer_);
  this->layer_->setValue(layer.value_or(0.0));
  this->layer_row_->setVisible(layer.has_value());
}

HandleValues HandleFields::values() const
{
  const auto number = [this](int k) { return this->fields_[static_cast<std::size_t>(k)]->value(); };
  HandleValues values;
  values.translate = Vec3(number(0), number(1), number(2));
  values.degrees = Vec3(number(3), number(4), number(5));
  values.scale = number(6);
  values.stretch = number(7);
  values.twist = Eigen::Vector2d(number(8), number(9));
  return values;
}

} // namespace app::posing
