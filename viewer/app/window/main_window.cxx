#include "app/window/main_window.h"

#include "app/handles/edit_tools.h"
#include "app/handles/handle_commands.h"
#include "app/handles/handle_editing.h"
#include "app/handles/handle_selection.h"
#include "app/handles/shape_handles.h"
#include "app/handles/side_panel.h"
#include "app/parts/bar_stack.h"
#include "app/parts/elided_label.h"
#include "app/parts/field_guard.h"
#include "app/parts/notice_bar.h"
#include "app/parts/panel_parts.h"
#include "app/parts/style.h"
#include "app/posing/distance_view.h"
#include "app/posing/key_strip.h"
#include "app/posing/posing.h"
#include "app/posing/rotation_view.h"
#include "app/tets/tet_inspection.h"
#include "app/view/viewport.h"
#include "app/volume/volume_panel.h"
#include "app/volume/volume_view.h"
#include "app/volume/winding_volume.h"
#include "app/weights/binding.h"
#include "app/weights/weight_inspection.h"
#include "app/weights/weight_panel.h"
#include "app/window/empty_state.h"
#include "app/window/exports.h"
#include "app/window/option_links.h"
#include "app/window/panel_column.h"
#include "app/window/plane_options.h"
#include "app/window/probe.h"
#include "app/window/window_menus.h"
#include "app/window/window_sessions.h"
#include "document/document.h"
#include "document/opened_file.h"
#include "document/recent_files.h"

#include "conversion.h"
#include "handle_geometry.h"
#include "scene/camera.h"
#include "scene/volume.h"

#include "vtkAssetReader.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMeshFileReader.h"
#include "vtkRenderer.h"
#include "vtkUnstructuredGrid.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDir>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QMimeData>
#include <QScreen>
#include <QStatusBar>
#include <QUndoStack>
#include <QVBoxLayout>

#include <algorithm>

namespace app::window
{

using namespace bindpose;

namespace
{
/// Return a file's name for a title or a sentence. Long names, which some other programs create,
/// are shortened.
QString short_name(const QString& path)
{
  constexpr int maximum_length = 60;
  return parts::shortened(QFileInfo(path).fileName(), maximum_length);
}
QString method_words(const WeightMethod& method)
{
  return QCoreApplication::translate("Document", method.label).toLower();
}
/// Return a sentence with the method and, if known, the accuracy of the bound weights. The panel of
/// weights shows the accuracy per column.
/// @param chosen  the method of the next bind, which can differ from the method of the weights
QString certificate_note(vtkPolyData* surface, const WeightMethod& chosen)
{
  vtkDataArray* gaps = surface->GetFieldData()->GetArray("WeightsRelativeGap");
  const int bound = weights::method_of_weights(surface);
  const QString name =
    bound < 0 ? MainWindow::tr("from the mesh file") : method_words(weight_methods()[bound]);
  QString note = gaps && gaps->GetNumberOfTuples() > 0
    ? MainWindow::tr("Weights: %1. Optimal to within %2.")
        .arg(name)
        .arg(gaps->GetRange()[1], 0, 'e', 1)
    : MainWindow::tr("Weights: %1.").arg(name);
  if (bound >= 0 && &weight_methods()[bound] != &chosen)
  {
    note += ' ' + MainWindow::tr("Bind again for %1.").arg(method_words(chosen));
  }
  return note;
}
} // namespace

MainWindow::MainWindow(QWidget* parent) : QMainWindow(parent), document_(new Document(this))
{
  this->setAcceptDrops(true);
  new parts::FieldGuard(this, [this] { this->viewport_->setFocus(Qt::OtherFocusReason); });
  // Limit the size, so that the window fits on a small screen together with its title bar, which
  // the desktop adds.
  constexpr int title_bar_height = 40; // pixels
  const QSize available_size = QGuiApplication::primaryScreen()->availableGeometry().size();
  this->resize(QSize(1280, 800).boundedTo(available_size - QSize(0, title_bar_height)));
  this->make_layout();
  this->make_inspections();
  this->links_ = new OptionLinks(this->document_, this->panels_);
  this->links_->link_option(
    "show.outlines", [this] { return this->viewport_->has_outlines(); },
    [this](const QVariant& value) { this->show_outlines(value.toBool()); });
  this->links_->link_option(
    "show.look", [this] { return this->viewport_->shows_look(); },
    [this](const QVariant& value) { this->show_look(value.toBool()); });
  link_plane(this->links_, this->document_, "volume", this->volume_view_->plane());
  link_plane(this->links_, this->document_, "tets", this->tet_inspection_->tet_view()->plane());
  link_plane(this->links_, this->document_, "weights", this->weights_->view()->plane());
  this->sessions_ = new WindowSessions({ this, this->document_, this->viewport_, this->panels_,
    this->binding_, this->links_, this->error_bar_, this->recovery_bar_, this->note_bar_ });
  this->exports_ = new Exports({ this, this->document_, this->viewport_, this->posing_,
    this->sessions_, this->error_bar_, this->export_bar_ });
  this->menus_ = new WindowMenus(
    { this, this->document_, this->viewport_, this->panels_, this->editing_, this->shape_handles_,
      this->binding_, this->posing_, this->strip_, this->sessions_, this->exports_ });
  this->connect_menus();
  this->connect_panel();
  this->connect_volume();
  this->connect_handles();
  this->connect_posing();
  this->connect_errors();
  QObject::connect(this->document_, &Document::about_to_change, this->editing_,
    &handles::HandleEditing::cancel_interaction);
  QObject::connect(this->document_, &Document::changed, this, &MainWindow::document_changed);
  // The history updates its saved state at the end of a step, after Document::changed() was
  // emitted. Therefore update the title again at the end of the step.
  QObject::connect(
    this->document_->history(), &QUndoStack::indexChanged, this, &MainWindow::update_title);
  QObject::connect(this->document_, &Document::option_changed, this, &MainWindow::option_changed);
  this->update_title();
  this->update_panel();
  this->update_pose();
}

MainWindow::~MainWindow()
{
  // Disconnect the document and its history. They are destroyed after the views, and would send
  // signals to destroyed objects.
  this->document_->disconnect(this);
  this->document_->history()->disconnect(this);
}

// ---- Layout and wiring -------------------------------------------------------------------------

void MainWindow::make_layout()
{
  auto* center = new QWidget(this);
  auto* columns = new QHBoxLayout(center);
  columns->setContentsMargins(0, 0, 0, 0);
  columns->setSpacing(0);
  auto* rows = new QVBoxLayout;
  rows->setSpacing(0);

  this->viewport_ = new view::Viewport(center);
  this->bars_ = new parts::BarStack(this->viewport_);
  this->error_bar_ = new parts::ErrorBar(this->bars_);
  this->bars_->add(this->error_bar_);
  const auto add_bar = [this](const QString& name)
  {
    auto* bar = new parts::NoticeBar(this->bars_);
    bar->setObjectName(name);
    this->bars_->add(bar);
    return bar;
  };
  this->recovery_bar_ = add_bar("recovery_bar");
  this->note_bar_ = add_bar("note_bar");
  this->rebind_bar_ = add_bar("rebind_bar");
  this->export_bar_ = add_bar("export_bar");
  auto* overlay_layout = new QVBoxLayout(this->viewport_);
  this->empty_ = new EmptyState(this->viewport_);
  QObject::connect(this->empty_, &EmptyState::open_and_rig_requested, this,
    [this]
    {
      this->choose_and_open();
      this->shape_handles_->auto_rig();
    });
  overlay_layout->addWidget(this->empty_);
  this->panels_ = new PanelColumn(center);
  this->panel_ = this->panels_->side();
  rows->addWidget(this->viewport_, 1);
  this->strip_ = new posing::KeyStrip(center);
  rows->addWidget(this->strip_);
  this->posing_ = new posing::PoseController(this->viewport_,
    { this->panel_->pose(), this->panel_->fields(), this->panel_->poses(), this->strip_ });
  this->shape_handles_ = new handles::ShapeHandles(this->document_, this->note_bar_, this);
  this->editing_ = new handles::HandleEditing(this->document_, this->viewport_, this->posing_,
    this->panel_, this->shape_handles_->auto_rig_action());
  rows->insertWidget(rows->indexOf(this->viewport_), this->editing_->tools());
  this->bars_->begin_below(this->editing_->mode_bar());
  this->binding_ = new weights::Binding(this->document_, this->panel_, this->rebind_bar_, this);
  QObject::connect(this->shape_handles_, &handles::ShapeHandles::rigged, this,
    [this] { this->binding_->start(); });
  // This must be the first connection to panel_shown(), because the painting of regions must end
  // before another panel shows its own colors.
  QObject::connect(this->panels_, &PanelColumn::panel_shown, this,
    [this](int panel)
    {
      if (panel != PanelColumn::bind_and_pose &&
        this->editing_->mode() == handles::HandleEditing::paint_regions)
      {
        this->editing_->set_mode(handles::HandleEditing::pose);
      }
    });
  columns->addLayout(rows, 1);
  columns->addWidget(this->panels_);
  this->setCentralWidget(center);
  this->hint_ = new parts::ElidedLabel(this);
  this->statusBar()->addWidget(this->hint_, 1);
  this->hint_->setContentsMargins(12, 3, 12, 4);
  this->statusBar()->setSizeGripEnabled(false);
}

void MainWindow::make_inspections()
{
  this->volume_view_ = new volume::VolumeView(this->viewport_);
  this->tet_inspection_ = new tets::TetInspection(this->viewport_, this->panels_->tet());
  QObject::connect(this->tet_inspection_, &tets::TetInspection::surface_look_changed, this,
    [this]
    {
      this->update_surface_appearance();
      this->draw_pose(); // draw the shape at rest: tets and defects belong to it
    });
  QObject::connect(this->tet_inspection_, &tets::TetInspection::first_tets_computed, this,
    &MainWindow::orient_planes);
  QObject::connect(
    this->tet_inspection_, &tets::TetInspection::notice_requested, this, &MainWindow::show_notice);
  QObject::connect(
    this->tet_inspection_, &tets::TetInspection::defects_found, this, &MainWindow::offer_defects);
  this->weights_ = new weights::WeightInspection(this->viewport_, this->panels_->weight(),
    [this](weights::BindInput& input)
    { return this->is_bound() && this->binding_->make_input(input); });
  QObject::connect(this->weights_, &weights::WeightInspection::surface_look_changed, this,
    [this]
    {
      this->update_surface_appearance();
      this->update_pose(); // draw the shape at rest: a slice belongs to it
    });
  this->rotations_ =
    new posing::RotationView(this->viewport_, this->panels_->side()->pose(), this->posing_);
  this->distances_ = new posing::DistanceView(this->viewport_, this->posing_);
  this->probe_ = new Probe({ this->viewport_, this->volume_view_, this->tet_inspection_->tet_view(),
    this->weights_->view(), &this->tet_inspection_->defect_view(), this->posing_, this->rotations_,
    [this] { return this->document_->surface() ? this->posing_->displayed_shape() : nullptr; } });
  QObject::connect(this->panels_, &PanelColumn::panel_shown, this->tet_inspection_,
    [this](int panel)
    {
      // The old panel removes its coloring before the new panel applies its own.
      const bool poses = panel == PanelColumn::bind_and_pose;
      if (!poses)
      {
        this->distances_->set_active(false);
        this->rotations_->set_active(false);
      }
      this->tet_inspection_->set_active(panel == PanelColumn::tets);
      this->weights_->set_active(panel == PanelColumn::weights);
      this->volume_view_->set_active(panel == PanelColumn::volume_slice);
      if (poses)
      {
        this->distances_->set_active(true);
        this->rotations_->set_active(true);
      }
      if (panel == PanelColumn::weights)
      {
        this->show_selected_column();
      }
    });
  QObject::connect(this->panels_->weight(), &weights::WeightPanel::column_chosen, this,
    [this](int column)
    {
      const std::vector<int> selected = this->editing_->selection()->selected();
      const bool shown = this->panels_->shown_panel() == PanelColumn::weights;
      const int count = static_cast<int>(this->document_->handles().size());
      if (shown && this->is_bound() && column >= 0 && column < count &&
        std::find(selected.begin(), selected.end(), column) == selected.end())
      {
        this->panel_->select_handle(column);
      }
    });
  this->winding_volume_ = new volume::WindingVolume(this->document_, this->panels_->volume(), this);
}

void MainWindow::connect_menus()
{
  QObject::connect(this->sessions_, &WindowSessions::open_requested, this,
    [this](const QString& path) { this->open(path); });
  QObject::connect(this->sessions_, &WindowSessions::changed, this, &MainWindow::update_title);
  QObject::connect(this->sessions_, &WindowSessions::perspective_requested, this,
    [this] { this->set_flat_view(false); });
  QObject::connect(
    this->exports_, &Exports::timeline_requested, this, [this] { this->show_timeline(true); });
  WindowMenus* menus = this->menus_;
  QObject::connect(menus, &WindowMenus::open_requested, this, &MainWindow::choose_and_open);
  QObject::connect(menus, &WindowMenus::flat_view_requested, this, &MainWindow::set_flat_view);
  QObject::connect(menus, &WindowMenus::outlines_requested, this, &MainWindow::show_outlines);
  QObject::connect(menus, &WindowMenus::look_requested, this, &MainWindow::show_look);
  QObject::connect(menus, &WindowMenus::timeline_requested, this, &MainWindow::show_timeline);
  QObject::connect(menus, &WindowMenus::method_requested, this, &MainWindow::set_method);
}

void MainWindow::update_menus()
{
  this->menus_->update({ this->is_empty(), this->plane_.has_value(), this->timeline_ });
}

void MainWindow::connect_panel()
{
  QObject::connect(
    this->panel_, &handles::SidePanel::bind_requested, this->binding_, &weights::Binding::start);
  QObject::connect(
    this->panel_, &handles::SidePanel::cancel_requested, this->binding_, &weights::Binding::cancel);
  QObject::connect(this->binding_, &weights::Binding::changed, this,
    [this]
    {
      if (this->binding_->is_running())
      {
        this->error_bar_->hide(); // the error is older than the new bind
      }
      this->update_panel();
      this->update_pose();
    });
  QObject::connect(
    this->binding_, &weights::Binding::notice_requested, this, &MainWindow::show_notice);
  QObject::connect(
    this->binding_, &weights::Binding::bound, this->sessions_->autosave(), &Autosave::begin_save);
  QObject::connect(this->panel_, &handles::SidePanel::bind_method_changed, this,
    [this]
    {
      if (this->is_bound() && !this->binding_->is_running())
      {
        this->panel_->set_note(this->bound_note());
      }
    });
  QObject::connect(this->panel_, &handles::SidePanel::method_chosen, this, &MainWindow::set_method);
  QObject::connect(this->panel_, &handles::SidePanel::mode_chosen, this,
    [this](int mode)
    { this->editing_->commands()->set_handle_mode(static_cast<HandleMode>(mode)); });
  QObject::connect(
    this->panel_, &handles::SidePanel::rest_requested, this, &MainWindow::reset_to_rest);
  QObject::connect(
    this->panel_, &handles::SidePanel::column_chosen, this, &MainWindow::show_column);
}

void MainWindow::connect_volume()
{
  volume::VolumePanel* panel = this->panels_->volume();
  volume::VolumeView* view = this->volume_view_;
  QObject::connect(
    panel, &volume::VolumePanel::slice_requested, view, &volume::VolumeView::show_slice);
  QObject::connect(panel, &volume::VolumePanel::orientation_chosen, view->plane(),
    &view::PlaneHandle::set_orientation);
  QObject::connect(
    panel, &volume::VolumePanel::position_chosen, view->plane(), &view::PlaneHandle::set_position);
  QObject::connect(
    panel, &volume::VolumePanel::isosurface_requested, view, &volume::VolumeView::show_isosurface);
  QObject::connect(panel, &volume::VolumePanel::level_chosen, view, &volume::VolumeView::set_level);
  QObject::connect(
    panel, &volume::VolumePanel::cloud_requested, view, &volume::VolumeView::show_cloud);
  QObject::connect(panel, &volume::VolumePanel::surface_appearance_chosen, this,
    &MainWindow::update_surface_appearance);
  QObject::connect(panel, &volume::VolumePanel::close_requested, this, &MainWindow::close_volume);
  const auto show_position = [panel, view]
  {
    const auto [lowest, highest] = view->positions();
    panel->set_position(view->position(), lowest, highest);
  };
  QObject::connect(view, &volume::VolumeView::slice_moved, panel, show_position);
  QObject::connect(view, &volume::VolumeView::volume_changed, panel, show_position);
  QObject::connect(view, &volume::VolumeView::area_changed, panel, &volume::VolumePanel::set_area);
  QObject::connect(view, &volume::VolumeView::shown_changed, this,
    [this]
    {
      this->update_surface_appearance();
      this->draw_pose(); // draw the shape at rest: winding numbers belong to it
    });
}

void MainWindow::connect_handles()
{
  QObject::connect(this->editing_, &handles::HandleEditing::moved, this, &MainWindow::update_pose);
  QObject::connect(
    this->editing_, &handles::HandleEditing::status_text_changed, this, &MainWindow::update_hint);
  // While regions are painted, the surface shows only the colors of regions.
  QObject::connect(this->editing_, &handles::HandleEditing::mode_changed, this,
    [this](int mode)
    {
      if (mode == handles::HandleEditing::paint_regions)
      {
        this->panels_->show_panel(PanelColumn::bind_and_pose);
      }
    });
  QObject::connect(this->editing_, &handles::HandleEditing::handle_selected, this,
    [this]
    {
      this->posing_->select_handles(this->editing_->selection()->selected());
      this->show_selected_column();
    });
}

/// In the weight panel, choose the column of the handle that was selected last.
void MainWindow::show_selected_column()
{
  const std::vector<int> selected = this->editing_->selection()->selected();
  if (this->is_bound() && !selected.empty())
  {
    this->weights_->choose_column(selected.back());
  }
}

/// Connect the error bar to operations that can fail. When an operation succeeds, an error of its
/// ErrorKind is hidden.
void MainWindow::connect_errors()
{
  const auto connect_failure = [this](auto* part, auto signal, parts::ErrorKind kind)
  {
    QObject::connect(part, signal, this,
      [this, kind](const QString& message) { this->show_error(message, kind); });
  };
  const auto connect_success = [this](auto* part, auto signal, parts::ErrorKind kind)
  { QObject::connect(part, signal, this, [this, kind] { this->error_bar_->succeeded(kind); }); };
  // an error of a bind is hidden by the next bind
  connect_failure(this->binding_, &weights::Binding::failed, parts::ErrorKind::other);
  connect_failure(
    this->shape_handles_, &handles::ShapeHandles::failed, parts::ErrorKind::edit_handles);
  connect_failure(
    this->editing_, &handles::HandleEditing::edit_refused, parts::ErrorKind::edit_handles);
  connect_failure(this->posing_, &posing::PoseController::failed, parts::ErrorKind::pose);
  connect_success(this->posing_, &posing::PoseController::succeeded, parts::ErrorKind::pose);
  connect_failure(this->tet_inspection_, &tets::TetInspection::failed, parts::ErrorKind::tets);
  connect_success(this->tet_inspection_, &tets::TetInspection::succeeded, parts::ErrorKind::tets);
  connect_failure(this->weights_, &weights::WeightInspection::failed, parts::ErrorKind::weights);
  connect_success(this->weights_, &weights::WeightInspection::succeeded, parts::ErrorKind::weights);
  connect_failure(this->winding_volume_, &volume::WindingVolume::failed, parts::ErrorKind::volume);
  connect_success(
    this->winding_volume_, &volume::WindingVolume::succeeded, parts::ErrorKind::volume);
}

// ---- Changes of the document -------------------------------------------------------------------

void MainWindow::document_changed(int parts)
{
  if (parts & mesh_part)
  {
    this->show_mesh();
  }
  if (parts & handles_part)
  {
    this->show_handles();
  }
  if (parts & (volume_part | curves_part))
  {
    this->show_volume();
  }
  if (parts & (mesh_part | weights_part | handles_part))
  {
    this->connect_weights();
  }
  else if (parts & handle_looks_part)
  {
    this->posing_->layers_changed(); // layers, colors and locks do not affect a bind
  }
  if (parts & pose_part)
  {
    const Pose pose = this->document_->pose();
    for (std::size_t k = 0; k < pose.size(); ++k)
    {
      this->panel_->set_mode(static_cast<int>(k), static_cast<int>(pose[k].mode));
    }
  }
  if (parts & (mesh_part | handles_part))
  {
    // If there are no handles, use an empty dataset to which the user can add the first ones.
    this->viewport_->set_handles(this->document_->editable_handles(),
      this->document_->surface() || this->document_->handle_data());
  }
  if (parts & stored_poses_part)
  {
    const auto& kept = this->document_->work().stored_poses;
    this->posing_->pose_manager()->set_stored_poses(kept ? *kept : StoredPoses());
    this->keys_changed();
  }
  if (parts & (handles_part | handle_looks_part))
  {
    this->error_bar_->succeeded(parts::ErrorKind::edit_handles);
  }
  this->editing_->document_changed(parts);
  this->update_title();
  this->binding_->offer_rebind();
  if (parts & ~(options_part | stored_poses_part | sources_part))
  {
    this->update_panel();
    this->update_pose();
  }
}

/// Show the timeline when the first key is set. Only the user can hide it again.
void MainWindow::keys_changed()
{
  const bool has_keys = !this->posing_->stored_poses().keys.keys().empty();
  if (has_keys && !this->has_keys_)
  {
    this->show_timeline(true);
  }
  this->has_keys_ = has_keys;
}

void MainWindow::show_timeline(bool shown)
{
  this->timeline_ = shown;
  this->strip_->setVisible(shown && this->document_->surface());
  this->update_menus();
}

void MainWindow::option_changed(const QString& key, const QVariant& value)
{
  if (key == "pose.method")
  {
    this->panel_->set_method(value.toInt());
    this->menus_->show_method(value.toInt());
    this->update_pose();
  }
}

void MainWindow::show_mesh()
{
  this->note_bar_->hide(); // the note is about the previous mesh
  const Work& work = this->document_->work();
  this->binding_->cancel();
  this->drawn_surface_ = work.surface;
  this->viewport_->set_surface(work.surface);
  this->viewport_->set_picture(work.picture);
  this->viewport_->set_look(work.look, work.surface);
  this->tet_inspection_->set_surface(work.surface, work.mesh_tets);
  Vec3 normal;
  const bool planar = work.surface && find_plane(to_points(work.surface).view(), normal);
  this->plane_ = planar ? std::optional(normal) : std::nullopt;
  this->flat_requested_ = true;
  this->update_plane();
  this->posing_->set_plane(this->plane_);
  if (work.surface && !planar)
  {
    // Do not search planar shapes, because their boundary would be reported as a defect.
    this->tet_inspection_->search_defects();
  }
  if (!work.curves)
  {
    const bool has_lines = work.surface && work.surface->GetNumberOfLines() > 0;
    this->viewport_->set_curves(has_lines ? work.surface.Get() : nullptr);
  }
  this->viewport_->reset_view();
}

/// Switch the viewport to 2D mode if the shape is planar. The mode is off while a volume is open.
void MainWindow::update_plane()
{
  const bool flat = this->flat_requested_ && !this->document_->work().volume;
  this->viewport_->set_plane(flat ? this->plane_ : std::nullopt);
}

void MainWindow::set_flat_view(bool flat)
{
  this->flat_requested_ = flat;
  this->update_plane();
  this->update_menus();
}

void MainWindow::show_handles()
{
  if (!this->document_->surface())
  {
    this->viewport_->reset_view();
  }
  std::vector<handles::HandleTree::Row> rows;
  const Pose pose = this->document_->pose();
  for (std::size_t k = 0; k < pose.size(); ++k)
  {
    const Handle& handle = this->document_->handles()[k];
    rows.push_back({ QString::fromStdString(handle.name), handle.kind,
      static_cast<int>(handle.parent), static_cast<int>(pose[k].mode) });
  }
  this->panel_->set_handles(rows);
}

void MainWindow::show_volume()
{
  const Work& work = this->document_->work();
  if (work.curves)
  {
    this->viewport_->set_curves(work.curves);
  }
  if (this->volume_view_->volume() == work.volume)
  {
    return;
  }
  double lowest = 0.0;
  double highest = 1.0;
  if (work.volume)
  {
    const Status status = check_volume(work.volume, "WindingNumber");
    lowest = status.report.number("volume.minimum", 0.0);
    highest = status.report.number("volume.maximum", 1.0);
    this->panels_->volume()->set_values(lowest, highest);
    this->volume_view_->set_level(this->panels_->volume()->level());
  }
  this->volume_view_->set_volume(work.volume, lowest, highest);
  this->update_plane();
  if (work.volume)
  {
    this->panels_->set_open(true, !this->is_empty() && work.surface, work.surface);
    this->panels_->show_panel(PanelColumn::volume_slice);
    this->viewport_->reset_view();
  }
}

/// Use the weights for posing if they belong to the handles.
void MainWindow::connect_weights()
{
  vtkPolyData* surface = this->document_->surface();
  if (surface != this->drawn_surface_)
  {
    this->drawn_surface_ = surface;
    this->viewport_->set_surface(surface);
  }
  this->posing_->set_data(surface, this->document_->weighted_tets(), this->document_->handle_data(),
    this->document_->is_bound());
  if (!this->document_->unused_weights_reason().isEmpty())
  {
    this->show_error(this->document_->unused_weights_reason());
  }
  this->weights_->set_data(surface, this->document_->weighted_tets(), this->is_bound());
}

void MainWindow::update_title()
{
  const QString name = this->sessions_->name();
  this->setWindowTitle(name.isEmpty() ? "Bindpose" : QString("%1[*] — Bindpose").arg(name));
  this->setWindowModified(
    !name.isEmpty() && this->document_->is_changed(!this->sessions_->path().isEmpty()));
}

void MainWindow::offer_defects(const QString& counts)
{
  const QString unclean =
    tr("The surface has defects (%1). It can still be bound and posed.").arg(counts);
  this->note_bar_->offer(
    this->read_notice_.isEmpty() ? unclean : this->read_notice_ + '\n' + unclean,
    { { tr("Show where"),
      [this]
      {
        this->panels_->show_panel(PanelColumn::tets);
        this->tet_inspection_->show_defects();
      } } },
    tr("Close"));
}

bool MainWindow::is_empty() const
{
  const Work& work = this->document_->work();
  return !work.surface && !work.handles && !work.volume && !work.curves;
}

// ---- Opening -----------------------------------------------------------------------------------

bool MainWindow::report_error(const QString& name, const Status& status)
{
  if (!status.ok())
  {
    const QString message = QString::fromStdString(status.message);
    this->show_error(name.isEmpty() ? message : QString("%1: %2").arg(name, message));
  }
  return status.ok();
}

bool MainWindow::open(const QString& path, const OpenedFile* read)
{
  // If the work has no unsaved changes, opening another file must not count as an unsaved change.
  const bool unchanged = !this->document_->is_changed(true) && this->sessions_->path().isEmpty();
  const bool done = this->open_file(path, read);
  if (done)
  {
    RecentFiles::add(path);
    if (unchanged)
    {
      this->document_->set_saved();
    }
    this->update_title();
  }
  return done;
}

/// Open the mesh in a folder, which may also contain its materials and pictures.
bool MainWindow::open_folder(const QString& path)
{
  QStringList patterns;
  for (const QString& extension : QString(vtkAssetReader::GetFileExtensions()).split(' '))
  {
    patterns << "*." + extension;
  }
  const QStringList meshes = QDir(path).entryList(patterns, QDir::Files, QDir::Name);
  if (meshes.size() == 1)
  {
    return this->open(QDir(path).filePath(meshes.front()));
  }
  const QString name = short_name(path);
  this->show_error(meshes.isEmpty()
      ? tr("The folder %1 contains no mesh; expected exactly one file of these types: %2.")
          .arg(name, patterns.join(", "))
      : tr("The folder %1 contains %2 meshes, for example %3 and %4; open one of them.")
          .arg(name, QString::number(meshes.size()), meshes[0], meshes[1]));
  return false;
}

bool MainWindow::open_file(const QString& path, const OpenedFile* read)
{
  const QString name = short_name(path);
  if (path.endsWith(QString(".") + session_extension, Qt::CaseInsensitive))
  {
    this->error_bar_->hide();
    return this->sessions_->open(path);
  }
  OpenedFile own_file;
  const Status status = read ? Status() : read_file(path.toStdString(), own_file);
  if (!status.ok())
  {
    // Show only the file name; the readers report the whole path.
    this->error_bar_->show_message(
      QString::fromStdString(status.message).replace(path, name), parts::ErrorKind::other, path);
    return false;
  }
  const OpenedFile& file = read ? *read : own_file;
  this->read_notice_.clear();
  for (const std::string& warning : file.warnings)
  {
    const QString message = QString::fromStdString(warning).replace(path, name) + '.';
    this->read_notice_ += (this->read_notice_.isEmpty() ? "" : "\n") + message;
  }
  const bool done = this->show_file(file, path);
  if (done && !this->read_notice_.isEmpty())
  {
    this->show_notice(this->read_notice_);
  }
  return done;
}

bool MainWindow::show_file(const OpenedFile& file, const QString& path)
{
  const QString name = short_name(path);
  const Source source{ QFileInfo(path).absoluteFilePath(), file.checksum.get() };
  switch (file.kind)
  {
    case OpenedFile::Kind::handles:
      return this->set_handles(vtkPolyData::SafeDownCast(file.data), name, source);
    case OpenedFile::Kind::volume:
      return this->set_volume(vtkImageData::SafeDownCast(file.data), name, source);
    case OpenedFile::Kind::curves:
      return this->set_curves(vtkPolyData::SafeDownCast(file.data), source);
    case OpenedFile::Kind::weights:
      this->error_bar_->hide();
      return this->report_error(QString(), this->document_->set_weights(file.weights, name));
    case OpenedFile::Kind::picture:
      return this->open_picture(vtkImageData::SafeDownCast(file.data), name, source, false);
    default:
      return this->set_mesh(file.data, name, source, file.look) &&
        (!file.handles || this->set_handles(file.handles, name, source));
  }
}

/// Open an image as a planar shape with the image as its texture. The shape covers the opaque part
/// of the image or, if `is_whole_image` is true, the whole rectangle.
bool MainWindow::open_picture(
  vtkImageData* picture, const QString& name, const Source& source, bool is_whole_image)
{
  this->error_bar_->hide();
  QApplication::setOverrideCursor(Qt::WaitCursor);
  vtkSmartPointer<vtkPolyData> shape;
  bool cut_out = false;
  Status status = make_shape(picture, is_whole_image, shape, cut_out);
  QApplication::restoreOverrideCursor();
  if (status.ok())
  {
    status = this->document_->set_picture(shape, picture, name, source);
  }
  if (status.ok() && cut_out)
  {
    const vtkSmartPointer<vtkImageData> kept = picture;
    this->note_bar_->offer(tr("%1 is cut out along its transparent parts.").arg(name),
      { { tr("Use the whole picture"),
        [this, kept, name, source] { this->open_picture(kept, name, source, true); } } },
      tr("Close"));
  }
  return this->report_error(name, status);
}

bool MainWindow::set_mesh(vtkDataSet* mesh, const QString& name, const Source& source,
  const std::shared_ptr<const FileLook>& look)
{
  this->error_bar_->hide();
  const bool done = this->report_error(name, this->document_->set_mesh(mesh, name, source, look));
  if (done)
  {
    this->orient_planes();
  }
  if (done && this->tet_inspection_->tet_view()->tets() && !this->document_->handle_data())
  {
    this->panels_->show_panel(PanelColumn::tets);
  }
  return done;
}

bool MainWindow::set_handles(vtkPolyData* handles, const QString& name, const Source& source)
{
  this->error_bar_->hide();
  this->binding_->cancel();
  return this->report_error(name, this->document_->set_handles(handles, name, source));
}

bool MainWindow::set_volume(vtkImageData* volume, const QString& name, const Source& source)
{
  this->error_bar_->hide();
  const bool done = this->report_error(name, check_volume(volume, "WindingNumber"));
  if (done)
  {
    this->document_->set_volume(volume, name, source);
    this->orient_planes();
  }
  return done;
}

bool MainWindow::set_curves(vtkPolyData* curves, const Source& source)
{
  this->error_bar_->hide();
  const bool was_empty = this->is_empty();
  this->document_->set_curves(curves, tr("curves"), source);
  if (was_empty)
  {
    this->viewport_->reset_view();
  }
  return true;
}

void MainWindow::close_volume()
{
  this->document_->set_volume(nullptr, QString());
}

void MainWindow::choose_and_open()
{
  const QString extensions = QString(vtkMeshFileReader::GetFileExtensions()).replace(' ', " *.") +
    " *.tgf *.glb *.gltf *.fbx *.dae *.3ds *.3mf *.dmat *.png *.jpg *.jpeg *." + session_extension;
  for (const QString& path : QFileDialog::getOpenFileNames(this, tr("Open"), QString(),
         tr("All supported files (*.%1);;Sessions (*.%2);;All files (*)")
           .arg(extensions, session_extension),
         nullptr, QFileDialog::HideNameFilterDetails))
  {
    this->open(path);
  }
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event)
{
  if (event->mimeData()->hasUrls())
  {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event)
{
  bool opened = true;
  for (const QUrl& url : event->mimeData()->urls())
  {
    const QString path = url.toLocalFile();
    opened = (QFileInfo(path).isDir() ? this->open_folder(path) : this->open(path)) && opened;
  }
  event->setAccepted(opened);
}

void MainWindow::closeEvent(QCloseEvent* event)
{
  event->setAccepted(this->sessions_->confirm_close());
}

// ---- Posing ------------------------------------------------------------------------------------

void MainWindow::set_method(int method)
{
  this->document_->set_option("pose.method", method);
  // update even if the method was already selected, because the user expects to see the pose
  this->update_pose();
}

void MainWindow::set_mode(int handle, int mode)
{
  this->document_->set_mode(handle, mode);
}

void MainWindow::reset_to_rest()
{
  this->document_->reset_to_rest();
}

bool MainWindow::is_bound() const
{
  return this->posing_->has_weights();
}

vtkPolyData* MainWindow::shown() const
{
  return this->posing_->shape();
}

void MainWindow::connect_posing()
{
  QObject::connect(this->posing_, &posing::PoseController::moved, this, &MainWindow::draw_pose);
  QObject::connect(this->posing_, &posing::PoseController::pose_changed, this,
    [this](const Pose& pose)
    {
      set_pose(this->document_->handle_data(), this->document_->handle_cells(), pose);
      for (std::size_t k = 0; k < pose.size(); ++k)
      {
        this->panel_->set_mode(static_cast<int>(k), static_cast<int>(pose[k].mode));
      }
      this->update_pose();
    });
  QObject::connect(this->posing_, &posing::PoseController::pose_step_requested, this->document_,
    [this](const QString& step, const QString& merge)
    { this->document_->commit_pose(step, merge); });
  QObject::connect(this->posing_, &posing::PoseController::edit_ended, this->document_,
    [this] { this->document_->end_merge(); });
  QObject::connect(this->posing_, &posing::PoseController::stored_poses_changed, this->document_,
    [this](const QString& step)
    { this->document_->set_stored_poses(this->posing_->stored_poses(), step); });
  QObject::connect(this->posing_, &posing::PoseController::handles_changed, this->document_,
    [this](const QString& step) { this->document_->commit_handles(step, step); });
}

void MainWindow::update_pose()
{
  this->posing_->handles_moved();
  this->draw_pose();
}

void MainWindow::draw_pose()
{
  vtkPolyData* rest = this->document_->surface();
  const bool handles = this->document_->handle_data();
  this->show_state();
  const bool shows_tets = this->tet_inspection_->tet_view()->is_shown();
  const bool shows_slice =
    this->volume_view_->is_slice_shown() || this->weights_->requires_rest_shape();
  QString reading = shows_tets ? tr("Drag the cut to move it; drag elsewhere to turn the view.")
    : shows_slice              ? tr("Drag the slice to move it; drag elsewhere to turn the view.")
    : !rest                    ? tr("Open a mesh (Ctrl+O) or drop one here.")
    : !handles ? tr("Add handles (press ? to list all keys), or open a handle file (.tgf or .vtp).")
    : this->binding_->is_running() ? tr("Binding; the view can be turned meanwhile.")
                                   : tr("Bind (Ctrl+B), then drag the handles.");
  if (this->posing_->can_pose() && !shows_tets && !shows_slice)
  {
    reading = this->posing_->reading();
  }
  // While another mesh is being opened, the pose is that of the previous mesh and is not drawn.
  if (rest && this->posing_->surface() == this->drawn_surface_)
  {
    this->posing_->draw();
    this->weights_->move_surface(this->posing_->displayed_shape());
  }
  this->distances_->update();
  this->rotations_->update();
  this->probe_->clear();
  this->hint_text_ = reading;
  this->update_hint();
  this->viewport_->refresh();
}

/// Show all data in the 3D view in the same state, posed or at rest. Data that belongs to the shape
/// at rest (tets, defects, slices, winding numbers) is shown together with surface and handles at
/// rest. A label then states that the shape is at rest.
void MainWindow::show_state()
{
  const QString inspected = this->tet_inspection_->tet_view()->is_shown()
    ? tr("required to show tets")
    : this->tet_inspection_->defect_view().is_shown() ? tr("required to show defects")
    : this->weights_->requires_rest_shape()           ? tr("required to show the slice of weights")
    : this->volume_view_->is_shown()                  ? tr("required to show winding numbers")
                                                      : QString();
  const bool rest_view = this->posing_->is_rest_view();
  this->posing_->inspect_at_rest(!inspected.isEmpty());
  this->editing_->show_rest(!inspected.isEmpty() || rest_view);
  const bool is_editing = this->posing_->edits_at_rest() && this->posing_->is_posed();
  const QString reason = !inspected.isEmpty() ? inspected
    : rest_view                               ? tr("T shows the pose")
    : is_editing                              ? tr("handles are edited at rest")
                                              : QString();
  this->viewport_->set_state_name(this->document_->handle_data() && !reason.isEmpty()
      ? tr("Rest shape: %1").arg(reason)
      : QString());
}

/// Orient the cutting planes perpendicular to the axis that is nearest to the line of sight, so
/// that a cut shows the inside. An orientation or a side that the user has chosen is kept.
void MainWindow::orient_planes()
{
  const Vec3 view_direction(
    this->viewport_->renderer()->GetActiveCamera()->GetDirectionOfProjection());
  int axis = 0;
  view_direction.cwiseAbs().maxCoeff(&axis);
  for (const QString name : { "volume", "tets", "weights" })
  {
    const QString key = name + ".orientation";
    int& automatic_orientation =
      this->automatic_orientations_.try_emplace(name, find_option(key)->initial.toInt())
        .first->second;
    const QString side = "tets.other_side";
    const bool has_side = name == "tets";
    if (this->document_->number(key) == automatic_orientation &&
      !this->document_->has_step_of(key) && !(has_side && this->document_->has_step_of(side)))
    {
      automatic_orientation = axis;
      this->links_->set_without_undo(key, axis);
      if (has_side)
      {
        this->links_->set_without_undo(side, view_direction[axis] > 0.0);
      }
    }
  }
}

/// Update the status line. A text about the current interaction has priority over the text about
/// the last pose.
void MainWindow::update_hint()
{
  const QString editing_message = this->editing_->message();
  this->hint_->setText(editing_message.isEmpty() ? this->hint_text_ : editing_message);
  this->hint_->setStyleSheet(
    this->editing_->is_warning() ? "color: " + parts::theme_color("error_ink").name() : QString());
}

void MainWindow::update_panel()
{
  const bool surface = this->document_->surface();
  const bool handles = this->document_->handle_data();
  const bool ready = surface && handles;
  const bool binding = this->binding_->is_running();
  const bool bound = this->is_bound();
  this->panel_->set_state(ready, binding, bound);
  const int column = this->panel_->shown_column();
  const int columns = static_cast<int>(this->document_->handles().size());
  this->panel_->show_column(bound && column < columns ? column : -1);
  this->show_column(this->panel_->shown_column());
  this->panel_->set_note(binding ? tr("Starting …")
      : bound                    ? this->bound_note()
      : ready                    ? tr("Not bound yet.")
      : !surface && !handles     ? tr("Binding requires a mesh and handles.")
      : surface                  ? tr("Binding requires handles.")
                                 : tr("Binding requires a mesh."));
  this->panels_->set_open(this->volume_view_->volume(), surface || handles, surface);
  this->winding_volume_->update();
  this->update_surface_appearance();
  this->empty_->setVisible(this->is_empty());
  this->strip_->setVisible(surface && this->timeline_);
  this->update_menus();
}

QString MainWindow::bound_note() const
{
  return certificate_note(this->document_->surface(), this->panel_->method());
}

void MainWindow::show_outlines(bool shown)
{
  this->viewport_->show_outlines(shown);
  this->draw_pose(); // draw again, because the right half of a split view shows outlines too
  this->update_menus();
  this->links_->chosen("show.outlines");
}

void MainWindow::show_look(bool shown)
{
  this->viewport_->show_look(shown);
  this->weights_->update_panel_state();
  this->update_menus();
  this->links_->chosen("show.look");
}

/// Determine how the surface is drawn. Tets hide the surface, and defects make it see-through. If
/// neither is shown, a slice of the weights determines the look. If there is no slice either, the
/// panel of the volume determines it.
void MainWindow::update_surface_appearance()
{
  int appearance = this->tet_inspection_->surface_appearance();
  appearance =
    appearance == view::Viewport::solid ? this->weights_->surface_appearance() : appearance;
  this->viewport_->set_surface_appearance(
    appearance == view::Viewport::solid && this->volume_view_->is_active()
      ? this->panels_->volume()->surface_appearance()
      : appearance);
  this->weights_->update_panel_state();
}

void MainWindow::show_column(int column)
{
  const Handles& handles = this->document_->handles();
  const int handle = column < static_cast<int>(handles.size()) ? column : -1;
  this->viewport_->show_column(handle,
    handle < 0 ? QString()
               : tr("Weights of %1").arg(short_name(QString::fromStdString(handles[handle].name))));
}

// ---- Errors -------------------------------------------------------------------------

void MainWindow::show_error(const QString& message, parts::ErrorKind kind)
{
  this->error_bar_->show_message(message, kind);
}

void MainWindow::show_notice(const QString& message)
{
  this->note_bar_->offer(message, {}, tr("Close"));
}

QString MainWindow::reading() const
{
  return this->probe_->reading();
}

QString MainWindow::error() const
{
  return this->error_bar_->message();
}

} // namespace app::window
