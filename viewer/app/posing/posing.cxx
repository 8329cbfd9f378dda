#include "app/posing/posing.h"

#include "app/parts/panel_parts.h"
#include "app/posing/body_motion.h"
#include "app/posing/handle_fields.h"
#include "app/posing/pose_ghost.h"
#include "app/posing/stored_pose_manager.h"
#include "app/posing/pose_panel.h"
#include "app/posing/sequence_export.h"
#include "app/view/viewport.h"

#include "conversion.h"
#include "handle_edit_cells.h"
#include "poses/pose_blend.h"
#include "poses/pose_source_data.h"
#include "weight_uses/depth_order.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

namespace app::posing
{

using namespace bindpose;

namespace
{
QString format_duration(double seconds)
{
  const double us = 1e6 * seconds;
  return us < 1000.0 ? PoseController::tr("%1 µs").arg(us, 0, 'f', us < 10.0 ? 1 : 0)
                     : PoseController::tr("%1 ms").arg(1e-3 * us, 0, 'f', us < 10000.0 ? 2 : 0);
}
} // namespace

PoseController::PoseController(view::Viewport* viewport, const Panels& panels)
  : QObject(viewport), viewport_(viewport), panels_(panels), deformation_(new Deformation(this)),
    compared_deformation_(new Deformation(this)), ghost_(new PoseGhost(viewport)),
    pose_manager_(new StoredPoseManager(
      panels.poses, panels.strip, [this] { return this->pose(); }, this)),
    motion_(new BodyMotion(
      panels.pose,
      [this](bool for_step) { return for_step ? this->constraint_pose() : this->pose(); }, this)),
    export_(new SequenceExport(viewport))
{
  this->connect_panel();
  this->connect_pose_manager();
  QObject::connect(this->deformation_, &Deformation::points_computed, this,
    [this]
    {
      this->show_difference();
      this->follow_free_handles();
      Q_EMIT this->moved();
    });
  QObject::connect(this->compared_deformation_, &Deformation::points_computed, this,
    [this]
    {
      this->show_difference();
      Q_EMIT this->moved();
    });
  for (Deformation* each : { this->deformation_, this->compared_deformation_ })
  {
    QObject::connect(each, &Deformation::failed, this,
      [this, each] { Q_EMIT this->failed(tr("Cannot pose: %1.").arg(each->error())); });
    QObject::connect(each, &Deformation::binding_changed, this,
      [this]
      {
        this->panels_.pose->set_binding(
          this->deformation_->is_binding() || this->compared_deformation_->is_binding());
        Q_EMIT this->moved();
      });
    QObject::connect(
      each, &Deformation::bind_progress, this->panels_.pose, &PosePanel::set_progress);
  }
  QObject::connect(this->motion_, &BodyMotion::moved, this,
    [this]
    {
      this->follow_free_handles();
      this->show_difference();
      Q_EMIT this->moved();
    });
  QObject::connect(this->motion_, &BodyMotion::playback_started, this,
    [this] { this->pose_manager_->play(false); });
  QObject::connect(this->motion_, &BodyMotion::failed, this, &PoseController::failed);
  this->show_state();
}

PoseController::~PoseController() = default;

// ---- Data --------------------------------------------------------------------------------------

void PoseController::set_data(
  vtkPolyData* surface, vtkUnstructuredGrid* tets, vtkPolyData* handles, bool use_weights)
{
  this->pose_manager_->play(false);
  if (surface != this->surface_)
  {
    this->shape_ = nullptr;
    this->ghost_->set_surface(surface);
  }
  this->surface_ = surface;
  this->handles_ = handles;
  this->source_.reset();
  this->cells_.clear();
  if (surface && handles)
  {
    vtkSmartPointer<vtkPolyData> input_surface = surface;
    if (!use_weights)
    {
      input_surface = vtkSmartPointer<vtkPolyData>::New();
      input_surface->ShallowCopy(surface);
      input_surface->GetPointData()->RemoveArray("Weights");
      input_surface->GetPointData()->RemoveArray("EndpointWeights");
    }
    auto source = std::make_shared<PoseSource>();
    const Status status =
      to_pose_source(input_surface, use_weights ? tets : nullptr, handles, *source);
    Handles list;
    if (status.ok() && to_handles(handles, list, &this->cells_).ok())
    {
      this->source_ = std::move(source);
    }
    else if (!status.ok())
    {
      Q_EMIT this->failed(tr("Cannot pose: %1.").arg(QString::fromStdString(status.message)));
    }
  }
  this->order_layers();
  this->deformation_->set_source(this->source_);
  this->compared_deformation_->set_source(this->source_);
  this->motion_->set_source(this->source_);
  this->deformation_->set_options(this->panels_.pose->options());
  this->show_state();
  this->update_automatic_modes();
  this->show_comparison();
  this->simulation_changed();
  this->show_values();
}

bool PoseController::has_weights() const
{
  return this->source_ && this->source_->has_weights();
}

void PoseController::show_state()
{
  PosePanel::State state;
  state.ready = this->source_ != nullptr;
  state.bound = this->has_weights();
  if (state.ready)
  {
    state.tets = this->source_->has_tets();
    state.endpoints = this->source_->endpoints.rows() > 0;
    state.bones = has_bones(this->source_->handles);
  }
  this->panels_.pose->set_state(state);
  this->pose_manager_->set_handles(this->source_
      ? std::shared_ptr<const Handles>(this->source_, &this->source_->handles)
      : nullptr);
}

Pose PoseController::pose() const
{
  Pose pose;
  if (this->source_)
  {
    to_pose(this->handles_, this->source_->handles, this->cells_, pose);
  }
  return pose;
}

// ---- The method --------------------------------------------------------------------------------

void PoseController::connect_panel()
{
  PosePanel* panel = this->panels_.pose;
  QObject::connect(panel, &PosePanel::method_chosen, this, &PoseController::options_changed);
  QObject::connect(panel, &PosePanel::options_changed, this, &PoseController::options_changed);
  QObject::connect(
    panel, &PosePanel::comparison_changed, this, &PoseController::comparison_changed);
  QObject::connect(
    panel, &PosePanel::simulation_changed, this, &PoseController::simulation_changed);
  QObject::connect(panel, &PosePanel::cancel_requested, this,
    [this]
    {
      this->deformation_->cancel();
      this->compared_deformation_->cancel();
      this->motion_->cancel_bind();
    });
  QObject::connect(
    this->panels_.fields, &HandleFields::values_chosen, this, &PoseController::values_typed);
  QObject::connect(
    this->panels_.fields, &HandleFields::edit_ended, this, &PoseController::edit_ended);
  QObject::connect(
    this->panels_.fields, &HandleFields::layer_chosen, this, &PoseController::layer_typed);
}

void PoseController::connect_pose_manager()
{
  QObject::connect(this->pose_manager_, &StoredPoseManager::pose_requested, this,
    [this](const Pose& pose, const QString& step) { this->change_pose(pose, step); });
  QObject::connect(this->pose_manager_, &StoredPoseManager::pose_step_requested, this,
    [this](const QString& step) { Q_EMIT this->pose_step_requested(step); });
  QObject::connect(this->pose_manager_, &StoredPoseManager::stored_poses_changed, this,
    &PoseController::stored_poses_changed);
  QObject::connect(this->pose_manager_, &StoredPoseManager::failed, this, &PoseController::failed);
  QObject::connect(
    this->export_, &SequenceExport::rendering_finished, this, &PoseController::moved);
}

void PoseController::options_changed()
{
  this->deformation_->set_options(this->panels_.pose->options());
  this->deformation_->bind(); // bind() restarts a bind that the user has canceled
  this->show_comparison();
  this->motion_->options_changed();
  this->update_automatic_modes();
  this->handles_moved();
  Q_EMIT this->moved();
}

/// Update the colors of handles in mode automatic. If the method computes rotations, some of these
/// handles, such as translated points, have the color of mode position.
void PoseController::update_automatic_modes()
{
  const bool method_finds_rotations = finds_rotations(this->panels_.pose->options().method);
  this->viewport_->handle_widget()->GetHandleSetRepresentation()->SetFindsRotations(
    method_finds_rotations);
}

/// Return the panel's options with the current method replaced by the compared method.
PoseOptions PoseController::compared_options() const
{
  PoseOptions options = this->panels_.pose->options();
  options.method = static_cast<PoseMethod>(std::max(0, this->panels_.pose->compared_method()));
  return options;
}

void PoseController::comparison_changed()
{
  this->show_comparison();
  if (this->source_ && this->panels_.pose->ghost_display_mode() != PoseGhost::hidden &&
    !this->compared_deformation_->can_pose())
  {
    Q_EMIT this->failed(tr("%1 requires weights: bind first.")
                          .arg(method_name(this->compared_deformation_->options().method)));
  }
  Q_EMIT this->moved();
}

/// Show the shape of the compared method in the display mode that the panel requests. If the shape
/// cannot be computed yet, hide it.
void PoseController::show_comparison()
{
  const PoseGhost::DisplayMode requested_mode = this->panels_.pose->ghost_display_mode();
  this->requested_display_mode_ = requested_mode;
  this->compared_deformation_->set_options(this->compared_options());
  const bool can_compare = this->compared_deformation_->can_pose() && !this->inspects_at_rest_;
  if (can_compare && requested_mode != PoseGhost::hidden)
  {
    this->compared_deformation_->bind();
    this->compared_deformation_->set_pose(this->pose());
  }
  const Points& other = this->compared_deformation_->points();
  const Points none(0, 3);
  const bool fits = this->surface_ && other.rows() == this->surface_->GetNumberOfPoints();
  this->ghost_->set_display_mode(
    can_compare ? requested_mode : PoseGhost::hidden, fits ? other : none, this->points());
  this->show_difference();
}

void PoseController::handles_moved()
{
  if (!this->source_)
  {
    return;
  }
  const Pose pose = this->pose();
  this->show_values();
  if (!this->panels_.pose->simulates_motion())
  {
    this->deformation_->set_options(this->panels_.pose->options());
    this->deformation_->set_pose(pose);
    this->follow_free_handles();
    if (!this->deformation_->error().isEmpty())
    {
      Q_EMIT this->failed(tr("Cannot pose: %1.").arg(this->deformation_->error()));
    }
    else if (this->deformation_->can_pose())
    {
      Q_EMIT this->succeeded();
    }
  }
  if (this->panels_.pose->ghost_display_mode() != this->requested_display_mode_)
  {
    this->show_comparison(); // a change of the method can show or hide the ghost
  }
  else if (this->ghost_->display_mode() != PoseGhost::hidden)
  {
    this->compared_deformation_->set_pose(pose);
  }
  this->show_difference();
}

void PoseController::show_difference()
{
  this->viewport_->set_half_names(method_name(this->deformation_->options().method),
    method_name(this->compared_deformation_->options().method));
  if (this->ghost_->display_mode() == PoseGhost::hidden)
  {
    this->panels_.pose->set_difference(this->panels_.pose->compares_same_method()
        ? tr("The shape already uses this method: choose another method to compare with.")
        : tr("Bind first: this method requires weights."));
    return;
  }
  if (this->compared_deformation_->is_binding())
  {
    this->panels_.pose->set_difference(tr("Preparing the other method …"));
    return;
  }
  const Points& a = this->points();
  const Points& b = this->compared_deformation_->points();
  if (a.rows() != b.rows() || a.rows() == 0)
  {
    return;
  }
  const auto squares = (a - b).rowwise().squaredNorm();
  const double diagonal = bounding_box(this->source_->points).diagonal();
  const double largest = std::sqrt(squares.maxCoeff());
  const double mean = std::sqrt(squares.mean());
  constexpr double round_off = 1e-10; // in units of the bounding-box diagonal
  if (largest <= round_off * diagonal)
  {
    this->panels_.pose->set_difference(tr("Both methods give the same shape."));
    return;
  }
  this->panels_.pose->set_difference(
    tr("Largest distance %1 % of the diagonal,\n"
       "rms %2 %%3")
      .arg(100.0 * largest / diagonal, 0, 'g', 3)
      .arg(100.0 * mean / diagonal, 0, 'g', 3)
      .arg(this->compared_deformation_->is_settled() && this->deformation_->is_settled()
          ? QString()
          : tr("; still converging")));
}

/// Move handles in mode free to the positions that the method has computed, so that the user can
/// see and drag them.
void PoseController::follow_free_handles()
{
  const std::vector<Affine>* found = this->panels_.pose->simulates_motion()
    ? (this->motion_->has_started() ? &this->motion_->body()->transforms() : nullptr)
    : this->deformation_->found();
  vtkDataArray* transforms =
    this->handles_ ? this->handles_->GetCellData()->GetArray("Transform") : nullptr;
  vtkDataArray* modes = this->handles_ ? this->handles_->GetCellData()->GetArray("Mode") : nullptr;
  if (!found || !transforms || !modes || found->size() < this->cells_.size())
  {
    return;
  }
  const vtkIdType dragged_cell =
    this->viewport_->handle_widget()->GetHandleSetRepresentation()->GetActiveHandle();
  for (std::size_t k = 0; k < this->cells_.size(); ++k)
  {
    const vtkIdType cell = this->cells_[k];
    if (static_cast<int>(modes->GetComponent(cell, 0)) == static_cast<int>(HandleMode::free) &&
      cell != dragged_cell)
    {
      transforms->SetTuple(cell, (*found)[k].data());
      transforms->Modified();
    }
  }
}

const Points& PoseController::points() const
{
  return this->panels_.pose->simulates_motion() ? this->motion_->points()
                                                : this->deformation_->points();
}

const PoseRotations* PoseController::rotations()
{
  return !this->panels_.pose->simulates_motion() ? this->deformation_->rotations()
    : this->motion_->has_started()               ? this->motion_->body()->rotations()
                                                 : nullptr;
}

// ---- The visible shape -------------------------------------------------------------------------

vtkPolyData* PoseController::shape()
{
  if (!this->surface_)
  {
    return nullptr;
  }
  const bool simulates_motion =
    this->panels_.pose->simulates_motion() && this->motion_->points().rows() > 0;
  const Points& points = simulates_motion ? this->motion_->points() : this->deformation_->points();
  if (this->is_rest_view_ || this->edits_at_rest_ ||
    points.rows() != this->surface_->GetNumberOfPoints() || !(this->can_pose() || simulates_motion))
  {
    return this->surface_;
  }
  if (!this->shape_)
  {
    this->shape_ = vtkSmartPointer<vtkPolyData>::New();
    this->shape_->ShallowCopy(this->surface_);
    this->shape_->GetPointData()->SetNormals(nullptr); // remove the normals of the rest shape
    this->shape_->SetPoints(to_vtk_points(points));
    return this->shape_;
  }
  auto* coordinates = vtkDoubleArray::SafeDownCast(this->shape_->GetPoints()->GetData());
  std::memcpy(coordinates->GetPointer(0), points.data(), sizeof(double) * points.size());
  coordinates->Modified();
  this->shape_->GetPoints()->Modified();
  return this->shape_;
}

void PoseController::draw()
{
  if (!this->surface_)
  {
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  vtkPolyData* displayed_shape = this->displayed_shape();
  this->viewport_->move_surface(displayed_shape);
  this->viewport_->show_curves(displayed_shape == this->surface_ || !this->is_posed());
  this->drawing_microseconds_ =
    std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  if (!this->shows_rest())
  {
    this->ghost_->move(this->compared_deformation_->points(), this->points());
  }
  else if (this->source_)
  {
    this->ghost_->move(this->source_->points, this->source_->points);
  }
}

void PoseController::inspect_at_rest(bool enabled)
{
  if (this->inspects_at_rest_ != enabled)
  {
    this->inspects_at_rest_ = enabled;
    this->show_comparison();
  }
}

bool PoseController::is_posed() const
{
  const Pose pose = this->pose();
  return (this->panels_.pose->simulates_motion() && this->motion_->has_started()) ||
    std::any_of(pose.begin(), pose.end(),
      [](const HandlePose& each)
      {
        return each.transform != identity_affine() || each.stretch != 1.0 || each.twist[0] != 0.0 ||
          each.twist[1] != 0.0;
      });
}

void PoseController::set_rest_view(bool rest)
{
  if (this->is_rest_view_ != rest)
  {
    this->is_rest_view_ = rest;
    Q_EMIT this->moved();
  }
}

void PoseController::edit_at_rest(bool enabled)
{
  this->set_rest_view(false);
  if (this->edits_at_rest_ != enabled)
  {
    this->edits_at_rest_ = enabled;
    this->pose_manager_->play(false);
    this->motion_->play(false);
    Q_EMIT this->moved();
  }
}

QString PoseController::reading() const
{
  if (this->is_rest_view_)
  {
    return tr("The rest shape is shown. T shows the pose again.");
  }
  const bool simulates_motion =
    this->panels_.pose->simulates_motion() && this->motion_->has_started();
  if (this->deformation_->is_binding())
  {
    return tr("Preparing %1; the shape does not change until the method is ready.")
      .arg(method_name(this->deformation_->options().method));
  }
  const Status& status = simulates_motion ? this->motion_->status() : this->deformation_->status();
  const Report& report = status.report;
  QStringList parts;
  parts << (simulates_motion ? tr("Motion") : method_name(this->deformation_->options().method));
  // warnings come first, because a narrow window cuts off the end of the line
  if (!status.warnings.empty())
  {
    parts << QString::fromStdString(status.warnings.front());
  }
  const double solve = report.number("seconds.solve", 0.0);
  const auto iterations = static_cast<int>(report.number("iterations", 0.0));
  if (iterations > 0 && solve > 0.0)
  {
    parts << tr("%1 iterations in %2, %3 each")
               .arg(iterations)
               .arg(format_duration(solve),
                 format_duration(1e-6 * report.number("microseconds_per_iteration", 0.0)));
  }
  else if (solve > 0.0)
  {
    parts << tr("solved in %1").arg(format_duration(solve));
  }
  if (const double skin = report.number("seconds.skin", 0.0); skin > 0.0)
  {
    parts << tr("skin %1").arg(format_duration(skin));
  }
  parts << tr("normals %1").arg(format_duration(1e-6 * this->drawing_microseconds_));
  parts << tr("upload %1").arg(format_duration(1e-6 * this->viewport_->upload_microseconds()));
  if (this->viewport_->frames_per_second() > 0.0)
  {
    parts << tr("%1 fps").arg(this->viewport_->frames_per_second(), 0, 'f', 0);
  }
  if (report.find("energy"))
  {
    parts << tr("energy %1").arg(report.number("energy", 0.0), 0, 'g', 3);
  }
  if (iterations > 0)
  {
    parts << (status.code == StatusCode::not_converged
        ? (simulates_motion || this->deformation_->is_settled() ? tr("NOT converged")
                                                                : tr("still converging"))
        : tr("converged"));
  }
  return parts.join(QStringLiteral("  ·  "));
}

// ---- The selected handle -----------------------------------------------------------------------

void PoseController::select_handles(const std::vector<int>& handles)
{
  this->selected_ = handles.empty() ? -1 : handles.front();
  this->selected_count_ = static_cast<int>(handles.size());
  this->show_values();
}

void PoseController::show_values()
{
  const Pose pose = this->pose();
  if (this->selected_ < 0 || this->selected_ >= static_cast<int>(pose.size()))
  {
    this->panels_.fields->show_values(nullptr, {}, false);
    this->panels_.fields->show_layer({});
    this->panels_.fields->show_count(QString(), 0);
    return;
  }
  const auto k = static_cast<std::size_t>(this->selected_);
  const Handle& handle = this->source_->handles[k];
  this->panels_.fields->show_values(
    &handle, values_of(this->source_->handles, pose, k), pose[k].mode == HandleMode::free);
  this->panels_.fields->show_count(QString::fromStdString(handle.name), this->selected_count_);
  Eigen::VectorXd layers;
  const bool has_layers = this->plane_ &&
    to_layers(this->handles_, this->source_->handles, this->cells_, "Layer", layers).ok();
  this->panels_.fields->show_layer(
    has_layers ? std::optional(layers[this->selected_]) : std::nullopt);
}

void PoseController::values_typed(int field)
{
  const Pose pose = this->pose();
  if (this->selected_ < 0 || this->selected_ >= static_cast<int>(pose.size()))
  {
    return;
  }
  const auto k = static_cast<std::size_t>(this->selected_);
  const Handles& handles = this->source_->handles;
  this->change_pose(with_values(handles, pose, k, this->panels_.fields->values()),
    tr("values of %1").arg(QString::fromStdString(handles[k].name)),
    QStringLiteral("value %1 of %2").arg(field).arg(QString::fromStdString(handles[k].name)));
}

void PoseController::layer_typed(double layer)
{
  if (this->selected_ >= 0 && this->selected_ < static_cast<int>(this->cells_.size()))
  {
    const auto k = static_cast<std::size_t>(this->selected_);
    set_handle_layer(this->handles_, this->cells_[k], layer);
    Q_EMIT this->handles_changed(
      tr("layer of %1").arg(QString::fromStdString(this->source_->handles[k].name)));
  }
}

void PoseController::layers_changed()
{
  this->order_layers();
  this->show_values();
}

void PoseController::order_layers()
{
  Eigen::VectorXd depths;
  if (this->plane_ && this->source_ && this->source_->has_weights())
  {
    ExecutionContext context;
    DepthOrder order;
    Eigen::VectorXd layers;
    Status status =
      to_layers(this->handles_, this->source_->handles, this->cells_, "Layer", layers);
    if (status.ok())
    {
      status = depth_order(context, this->source_->weights, layers, {}, order);
    }
    if (status.usable())
    {
      // Move no layer toward the eye, so that lines on the shape stay in front of all layers. The
      // frontmost layer has the offset 0; the other layers are moved away from the eye.
      const double layer = 1e-3 * bounding_box(this->source_->points).diagonal();
      depths = layer * (order.front.array() - order.front.maxCoeff()).matrix();
    }
    else
    {
      Q_EMIT this->failed(
        tr("Cannot order layers: %1.").arg(QString::fromStdString(status.message)));
    }
  }
  this->viewport_->set_depths(depths, this->plane_.value_or(Vec3::UnitZ()));
}

void PoseController::change_pose(const Pose& pose, const QString& step, const QString& merge)
{
  this->set_rest_view(false);
  Q_EMIT this->pose_changed(pose);
  if (!step.isEmpty())
  {
    Q_EMIT this->pose_step_requested(step, merge);
  }
}

void PoseController::drag_began()
{
  this->pose_manager_->play(false);
}

// ---- The body ----------------------------------------------------------------------------------

/// Return the pose that constrains the body. A handle in mode free is constrained only while it is
/// dragged.
Pose PoseController::constraint_pose() const
{
  Pose pose = this->pose();
  const vtkIdType dragged_cell =
    this->viewport_->handle_widget()->GetHandleSetRepresentation()->GetActiveHandle();
  for (std::size_t k = 0; k < pose.size(); ++k)
  {
    if (pose[k].mode == HandleMode::free)
    {
      if (this->cells_[k] == dragged_cell)
      {
        pose[k].mode = HandleMode::position;
      }
      else
      {
        // the method has computed this transform, so the transform must not constrain the body
        pose[k].transform = identity_affine();
      }
    }
  }
  return pose;
}

void PoseController::simulation_changed()
{
  const bool simulates_motion = this->panels_.pose->simulates_motion();
  this->viewport_->handle_widget()->GetHandleSetRepresentation()->SetDragFree(simulates_motion);
  if (simulates_motion)
  {
    this->motion_->begin();
  }
  else
  {
    this->motion_->end();
    this->handles_moved();
    Q_EMIT this->moved();
  }
}

// ---- Export ------------------------------------------------------------------------------------

bool PoseController::has_motion() const
{
  return this->panels_.pose->simulates_motion() && this->motion_->has_started() &&
    !this->motion_->body()->run().steps.empty();
}

bool PoseController::has_animation() const
{
  return this->source_ && (this->has_motion() || !this->stored_poses().keys.keys().empty());
}

void PoseController::export_to(const QString& path)
{
  if (!this->has_animation())
  {
    return;
  }
  this->pose_manager_->play(false);
  this->motion_->play(false);
  SequenceExport::Input input;
  input.source = this->source_;
  input.surface = this->surface_;
  input.handles = vtkSmartPointer<vtkPolyData>::New();
  input.handles->DeepCopy(this->handles_);
  set_pose(input.handles, this->cells_, Pose(this->cells_.size()));
  input.options = this->panels_.pose->options();
  input.frames_per_second = this->stored_poses().keys.frames_per_second;
  if (this->has_motion())
  {
    input.run = this->motion_->body()->run();
  }
  else
  {
    input.poses = this->stored_poses().keys.frames(this->source_->handles, this->pose());
  }
  this->export_->start(input, path);
}

} // namespace app::posing
