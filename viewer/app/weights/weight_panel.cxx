#include "app/weights/weight_panel.h"

#include "app/parts/option_widgets.h"
#include "app/parts/panel_parts.h"
#include "app/parts/value_row.h"

#include "report_field_data.h"

#include "vtkDataSet.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace app::weights
{

namespace
{
/// Enable a widget if `reason` is empty. Otherwise disable it and show the reason as its tooltip.
void enable_or_explain(QWidget* widget, const QString& reason)
{
  if (widget->property("tip").isNull())
  {
    widget->setProperty("tip", widget->toolTip());
  }
  widget->setEnabled(reason.isEmpty());
  widget->setToolTip(reason.isEmpty() ? widget->property("tip").toString() : reason);
}
} // namespace

int method_of_weights(vtkDataSet* surface)
{
  const bindpose::WeightMethod* method =
    surface ? bindpose::find_weight_method(bindpose::read_report(surface).text("method")) : nullptr;
  return method ? static_cast<int>(method - bindpose::weight_methods().data()) : -1;
}

WeightPanel::WeightPanel(QWidget* parent) : QFrame(parent)
{
  this->setObjectName("panel");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(7);
  const auto note = [this](int lines)
  {
    auto* line = new QLabel(this);
    line->setObjectName("note");
    line->setWordWrap(lines > 1);
    line->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    line->setFixedHeight(lines * line->fontMetrics().lineSpacing() + 2);
    return line;
  };
  const auto box = [this](const QString& text, const QString& tip, bool checked = false)
  {
    auto* result = new QCheckBox(text, this);
    result->setToolTip(tip);
    result->setChecked(checked);
    QObject::connect(result, &QCheckBox::toggled, this,
      [this]
      {
        this->enable();
        Q_EMIT this->display_changed();
      });
    return result;
  };

  column->addWidget(parts::heading(tr("Show"), this));
  this->column_ = new QComboBox(this);
  this->column_->setObjectName("weights.column");
  this->column_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  this->column_->setMinimumContentsLength(8);
  this->column_->setToolTip(
    tr("Show the weights of one handle, or color every triangle by its strongest handle"));
  column->addWidget(this->column_);
  this->quantity_group_ = this->add_choice("weights.what",
    { tr("Show the weights of the handles"),
      tr("Show the sum of the raw weights at each point; where it is 1, normalization changes "
         "nothing"),
      tr("Show the difference from the weights of the method under 'Other method'") });
  this->normalization_group_ = this->add_choice("weights.raw",
    { tr("Weights divided by their sum at each vertex; these weights deform the shape"),
      tr("Weights from the solver, before normalization; gap and residual refer to these "
         "weights") });
  this->certificate_ = note(3);
  this->certificate_->setToolTip(
    tr("Optimality certificate of the column. Gap: its energy exceeds the minimum by at most this "
       "fraction. Residual: violation of the optimality conditions."));
  column->addWidget(this->certificate_);
  auto* lines = new QHBoxLayout;
  this->bands_ =
    box(tr("Bands"), tr("Use one color per interval of 0.1 instead of smooth colors"), true);
  this->isolines_ = box(tr("Isolines"), tr("Draw lines where a weight is 0.1, 0.2, … 0.9"), true);
  this->bands_->setObjectName("weights.bands");
  this->isolines_->setObjectName("weights.isolines");
  lines->addWidget(this->bands_, 1);
  lines->addWidget(this->isolines_, 1);
  column->addLayout(lines);
  this->extrema_ = box(tr("Extrema away from handles"),
    tr("Draw balls at local maxima (red) and minima (blue) of the displayed values away from "
       "handles, if their persistence exceeds a thousandth of the range of the values"));
  this->extrema_->setObjectName("weights.extrema");
  column->addWidget(this->extrema_);
  this->extrema_note_ = note(1);
  column->addWidget(this->extrema_note_);
  this->tint_row_ = new QWidget(this);
  auto* tint = new QVBoxLayout(this->tint_row_);
  tint->setContentsMargins(0, 0, 0, 0);
  tint->setSpacing(4);
  tint->addWidget(new QLabel(tr("Opacity of the colors"), this->tint_row_));
  this->tint_ = parts::option_row("weights.over_picture", this->tint_row_);
  this->tint_->setToolTip(tr("Opacity of the colors: 0 shows only the textures, 1 only the colors; "
                             "isolines remain visible"));
  tint->addWidget(this->tint_);
  column->addWidget(this->tint_row_);

  column->addSpacing(10);
  column->addWidget(parts::heading(tr("Other method"), this));
  this->method_ = parts::option_box("weights.compare_with", this);
  this->method_->setToolTip(tr("Method to compare with; the weights of the shape do not change"));
  QObject::connect(
    this->method_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &WeightPanel::enable);
  column->addWidget(this->method_);
  auto* buttons = new QHBoxLayout;
  this->compare_ = parts::button(tr("Compare"), this);
  this->compare_->setToolTip(
    tr("Solve with the other method in the background and show the difference"));
  this->cancel_ = parts::button(tr("Cancel"), this);
  this->cancel_->setToolTip(tr("Cancel; the displayed values do not change"));
  buttons->addWidget(this->compare_, 1);
  buttons->addWidget(this->cancel_);
  column->addLayout(buttons);
  this->bar_ = new QProgressBar(this);
  this->bar_->setRange(0, 1000);
  this->bar_->setTextVisible(false);
  // Hidden widgets keep their space, so that the widgets below them do not move.
  QSizePolicy size_policy = this->bar_->sizePolicy();
  size_policy.setRetainSizeWhenHidden(true);
  this->bar_->setSizePolicy(size_policy);
  column->addWidget(this->bar_);
  this->comparison_ = note(2);
  column->addWidget(this->comparison_);

  column->addSpacing(10);
  this->inside_ = parts::heading(tr("Inside"), this);
  column->addWidget(this->inside_);
  this->slice_ = box(tr("Slice through the volume"),
    tr("Show the weights on a plane through the rest shape; the mouse can drag the plane"));
  this->slice_->setObjectName("weights.slice");
  column->addWidget(this->slice_);
  this->orientations_ = parts::orientation_segments(column, this, "weights.orientation");
  this->position_ = new parts::ValueRow(this);
  this->position_->setObjectName("weights.place");
  this->position_->set_option_is_fraction();
  this->position_->setToolTip(
    tr("Position of the slice along its normal; the mouse can also drag the slice"));
  column->addWidget(this->position_);
  column->addStretch(1);

  QObject::connect(this->column_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this](int index)
    {
      this->enable();
      Q_EMIT this->display_changed();
      Q_EMIT this->column_chosen(index - 1);
    });
  QObject::connect(this->compare_, &QPushButton::clicked, this,
    [this] { Q_EMIT this->comparison_requested(this->method_->currentIndex()); });
  QObject::connect(this->cancel_, &QPushButton::clicked, this,
    [this]
    {
      this->set_comparison(tr("Stopping …"));
      Q_EMIT this->cancel_requested();
    });
  QObject::connect(
    this->orientations_, &QButtonGroup::idClicked, this, &WeightPanel::orientation_chosen);
  QObject::connect(
    this->position_, &parts::ValueRow::value_chosen, this, &WeightPanel::position_chosen);
  QObject::connect(
    this->tint_, &parts::ValueRow::value_chosen, this, &WeightPanel::tint_opacity_chosen);
  this->set_columns({});
  this->set_state({});
}

QButtonGroup* WeightPanel::add_choice(const char* key, const QStringList& tips)
{
  QButtonGroup* group =
    parts::option_segments(static_cast<QBoxLayout*>(this->layout()), this, key, tips);
  QObject::connect(group, &QButtonGroup::idClicked, this,
    [this]
    {
      this->enable();
      Q_EMIT this->display_changed();
    });
  return group;
}

void WeightPanel::set_columns(const QStringList& names)
{
  const QSignalBlocker blocker(this->column_);
  const QString before = this->column_->currentData(Qt::ToolTipRole).toString();
  this->column_->clear();
  this->column_->addItem(tr("All: strongest handle"));
  for (const QString& name : names)
  {
    this->column_->addItem(
      this->fontMetrics().elidedText(name, Qt::ElideMiddle, this->column_->sizeHint().width()));
    this->column_->setItemData(this->column_->count() - 1, name, Qt::ToolTipRole);
  }
  const int previous_index = names.indexOf(before);
  this->column_->setCurrentIndex(previous_index >= 0 ? previous_index + 1
      : names.isEmpty()                              ? 0
                                                     : 1);
  this->enable();
}

void WeightPanel::set_state(const State& state)
{
  this->state_ = state;
  // If the surface no longer has the displayed data, show the weights.
  if ((this->quantity() == row_sums && !state.has_raw_weights) ||
    (this->quantity() == difference && !state.compared))
  {
    this->quantity_group_->button(weights)->setChecked(true);
  }
  if (this->raw() && !state.has_raw_weights)
  {
    this->normalization_group_->button(0)->setChecked(true);
  }
  this->compare_->setText(state.compared ? tr("Compare again") : tr("Compare"));
  this->tint_row_->setVisible(state.has_texture);
  for (QWidget* inside : { static_cast<QWidget*>(this->inside_),
         static_cast<QWidget*>(this->slice_), static_cast<QWidget*>(this->position_) })
  {
    // Hide the widgets for slices through the inside: a textured planar shape has no inside.
    inside->setVisible(!state.has_picture);
  }
  for (QAbstractButton* orientation : this->orientations_->buttons())
  {
    orientation->setVisible(!state.has_picture);
  }
  this->cancel_->setVisible(state.comparing);
  this->bar_->setVisible(state.comparing);
  if (!state.comparing)
  {
    this->bar_->setValue(0);
  }
  this->enable();
}

/// Enable the widgets that apply to the available and the displayed data. Tooltips of disabled
/// widgets state the reason.
void WeightPanel::enable()
{
  const QString no_weights_reason = this->state_.has_weights
    ? QString()
    : tr("There are no weights: bind, or open a mesh with weights");
  const auto first = [&no_weights_reason](const QString& reason)
  { return no_weights_reason.isEmpty() ? reason : no_weights_reason; };
  const QString no_raw_reason = this->state_.has_raw_weights
    ? QString()
    : tr("There are no raw weights: bind here, or write them with bindpose weights --keep-raw");
  const bool all = this->column() < 0;
  const bool shows_sums = this->quantity() == row_sums;
  const bool shows_difference = this->quantity() == difference;
  enable_or_explain(
    this->column_, first(shows_sums ? tr("Row sums include all handles") : QString()));
  enable_or_explain(this->quantity_group_->button(weights), no_weights_reason);
  enable_or_explain(this->quantity_group_->button(row_sums), first(no_raw_reason));
  enable_or_explain(this->quantity_group_->button(difference),
    first(this->state_.compared
        ? QString()
        : tr("First choose a method under 'Other method' and click Compare")));
  const QString all_handles_reason = all && !shows_sums
    ? tr("The strongest handle is the same for raw and normalized weights")
    : QString();
  enable_or_explain(this->normalization_group_->button(0),
    first(shows_sums ? tr("Row sums are always sums of raw weights") : all_handles_reason));
  enable_or_explain(this->normalization_group_->button(1),
    first(no_raw_reason.isEmpty() ? all_handles_reason : no_raw_reason));
  const QString no_column_reason = shows_sums ? tr("Row sums have their own colors: white is 1")
    : shows_difference                        ? tr("Differences have their own colors: white is 0")
    : all ? tr("Choose one handle: this requires the weights of a single handle")
          : QString();
  enable_or_explain(this->bands_, first(no_column_reason));
  enable_or_explain(this->isolines_, first(no_column_reason));
  enable_or_explain(this->extrema_,
    first(all && !shows_sums
        ? tr("Choose one handle: extrema require the weights of a single handle")
        : QString()));
  this->extrema_note_->setEnabled(this->extrema_->isEnabled());
  const QString no_comparison_reason = this->state_.comparing ? tr("A comparison is running")
    : this->state_.has_handles
    ? QString()
    : tr("Open the handles of these weights: solving with another method requires handles");
  enable_or_explain(this->method_, first(no_comparison_reason));
  const QString same_method_reason =
    tr("The weights already come from this method: choose another method");
  const bool is_same = this->method_->currentIndex() == this->state_.method;
  enable_or_explain(this->compare_,
    first(no_comparison_reason.isEmpty() && is_same ? same_method_reason : no_comparison_reason));
  parts::enable_all_but(this->method_, this->state_.method, same_method_reason);
  const QString no_slice_reason = shows_difference
    ? tr("The other method was solved on different tets: the difference exists only on the surface")
    : this->state_.has_volume
    ? QString()
    : tr("There is no volume: bind here, or open the tets (.vtu) that bindpose weights writes");
  enable_or_explain(this->slice_, first(no_slice_reason));
  const QString no_plane_reason = this->slice_->isEnabled() && this->slice_->isChecked()
    ? QString()
    : tr("There is no slice to move: switch it on above");
  enable_or_explain(this->position_, no_plane_reason);
  for (QAbstractButton* orientation : this->orientations_->buttons())
  {
    enable_or_explain(orientation, no_plane_reason);
  }
}

void WeightPanel::set_certificate(const QString& text)
{
  this->certificate_->setText(text);
}

void WeightPanel::set_extrema(const QString& text)
{
  this->extrema_note_->setText(text);
}

void WeightPanel::set_progress(double fraction, const QString& phase)
{
  this->bar_->setValue(static_cast<int>(1000.0 * fraction));
  if (this->comparison_->text() != tr("Stopping …"))
  {
    this->set_comparison(parts::progress_note(fraction, phase));
  }
}

void WeightPanel::set_comparison(const QString& text)
{
  this->comparison_->setText(text);
}

void WeightPanel::set_position(double position, double lowest, double highest)
{
  this->position_->set_range(lowest, highest);
  this->position_->set_value(position);
}

int WeightPanel::quantity() const
{
  return this->quantity_group_->checkedId();
}

void WeightPanel::show_quantity(int quantity)
{
  this->quantity_group_->button(quantity)->setChecked(true);
  this->enable();
  Q_EMIT this->display_changed();
}

int WeightPanel::column() const
{
  return this->column_->currentIndex() - 1;
}

void WeightPanel::choose_column(int column)
{
  this->column_->setCurrentIndex(column + 1);
}

bool WeightPanel::raw() const
{
  return this->normalization_group_->checkedId() == 1;
}

bool WeightPanel::bands() const
{
  return this->bands_->isChecked();
}

bool WeightPanel::isolines() const
{
  return this->isolines_->isChecked();
}

bool WeightPanel::extrema() const
{
  return this->extrema_->isEnabled() && this->extrema_->isChecked();
}

bool WeightPanel::slice() const
{
  return this->slice_->isEnabled() && this->slice_->isChecked();
}

} // namespace app::weights
