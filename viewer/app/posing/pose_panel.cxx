#include "app/posing/pose_panel.h"

#include "app/parts/option_widgets.h"
#include "app/parts/panel_parts.h"
#include "app/parts/value_row.h"
#include "app/view/section.h"

#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace app::posing
{

using bindpose::PoseMethod;
using bindpose::PoseOptions;

namespace
{
const struct
{
  PoseMethod method;
  const char* button;
  const char* purpose;
} methods[] = {
  { PoseMethod::linear_blend, QT_TRANSLATE_NOOP("PosePanel", "Linear"),
    QT_TRANSLATE_NOOP(
      "PosePanel", "Blends the transforms of the handles. Fastest; strong twists become thin.") },
  { PoseMethod::dual_quaternion, QT_TRANSLATE_NOOP("PosePanel", "Dual q."),
    QT_TRANSLATE_NOOP(
      "PosePanel", "Blends rigid transforms. Twists keep their thickness; bends bulge.") },
  { PoseMethod::stretchable_bones, QT_TRANSLATE_NOOP("PosePanel", "Stretch"),
    QT_TRANSLATE_NOOP(
      "PosePanel", "Bones stretch and twist along their length, without bulges at their ends.") },
  { PoseMethod::rotation_centers, QT_TRANSLATE_NOOP("PosePanel", "Centers"),
    QT_TRANSLATE_NOOP("PosePanel",
      "Rotates every vertex about its own center: twists stay thick, bends do not bulge.") },
  { PoseMethod::reduced_arap, QT_TRANSLATE_NOOP("PosePanel", "ARAP"),
    QT_TRANSLATE_NOOP("PosePanel", "As rigid as the weights allow; solves in microseconds.") },
  { PoseMethod::full_arap, QT_TRANSLATE_NOOP("PosePanel", "Full ARAP"),
    QT_TRANSLATE_NOOP("PosePanel",
      "As rigid as possible, with every vertex free to move. Needs no weights; slower.") },
  { PoseMethod::variational, QT_TRANSLATE_NOOP("PosePanel", "Variational"),
    QT_TRANSLATE_NOOP(
      "PosePanel", "The smoothest surface through the constrained vertices. Needs no weights.") },
};

/// The methods that fit rotations (as-rigid-as-possible).
const std::vector<PoseMethod> arap_methods = { PoseMethod::reduced_arap, PoseMethod::full_arap };

QString translated(const char* text)
{
  return QCoreApplication::translate("PosePanel", text);
}

QComboBox* box(const char* key, QWidget* parent)
{
  QComboBox* result = parts::option_box(key, parent);
  result->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  return result;
}
} // namespace

std::vector<PoseMethod> pose_methods_in_order()
{
  std::vector<PoseMethod> order;
  for (const auto& entry : methods)
  {
    order.push_back(entry.method);
  }
  return order;
}

QString method_name(PoseMethod method)
{
  return parts::option_labels("pose.method")[static_cast<int>(method)];
}

QString method_purpose(PoseMethod method)
{
  return translated(std::find_if(std::begin(methods), std::end(methods),
    [&](const auto& entry) {
      return entry.method == method;
    })->purpose);
}

PosePanel::PosePanel(QWidget* parent) : QWidget(parent)
{
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  this->add_methods(column);
  this->add_options(column);
  this->inserted_layout_ = new QVBoxLayout;
  column->addLayout(this->inserted_layout_);
  this->add_comparison(column);
  this->add_motion(column);
  this->show_options();
  this->set_state({});
}

void PosePanel::add_methods(QVBoxLayout* column)
{
  column->addWidget(parts::heading(tr("Pose"), this));
  this->methods_ = new QButtonGroup(this);
  this->methods_->setObjectName("pose.method");
  QHBoxLayout* row = nullptr;
  for (std::size_t k = 0; k < std::size(methods); ++k)
  {
    const bool first = k == 0 || k == 4;
    const bool last = k == 3 || k + 1 == std::size(methods);
    if (first)
    {
      row = new QHBoxLayout;
      row->setSpacing(0);
      column->addLayout(row);
    }
    QPushButton* segment = parts::button(translated(methods[k].button), this);
    segment->setObjectName("segment");
    segment->setProperty("place", first ? "first" : last ? "last" : k == 1 ? "second" : "middle");
    segment->setCheckable(true);
    const auto number = static_cast<int>(methods[k].method);
    segment->setToolTip(QString("%1 (%2)\n%3")
                          .arg(method_name(methods[k].method))
                          .arg(k + 1)
                          .arg(method_purpose(methods[k].method)));
    this->methods_->addButton(segment, number);
    row->addWidget(segment, 1);
  }
  this->methods_->button(0)->setChecked(true);
  this->note_ = new QLabel(this);
  this->note_->setObjectName("note");
  this->note_->setWordWrap(true);
  this->note_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  this->note_->setMinimumHeight(2 * this->note_->fontMetrics().lineSpacing() + 2);
  column->addWidget(this->note_);
  QObject::connect(this->methods_, &QButtonGroup::idClicked, this,
    [this](int method)
    {
      this->show_options();
      Q_EMIT this->method_chosen(method);
    });

  this->bind_row_ = new QWidget(this);
  auto* bind = new QHBoxLayout(this->bind_row_);
  bind->setContentsMargins(0, 0, 0, 0);
  this->bar_ = new QProgressBar(this->bind_row_);
  this->bar_->setRange(0, 1000);
  this->bar_->setTextVisible(false);
  this->cancel_ = parts::button(tr("Stop"), this->bind_row_);
  this->cancel_->setToolTip(
    tr("Cancel the preparation of this method; choose the method again to prepare it"));
  bind->addWidget(this->bar_, 1);
  bind->addWidget(this->cancel_);
  column->addWidget(this->bind_row_);
  this->bind_row_->hide();
  QObject::connect(this->cancel_, &QPushButton::clicked, this, &PosePanel::cancel_requested);
}

/// Add a row with the name and the widget of an option. The row is shown only while one of the
/// methods `visible_methods` is chosen; if the list is empty, the row is always shown.
QWidget* PosePanel::option(QVBoxLayout* column, const QString& name, QWidget* widget,
  const QString& tip, std::vector<PoseMethod> visible_methods)
{
  QWidget* row = widget;
  widget->setToolTip(tip);
  if (!name.isEmpty())
  {
    row = new QWidget(this);
    auto* line = new QHBoxLayout(row);
    line->setContentsMargins(0, 0, 0, 0);
    line->setSpacing(8);
    auto* label = new QLabel(name, row);
    label->setToolTip(tip);
    line->addWidget(label);
    line->addWidget(widget, 1);
  }
  column->addWidget(row);
  if (!visible_methods.empty())
  {
    this->options_.push_back({ row, std::move(visible_methods) });
  }
  const auto changed = [this]
  {
    this->show_options();
    Q_EMIT this->options_changed();
  };
  if (auto* box = qobject_cast<QComboBox*>(widget))
  {
    QObject::connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, changed);
  }
  else if (auto* check = qobject_cast<QCheckBox*>(widget))
  {
    QObject::connect(check, &QCheckBox::toggled, this, changed);
  }
  else if (auto* value = qobject_cast<parts::ValueRow*>(widget))
  {
    QObject::connect(value, &parts::ValueRow::value_chosen, this, changed);
  }
  return row;
}

void PosePanel::add_options(QVBoxLayout* column)
{
  const std::vector<PoseMethod> skinning = { PoseMethod::linear_blend, PoseMethod::dual_quaternion,
    PoseMethod::stretchable_bones, PoseMethod::rotation_centers };
  const std::vector<PoseMethod> reduced = { PoseMethod::reduced_arap };
  const std::vector<PoseMethod> smooth = { PoseMethod::variational };
  const auto row = [this](const char* key)
  {
    parts::ValueRow* result = parts::option_row(key, this);
    result->slider()->setMinimumWidth(50); // narrow, because the row also contains a name
    return result;
  };
  const auto check = [this](const char* key, const QString& text)
  {
    auto* box = new QCheckBox(text, this);
    box->setObjectName(key);
    return box;
  };

  this->endpoints_ = box("pose.endpoints", this);
  this->option(column, tr("Along bones"), this->endpoints_,
    tr("How to compute the position of a vertex along a bone, from head to tail.\n"
       "Projection: project the vertex onto the bone, without a solve.\n"
       "Joints, Bounded: solve for smooth weights on the shape.\n"
       "The array EndpointWeights of the mesh, if there is one, is used instead."),
    { PoseMethod::stretchable_bones });
  this->pseudo_edges_ = box("pose.pseudo_edges", this);
  this->option(column, tr("Pseudo-edges"), this->pseudo_edges_,
    tr("Edges between point handles. A handle that is only translated rotates with its edges.\n"
       "Given: the edges of the handle file. Automatic: edges along the shape."),
    skinning);
  this->single_ = check("pose.single_precision", tr("Single precision"));
  this->option(column, QString(), this->single_,
    tr("Half the memory, up to twice as fast; accurate to about 1e-6 bounding-box diagonals"),
    skinning);

  this->in_tets_ = check("pose.in_tets", tr("Keep the volume"));
  this->option(column, QString(), this->in_tets_,
    tr("Use the energy of the tets on which the weights were solved, instead of the energy of the "
       "surface"),
    arap_methods);
  this->energy_ = box("pose.energy", this);
  this->option(column, tr("Rigid parts"), this->energy_,
    tr("Parts that keep their shape: the elements around each vertex (spokes and rims), only the\n"
       "edges that end at each vertex (spokes), or each triangle or tet (elements)"),
    arap_methods);
  this->extra_ = row("pose.extra_weights");
  this->extra_->field()->setDecimals(0);
  this->option(column, tr("Extra weights"), this->extra_,
    tr("Number of extra weights, which let the shape bend where there is no handle; 15 is a good "
       "value"),
    reduced);
  this->extra_kind_ = box("pose.extra_kind", this);
  this->extra_kind_row_ = this->option(column, tr("Extra type"), this->extra_kind_,
    tr("Bumps: local functions around vertices that are far from each other.\n"
       "Eigenmodes: the smoothest functions that are zero at the handles."),
    reduced);
  this->iterations_ = row("pose.iterations");
  this->iterations_->field()->setDecimals(0);
  this->option(column, tr("Iterations"), this->iterations_,
    tr("Maximum number of iterations per frame; the solver stops when it has converged"), reduced);
  this->budget_ = row("pose.budget_us");
  this->budget_->field()->setDecimals(0);
  this->budget_->field()->setSpecialValueText(tr("no limit"));
  this->option(column, tr("Budget, µs"), this->budget_,
    tr("Time limit of the solve per frame, in microseconds; 0: no limit"), reduced);

  this->rotations_ = box("pose.rotations", this);
  this->option(column, tr("Rotations"), this->rotations_,
    tr("Color the shape by rotation angle or by rotation cluster. The vertices of a cluster have\n"
       "similar weights and share one rotation; in full ARAP, each vertex is a cluster."),
    arap_methods);

  this->order_ = box("pose.order", this);
  this->option(column, tr("Model"), this->order_,
    tr("Membrane: only positions are continuous at constrained vertices.\n"
       "Thin plate: tangents are continuous, too. Third order: also curvatures."),
    smooth);
  this->boundary_ = box("pose.boundary", this);
  this->option(column, tr("Boundary"), this->boundary_,
    tr("Region: the surface continues smoothly into the constrained region.\n"
       "Curve: only positions are constrained. Tangent: positions and slopes are constrained."),
    smooth);
}

void PosePanel::add_comparison(QVBoxLayout* column)
{
  auto* section =
    new view::Section(tr("Compare"), tr("Compare with the shape of a second method"), false, this);
  column->addSpacing(4);
  column->addWidget(section);
  this->compared_ = box("pose.compared", this);
  this->compared_->setToolTip(
    tr("Second method for the same pose, to show where both shapes differ"));
  auto* line = new QHBoxLayout;
  line->addWidget(new QLabel(tr("With"), this));
  line->addWidget(this->compared_, 1);
  section->column()->addLayout(line);
  this->display_row_ = new QWidget(this);
  auto* display_layout = new QVBoxLayout(this->display_row_);
  display_layout->setContentsMargins(0, 0, 0, 0);
  // The default style is Distance, because it shows the size of the differences.
  this->ghost_group_ = parts::option_segments(display_layout, this->display_row_, "pose.ghost",
    { tr("Draw the second shape in see-through blue where both shapes differ"),
      tr("Draw each shape in one half of the picture, from the same view"),
      tr("Color the shape by its distance from the second shape,\n"
         "in percent of the bounding-box diagonal of the rest shape") });
  this->difference_ = new QLabel(this->display_row_);
  this->difference_->setObjectName("note");
  this->difference_->setWordWrap(true);
  this->difference_->setMinimumHeight(2 * this->difference_->fontMetrics().lineSpacing() + 2);
  this->difference_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  display_layout->addWidget(this->difference_);
  section->column()->addWidget(this->display_row_);
  this->display_row_->hide();
  QObject::connect(this->compared_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this](int index)
    {
      this->display_row_->setVisible(index > 0);
      Q_EMIT this->comparison_changed();
    });
  QObject::connect(this->ghost_group_, &QButtonGroup::idClicked, this,
    [this] { Q_EMIT this->comparison_changed(); });
}

void PosePanel::add_motion(QVBoxLayout* column)
{
  auto* section = new view::Section(tr("Motion"),
    tr("Simulate the shape as a body with mass: its free parts swing and fall"), false, this);
  column->addWidget(section);
  this->simulate_box_ = new QCheckBox(tr("Simulate motion"), this);
  this->simulate_box_->setObjectName("pose.moves");
  this->simulate_box_->setToolTip(
    tr("Handles drive the motion; the rest of the shape moves by inertia and gravity.\n"
       "A free handle can be pulled and released."));
  section->column()->addWidget(this->simulate_box_);
  this->motion_ = new QWidget(this);
  auto* rows = new QVBoxLayout(this->motion_);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(6);
  auto* buttons = new QHBoxLayout;
  this->play_ = parts::button(tr("Play"), this->motion_);
  this->step_ = parts::button(tr("Step"), this->motion_);
  this->restart_ = parts::button(tr("Restart"), this->motion_);
  this->play_->setToolTip(tr("Run or pause the simulation"));
  this->step_->setToolTip(tr("Advance the simulation by 1/60 s"));
  this->restart_->setToolTip(
    tr("Restart at time 0, without motion, in the current pose of the handles"));
  for (QPushButton* each : { this->play_, this->step_, this->restart_ })
  {
    buttons->addWidget(each, 1);
    // Fix the minimum height. If a note with line breaks needs more height than is available, the
    // layout would otherwise reduce the height of the buttons.
    each->ensurePolished();
    each->setMinimumHeight(each->sizeHint().height());
  }
  rows->addLayout(buttons);
  this->time_ = new QLabel(this->motion_);
  this->time_->setObjectName("note");
  rows->addWidget(this->time_);
  const auto row = [&](const char* key, const QString& name, const QString& tip)
  {
    parts::ValueRow* value = parts::option_row(key, this->motion_);
    value->slider()->setMinimumWidth(50);
    value->setToolTip(tip);
    auto* line = new QHBoxLayout;
    line->setSpacing(8);
    auto* label = new QLabel(name, this->motion_);
    label->setToolTip(tip);
    line->addWidget(label);
    line->addWidget(value, 1);
    rows->addLayout(line);
    QObject::connect(value, &parts::ValueRow::value_chosen, this, &PosePanel::body_changed);
    return value;
  };
  this->gravity_ = row("motion.gravity", tr("Gravity"),
    tr("Gravitational acceleration in bounding-box diagonals of the shape per s²"));
  this->down_ = box("motion.down", this->motion_);
  this->down_->setToolTip(tr("World direction in which gravity acts"));
  auto* line = new QHBoxLayout;
  line->setSpacing(8);
  line->addWidget(new QLabel(tr("Direction"), this->motion_));
  line->addWidget(this->down_, 1);
  rows->addLayout(line);
  this->stiffness_ = row("motion.stiffness", tr("Stiffness"),
    tr("Base-10 logarithm of the stiffness; at 2, waves cross the shape ten times per second"));
  this->damping_ = row("motion.damping", tr("Damping"), tr("Damping rate of the velocity in 1/s"));
  section->column()->addWidget(this->motion_);
  this->motion_->hide();
  QObject::connect(this->down_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this] { Q_EMIT this->body_changed(); });
  QObject::connect(this->simulate_box_, &QCheckBox::toggled, this,
    [this](bool simulates_motion)
    {
      this->motion_->setVisible(simulates_motion);
      Q_EMIT this->simulation_changed();
    });
  QObject::connect(this->play_, &QPushButton::clicked, this,
    [this] { Q_EMIT this->play_requested(this->play_->text() == tr("Play")); });
  QObject::connect(this->step_, &QPushButton::clicked, this, &PosePanel::step_requested);
  QObject::connect(this->restart_, &QPushButton::clicked, this, &PosePanel::restart_requested);
}

void PosePanel::insert(QWidget* widget)
{
  this->inserted_layout_->addWidget(widget);
}

PoseMethod PosePanel::method() const
{
  return static_cast<PoseMethod>(this->methods_->checkedId());
}

void PosePanel::show_options()
{
  this->note_->setText(method_purpose(this->method()));
  parts::enable_all_but(this->compared_, 1 + static_cast<int>(this->method()),
    tr("The shape already uses this method"));
  for (const Option& option : this->options_)
  {
    option.row->setVisible(std::find(option.methods.begin(), option.methods.end(),
                             this->method()) != option.methods.end());
    option.row->setEnabled(this->state_.ready);
  }
  this->extra_kind_row_->setVisible(
    this->method() == PoseMethod::reduced_arap && this->extra_->value() >= 1.0);
  this->endpoints_->setEnabled(this->state_.bones && !this->state_.endpoints);
  this->in_tets_->setEnabled(
    this->state_.ready && (this->state_.tets || this->in_tets_->isChecked()));
}

PoseOptions PosePanel::options() const
{
  PoseOptions options;
  options.method = this->method();
  options.single_precision = this->single_->isChecked();
  options.pseudo_edges =
    static_cast<bindpose::PseudoEdgeChoice>(this->pseudo_edges_->currentIndex());
  options.endpoints = static_cast<bindpose::EndpointMethod>(this->endpoints_->currentIndex());
  options.energy = static_cast<bindpose::ArapEnergy>(this->energy_->currentIndex());
  options.use_tet_energy = this->in_tets_->isChecked() && this->state_.tets;
  options.extra_weights = std::lround(this->extra_->value());
  options.extra_kind = static_cast<bindpose::ExtraWeights>(this->extra_kind_->currentIndex());
  options.iterations = std::lround(this->iterations_->value());
  options.budget_microseconds = std::round(this->budget_->value());
  options.order = this->order_->currentIndex() + 1;
  options.boundary = static_cast<bindpose::PatchBoundary>(this->boundary_->currentIndex());
  return options;
}

void PosePanel::set_method(int method)
{
  this->methods_->button(method)->setChecked(true);
  this->show_options();
}

int PosePanel::compared_method() const
{
  return this->compared_->currentIndex() - 1;
}

bool PosePanel::compares_same_method() const
{
  return this->compared_method() == static_cast<int>(this->method());
}

PoseGhost::DisplayMode PosePanel::ghost_display_mode() const
{
  constexpr PoseGhost::DisplayMode display_modes[] = { PoseGhost::over, PoseGhost::beside,
    PoseGhost::in_colors };
  return this->compared_method() < 0 || this->compares_same_method()
    ? PoseGhost::hidden
    : display_modes[this->ghost_group_->checkedId()];
}

bool PosePanel::simulates_motion() const
{
  return this->simulate_box_->isChecked() && this->state_.bound;
}

PosePanel::RotationDisplay PosePanel::shown_rotations() const
{
  return std::count(arap_methods.begin(), arap_methods.end(), this->method()) > 0
    ? static_cast<RotationDisplay>(this->rotations_->currentIndex())
    : no_rotations;
}

bindpose::BodyOptions PosePanel::body_options() const
{
  bindpose::BodyOptions options;
  options.gravity = this->gravity_->value();
  options.down_axis = this->down_->currentIndex();
  options.stiffness = std::pow(10.0, this->stiffness_->value());
  options.damping = this->damping_->value();
  return options;
}

void PosePanel::set_state(const State& state)
{
  this->state_ = state;
  for (QAbstractButton* each : this->methods_->buttons())
  {
    if (!state.ready)
    {
      each->clearFocus();
    }
    each->setEnabled(state.ready);
  }
  this->simulate_box_->setEnabled(state.bound);
  this->simulate_box_->setToolTip(state.bound
      ? tr("Handles drive the motion; the rest of the shape moves by inertia and gravity.\n"
           "A free handle can be pulled and released.")
      : tr("Bind first: the simulation requires weights"));
  this->in_tets_->setToolTip(state.tets
      ? tr("Use the energy of the tets on which the weights were solved, instead of the energy of "
           "the surface")
      : tr("There are no tets with weights: bind with a volume domain first"));
  this->show_options();
}

void PosePanel::set_binding(bool binding)
{
  this->bar_->setValue(0);
  this->bind_row_->setVisible(binding);
}

void PosePanel::set_progress(double fraction, const QString& phase)
{
  this->bar_->setValue(static_cast<int>(1000.0 * fraction));
  this->bar_->setToolTip(phase);
}

void PosePanel::set_difference(const QString& text)
{
  this->difference_->setText(text);
}

void PosePanel::set_playing(bool playing)
{
  this->play_->setText(playing ? tr("Pause") : tr("Play"));
  this->step_->setEnabled(!playing);
}

void PosePanel::set_time(const QString& text)
{
  this->time_->setText(text);
}

} // namespace app::posing
