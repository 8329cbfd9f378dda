#include "main_window.h"

#include "error_bar.h"
#include "help_boxes.h"
#include "inspection.h"
#include "key_strip.h"
#include "panel_column.h"
#include "pose_history.h"
#include "pose_panel.h"
#include "posing.h"
#include "side_panel.h"
#include "viewport.h"
#include "volume_panel.h"
#include "volume_view.h"
#include "weight_inspection.h"
#include "window_files.h"

#include "conversion.h"
#include "handle_geometry.h"
#include "report_field_data.h"
#include "scene/volume.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkFieldData.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkImageData.h"
#include "vtkMeshFileReader.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenuBar>
#include <QMimeData>
#include <QStatusBar>
#include <QUndoStack>
#include <QVBoxLayout>

using namespace bindpose;

namespace
{
/// A file's name for a title or a sentence: exporters write names that no line holds.
QString short_name(const QString& path)
{
  const QString name = QFileInfo(path).fileName();
  constexpr int longest = 60;
  return name.size() <= longest
    ? name
    : name.left(longest / 2) + QStringLiteral("…") + name.right(longest / 2);
}

/// The mesh's skin: of tets their boundary; weights come along.
vtkSmartPointer<vtkPolyData> skin_of(vtkDataSet* mesh)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  if (auto* surface = vtkPolyData::SafeDownCast(mesh))
  {
    result->ShallowCopy(surface);
    return result;
  }
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(mesh);
  surface->Update();
  result->ShallowCopy(surface->GetOutput());
  return result;
}
} // namespace

MainWindow::MainWindow(QWidget* parent)
  : QMainWindow(parent), history_(new QUndoStack(this)), job_(new BindJob(this))
{
  this->setWindowTitle("Bindpose");
  this->setAcceptDrops(true);
  this->resize(1280, 800);
  this->make_layout();
  this->make_menus();

  QObject::connect(this->panel_, &SidePanel::bind_wanted, this, &MainWindow::bind);
  QObject::connect(this->panel_, &SidePanel::cancel_wanted, this, &MainWindow::cancel_bind);
  QObject::connect(this->panel_, &SidePanel::method_chosen, this, &MainWindow::set_method);
  QObject::connect(this->panel_, &SidePanel::mode_chosen, this, &MainWindow::set_mode);
  QObject::connect(this->panel_, &SidePanel::rest_wanted, this, &MainWindow::back_to_rest);
  QObject::connect(this->panel_, &SidePanel::column_chosen, this, &MainWindow::show_column);
  QObject::connect(this->panel_, &SidePanel::handle_chosen, this,
    [this](int handle)
    {
      auto* drawn = this->viewport_->handle_widget()->GetHandleSetRepresentation();
      drawn->SetSelectedHandle(handle < 0 ? -1 : this->handle_cells_[handle]);
      this->posing_->select_handle(handle);
      this->viewport_->refresh();
    });
  QObject::connect(this->job_, &BindJob::progress, this->panel_, &SidePanel::set_progress);
  QObject::connect(this->job_, &BindJob::preview, this, &MainWindow::preview_arrived);
  QObject::connect(this->job_, &BindJob::finished, this, &MainWindow::bind_finished);

  vtkHandleSetWidget* widget = this->viewport_->handle_widget();
  widget->AddObserver(vtkCommand::SelectionChangedEvent, this, &MainWindow::selection_changed);
  widget->AddObserver(vtkCommand::StartInteractionEvent, this, &MainWindow::drag_began);
  widget->AddObserver(vtkCommand::InteractionEvent, this, &MainWindow::update_pose);
  widget->AddObserver(vtkCommand::EndInteractionEvent, this, &MainWindow::drag_ended);
  this->connect_volume();
  this->connect_posing();
  this->update_panel();
  this->update_pose();
}

MainWindow::~MainWindow() = default;

void MainWindow::make_layout()
{
  auto* centre = new QWidget(this);
  auto* columns = new QHBoxLayout(centre);
  columns->setContentsMargins(0, 0, 0, 0);
  columns->setSpacing(0);
  auto* rows = new QVBoxLayout;
  rows->setSpacing(0);

  this->error_bar_ = new ErrorBar(centre);
  rows->addWidget(this->error_bar_);

  this->viewport_ = new Viewport(centre);
  auto* over = new QVBoxLayout(this->viewport_);
  this->empty_ = new QLabel(this->viewport_);
  this->empty_->setObjectName("empty");
  this->empty_->setAlignment(Qt::AlignCenter);
  this->empty_->setWordWrap(true);
  this->empty_->setAttribute(Qt::WA_TransparentForMouseEvents);
  this->empty_->setText(tr("<p style='font-size:15pt'>Open a mesh, or drop one here</p>"
                           "<p>Then open handles (.tgf or .vtp), bind, and drag them.</p>"
                           "<p>A volume of winding numbers (.vti) is shown sliced.</p>"));
  over->addWidget(this->empty_);
  this->volume_view_ = new VolumeView(this->viewport_);
  this->panels_ = new PanelColumn(centre);
  this->panel_ = this->panels_->side();
  this->inspection_ = new Inspection(this->viewport_, this->panels_->tet());
  QObject::connect(
    this->inspection_, &Inspection::surface_look_changed, this, &MainWindow::update_surface_look);
  QObject::connect(this->inspection_, &Inspection::failed, this, &MainWindow::show_error);
  this->weights_ = new WeightInspection(this->viewport_, this->panels_->weight(),
    [this](BindInput& input) { return this->is_bound() && this->make_bind_input(input); });
  QObject::connect(this->weights_, &WeightInspection::surface_look_changed, this,
    [this]
    {
      this->update_surface_look();
      this->update_pose(); // a slice lies in the shape at rest
    });
  QObject::connect(this->weights_, &WeightInspection::failed, this, &MainWindow::show_error);
  QObject::connect(this->panels_, &PanelColumn::panel_shown, this->inspection_,
    [this](int panel)
    {
      this->inspection_->set_active(panel == PanelColumn::tets);
      this->weights_->set_active(panel == PanelColumn::weights);
    });
  rows->addWidget(this->viewport_, 1);
  this->strip_ = new KeyStrip(centre);
  rows->addWidget(this->strip_);
  this->posing_ = new Posing(this->viewport_,
    { this->panel_->pose(), this->panel_->fields(), this->panel_->poses(), this->strip_ });
  columns->addLayout(rows, 1);
  columns->addWidget(this->panels_);
  this->setCentralWidget(centre);
  this->hint_ = new QLabel(this);
  this->statusBar()->addWidget(this->hint_, 1);
  this->hint_->setContentsMargins(12, 3, 12, 4);
  this->reading_ = new QLabel(this);
  this->reading_->setContentsMargins(12, 3, 12, 4);
  this->statusBar()->addPermanentWidget(this->reading_);
  this->statusBar()->setSizeGripEnabled(false);
}

void MainWindow::make_menus()
{
  const auto add = [this](QMenu* menu, const QString& text, const QKeySequence& keys, auto action)
  {
    QAction* entry = menu->addAction(text);
    entry->setShortcut(keys);
    QObject::connect(entry, &QAction::triggered, this, action);
    return entry;
  };

  QMenu* file = this->menuBar()->addMenu(tr("&File"));
  add(file, tr("&Open…"), QKeySequence::Open,
    [this]
    {
      const QString endings = QString(vtkMeshFileReader::GetFileExtensions()).replace(' ', " *.");
      for (const QString& path : QFileDialog::getOpenFileNames(this, tr("Open"), QString(),
             tr("Meshes, handles and volumes (*.%1 *.tgf);;All files (*)").arg(endings), nullptr,
             QFileDialog::HideNameFilterDetails))
      {
        this->open(path);
      }
    });
  this->save_shape_ = add(file, tr("Save &shape as…"),
    QKeySequence(Qt::CTRL + Qt::SHIFT + Qt::Key_S), [this] { this->save("shape"); });
  this->save_pose_ =
    add(file, tr("Save &pose as…"), QKeySequence(), [this] { this->save("pose"); });
  this->save_picture_ =
    add(file, tr("Save p&icture as…"), QKeySequence(), [this] { this->save("picture"); });
  file->addSeparator();
  add(file, tr("&Quit"), QKeySequence::Quit, [this] { this->close(); });

  QMenu* edit = this->menuBar()->addMenu(tr("&Edit"));
  QAction* undo = this->history_->createUndoAction(this, tr("&Undo"));
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = this->history_->createRedoAction(this, tr("&Redo"));
  redo->setShortcuts(
    { QKeySequence(Qt::CTRL + Qt::SHIFT + Qt::Key_Z), QKeySequence(Qt::CTRL + Qt::Key_Y) });
  edit->addAction(undo);
  edit->addAction(redo);
  edit->addSeparator();
  this->bind_ =
    add(edit, tr("&Bind"), QKeySequence(Qt::CTRL + Qt::Key_B), [this] { this->bind(); });
  this->rest_pose_ = add(edit, tr("Back to &rest"), QKeySequence(Qt::CTRL + Qt::Key_R),
    [this] { this->back_to_rest(); });

  QMenu* view = this->menuBar()->addMenu(tr("&View"));
  add(view, tr("&Whole shape"), QKeySequence(Qt::Key_Home),
    [this]
    {
      this->viewport_->reset_view();
      this->viewport_->refresh();
    });
  view->addSeparator();
  add(view, tr("&Rest or posed"), QKeySequence(Qt::Key_R),
    [this] { this->posing_->look_at_rest(!this->posing_->looks_at_rest()); });
  add(view, tr("&Play or pause"), QKeySequence(Qt::Key_Space),
    [this] { this->posing_->play_keys(!this->posing_->is_playing()); });
  add(
    view, tr("&Set a key"), QKeySequence(Qt::Key_K), [this] { Q_EMIT this->strip_->key_wanted(); });
  view->addSeparator();
  this->methods_ = new QActionGroup(this);
  for (int k = 0; k < pose_method_count; ++k)
  {
    QAction* method = add(view, method_name(static_cast<PoseMethod>(k)),
      QKeySequence(Qt::Key_1 + k), [this, k] { this->set_method(k); });
    method->setCheckable(true);
    this->methods_->addAction(method);
  }
  this->methods_->actions().front()->setChecked(true);

  QMenu* help = this->menuBar()->addMenu(tr("&Help"));
  add(help, tr("&Mouse and keys"), QKeySequence(Qt::Key_F1), [this] { show_mouse_and_keys(this); });
  add(help, tr("&About Bindpose"), QKeySequence(), [this] { show_about(this); });
}

// ---- Opening -----------------------------------------------------------------------------------

bool MainWindow::open(const QString& path)
{
  const QString name = short_name(path);
  OpenedFile file;
  const Status status = read_file(path.toStdString(), file);
  if (!status.ok())
  {
    // The readers name the whole path; here the name says enough.
    this->error_bar_->show_sentence(
      QString::fromStdString(status.message).replace(path, name), path);
    return false;
  }
  switch (file.kind)
  {
    case OpenedFile::Kind::handles:
      return this->set_handles(vtkPolyData::SafeDownCast(file.data), name);
    case OpenedFile::Kind::volume:
      return this->set_volume(vtkImageData::SafeDownCast(file.data), name);
    case OpenedFile::Kind::curves:
      return this->set_curves(vtkPolyData::SafeDownCast(file.data));
    default:
      return this->set_mesh(file.data, name) &&
        (!file.handles || this->set_handles(file.handles, name));
  }
}

bool MainWindow::set_mesh(vtkDataSet* mesh, const QString& name)
{
  SurfaceInput surface;
  vtkSmartPointer<vtkPolyData> skin = vtkPointSet::SafeDownCast(mesh) ? skin_of(mesh) : nullptr;
  const Status status = to_surface(skin ? skin.Get() : mesh, surface);
  if (!status.ok())
  {
    this->show_error(QString("%1: %2").arg(name, QString::fromStdString(status.message)));
    return false;
  }
  this->cancel_bind();
  this->error_bar_->hide();
  this->history_->clear();
  this->rest_ = skin;
  this->viewport_->set_surface(skin);
  TetInput tets;
  auto* grid = vtkUnstructuredGrid::SafeDownCast(mesh);
  this->weighted_tets_ = grid && to_tets(grid, tets).ok() ? grid : nullptr;
  this->inspection_->set_surface(skin, this->weighted_tets_);
  if (!this->has_curves_)
  {
    this->viewport_->set_curves(skin->GetNumberOfLines() > 0 ? skin.Get() : nullptr);
  }
  this->viewport_->reset_view();
  this->setWindowTitle(QString("%1 — Bindpose").arg(name));
  this->connect_weights();
  if (this->inspection_->tet_view()->tets() && !this->handle_data_)
  {
    this->panels_->show_panel(PanelColumn::tets);
  }
  return true;
}

bool MainWindow::set_handles(vtkPolyData* handle_data, const QString& name)
{
  Handles handles;
  std::vector<Index> cells;
  const Status status = to_handles(handle_data, handles, &cells);
  if (!status.ok())
  {
    this->show_error(QString("%1: %2").arg(name, QString::fromStdString(status.message)));
    return false;
  }
  this->cancel_bind();
  this->error_bar_->hide();
  this->history_->clear();
  this->handles_ = handles;
  this->handle_cells_ = cells;
  this->handle_data_ = vtkSmartPointer<vtkPolyData>::New();
  this->handle_data_->DeepCopy(handle_data);
  Pose pose;
  to_pose(this->handle_data_, this->handles_, this->handle_cells_, pose);
  set_pose(this->handle_data_, this->handle_cells_, pose);
  this->viewport_->set_handles(this->handle_data_);
  if (!this->rest_)
  {
    this->viewport_->reset_view();
  }
  QStringList names;
  QList<int> modes;
  for (std::size_t k = 0; k < this->handles_.size(); ++k)
  {
    names << QString::fromStdString(this->handles_[k].name);
    modes << static_cast<int>(pose[k].mode);
  }
  this->panel_->set_handles(names, modes);
  this->connect_weights();
  return true;
}

bool MainWindow::set_volume(vtkImageData* volume, const QString& name)
{
  const Status status = check_volume(volume, "WindingNumber");
  if (!status.ok())
  {
    this->show_error(QString("%1: %2").arg(name, QString::fromStdString(status.message)));
    return false;
  }
  this->error_bar_->hide();
  const double lowest = status.report.number("volume.minimum", 0.0);
  const double highest = status.report.number("volume.maximum", 1.0);
  this->panels_->volume()->set_values(lowest, highest);
  this->volume_view_->set_level(this->panels_->volume()->level());
  this->volume_view_->set_volume(volume, lowest, highest);
  this->panels_->set_open(true, this->rest_ || this->handle_data_, this->rest_);
  this->panels_->show_panel(PanelColumn::volume_slice);
  if (!this->rest_)
  {
    this->setWindowTitle(QString("%1 — Bindpose").arg(name));
  }
  this->viewport_->reset_view();
  this->update_panel();
  this->update_pose();
  return true;
}

bool MainWindow::set_curves(vtkPolyData* curves)
{
  this->error_bar_->hide();
  const bool alone = !this->rest_ && !this->handle_data_ && !this->volume_view_->volume();
  this->has_curves_ = true;
  this->viewport_->set_curves(curves);
  if (alone)
  {
    this->viewport_->reset_view();
  }
  this->update_panel();
  this->update_pose();
  return true;
}

void MainWindow::close_volume()
{
  this->volume_view_->set_volume(nullptr, 0.0, 1.0);
  this->update_panel();
  this->update_pose();
}

void MainWindow::connect_volume()
{
  VolumePanel* panel = this->panels_->volume();
  VolumeView* view = this->volume_view_;
  QObject::connect(panel, &VolumePanel::slice_wanted, view, &VolumeView::show_slice);
  QObject::connect(panel, &VolumePanel::position_chosen, view, &VolumeView::set_position);
  QObject::connect(panel, &VolumePanel::isosurface_wanted, view, &VolumeView::show_isosurface);
  QObject::connect(panel, &VolumePanel::level_chosen, view, &VolumeView::set_level);
  QObject::connect(panel, &VolumePanel::cloud_wanted, view, &VolumeView::show_cloud);
  QObject::connect(
    panel, &VolumePanel::surface_look_chosen, this, &MainWindow::update_surface_look);
  QObject::connect(panel, &VolumePanel::close_wanted, this, &MainWindow::close_volume);
  const auto show_position = [panel, view]
  {
    const auto [lowest, highest] = view->positions();
    panel->set_position(view->position(), lowest, highest);
  };
  QObject::connect(panel, &VolumePanel::orientation_chosen, view,
    [view, show_position](int orientation)
    {
      view->set_orientation(orientation);
      show_position();
    });
  QObject::connect(view, &VolumeView::slice_moved, panel, show_position);
  QObject::connect(view, &VolumeView::volume_changed, panel, show_position);
  QObject::connect(view, &VolumeView::area_changed, panel, &VolumePanel::set_area);
  QObject::connect(view, &VolumeView::reading_changed, this->reading_, &QLabel::setText);
}

/// Weights that came with the mesh are used when they are those of the handles.
void MainWindow::connect_weights()
{
  vtkDataArray* weights = this->rest_ ? this->rest_->GetPointData()->GetArray("Weights") : nullptr;
  bool fit = false;
  if (weights && this->handle_data_)
  {
    bool same_names = true;
    for (std::size_t k = 0; k < this->handles_.size(); ++k)
    {
      const char* name = weights->GetComponentName(static_cast<vtkIdType>(k));
      same_names = same_names && (!name || this->handles_[k].name == name);
    }
    if (weights->GetNumberOfComponents() == static_cast<int>(this->handles_.size()) && same_names)
    {
      fit = true;
    }
    else if (weights->GetNumberOfComponents() == static_cast<int>(this->handles_.size()))
    {
      this->show_error(tr("The mesh has weights for handles of other names: bind again."));
    }
    else
    {
      this->show_error(
        tr("The mesh has weights for %1 handles, but %2 handles are open: bind again.")
          .arg(weights->GetNumberOfComponents())
          .arg(this->handles_.size()));
    }
  }
  this->posing_->set_data(this->rest_, this->weighted_tets_, this->handle_data_, fit);
  this->weights_->set_data(this->rest_, this->weighted_tets_, this->is_bound());
  this->update_panel();
  this->update_pose();
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
  for (const QUrl& url : event->mimeData()->urls())
  {
    this->open(url.toLocalFile());
  }
}

// ---- Binding -----------------------------------------------------------------------------------

void MainWindow::bind()
{
  if (!this->rest_ || !this->handle_data_ || this->is_binding())
  {
    return;
  }
  this->error_bar_->hide();
  BindInput input;
  if (!this->make_bind_input(input))
  {
    return;
  }
  input.method = this->panel_->monotone() ? BindMethod::monotone : BindMethod::bounded;
  this->job_->start(std::move(input));
  this->update_panel();
  this->update_pose();
}

/// What the kernels need of surface and handles; false, with a sentence, when they cannot be used.
bool MainWindow::make_bind_input(BindInput& input)
{
  SurfaceInput surface;
  HandleGeometry geometry;
  Status status = to_surface(this->rest_, surface);
  if (status.ok())
  {
    status = to_handle_geometry(this->handle_data_, geometry);
  }
  if (!status.ok())
  {
    this->show_error(tr("Cannot bind: %1.").arg(QString::fromStdString(status.message)));
    return false;
  }
  input.surface.points = surface.points.view();
  input.surface.triangles = surface.triangles.view();
  input.handles = this->handles_;
  input.handle_places = to_handle_places(geometry);
  if (vtkDataArray* regions = this->rest_->GetPointData()->GetArray("RegionId"))
  {
    for (vtkIdType v = 0; v < regions->GetNumberOfTuples(); ++v)
    {
      input.region_of_vertex.push_back(static_cast<Index>(regions->GetComponent(v, 0)));
    }
  }
  return true;
}

void MainWindow::cancel_bind()
{
  this->job_->cancel();
}

bool MainWindow::take_weights(const BindResult& result)
{
  if (!this->rest_ || result.weights.rows() != this->rest_->GetNumberOfPoints() ||
    result.weights.cols() != static_cast<Index>(this->handles_.size()))
  {
    return false; // another mesh was opened while this one was being bound
  }
  auto bound = vtkSmartPointer<vtkPolyData>::New();
  bound->ShallowCopy(this->rest_);
  vtkNew<vtkFieldData> own; // the copy shares what it was made from
  own->ShallowCopy(this->rest_->GetFieldData());
  bound->SetFieldData(own);
  add_weights(result, this->handles_, bound);
  this->set_rest(bound, make_weighted_tets(result, this->handles_));
  return true;
}

void MainWindow::set_rest(vtkPolyData* rest, vtkUnstructuredGrid* weighted_tets)
{
  this->rest_ = rest;
  this->weighted_tets_ = weighted_tets;
  this->viewport_->set_surface(rest);
  this->connect_weights();
}

void MainWindow::preview_arrived(const Weights& weights)
{
  const vtkSmartPointer<vtkPolyData> before = this->rest_;
  const vtkSmartPointer<vtkUnstructuredGrid> tets_before = this->weighted_tets_;
  BindResult preview;
  preview.weights = weights;
  if (this->is_binding() && this->take_weights(preview))
  {
    this->before_preview_ = before;
    this->tets_before_preview_ = tets_before;
    this->preview_ = this->rest_;
    this->panel_->set_note(tr("A preview to pose with; exact weights follow …"));
  }
}

void MainWindow::bind_finished()
{
  const BindResult& result = this->job_->result();
  const vtkSmartPointer<vtkPolyData> before =
    this->preview_ == this->rest_ ? this->before_preview_ : nullptr;
  this->preview_ = nullptr;
  this->before_preview_ = nullptr;
  if (before && !result.status.usable())
  {
    this->set_rest(before, this->tets_before_preview_);
  }
  this->tets_before_preview_ = nullptr;
  this->update_panel();
  this->update_pose();
  if (result.status.code == StatusCode::cancelled)
  {
    this->panel_->set_note(
      this->is_bound() ? tr("Cancelled; the weights stay as they were.") : tr("Cancelled."));
    return;
  }
  if (!result.status.usable())
  {
    this->show_error(tr("Cannot bind: %1.").arg(QString::fromStdString(result.status.message)));
    return;
  }
  if (!this->take_weights(result))
  {
    return;
  }
  const Report& report = result.status.report;
  this->panel_->set_note(result.status.ok()
      ? tr("Bound in %1 s, certified to %2.")
          .arg(report.number("seconds.total", 0.0), 0, 'f', 1)
          .arg(report.number("relative_gap", 0.0), 0, 'e', 1)
      : tr("Not converged: gap %1, residual %2.")
          .arg(report.number("relative_gap", 0.0), 0, 'e', 1)
          .arg(report.number("kkt_residual", 0.0), 0, 'e', 1));
  if (!result.status.warnings.empty())
  {
    this->show_error(
      tr("Bound, but: %1.").arg(QString::fromStdString(result.status.warnings.front())));
  }
}

// ---- Posing ------------------------------------------------------------------------------------

Pose MainWindow::pose() const
{
  Pose pose;
  if (this->handle_data_)
  {
    to_pose(this->handle_data_, this->handles_, this->handle_cells_, pose);
  }
  return pose;
}

int MainWindow::handle_of_cell(vtkIdType cell) const
{
  const auto found = std::find(this->handle_cells_.begin(), this->handle_cells_.end(), cell);
  return found == this->handle_cells_.end() ? -1
                                            : static_cast<int>(found - this->handle_cells_.begin());
}

void MainWindow::stop_drag()
{
  this->viewport_->handle_widget()->CancelDrag();
}

void MainWindow::apply_pose(const Pose& pose)
{
  set_pose(this->handle_data_, this->handle_cells_, pose);
  for (std::size_t k = 0; k < pose.size(); ++k)
  {
    this->panel_->set_mode(static_cast<int>(k), static_cast<int>(pose[k].mode));
  }
  this->update_pose();
}

void MainWindow::remember(const QString& name, const Pose& before)
{
  this->history_->push(new PoseStep(name, before, this->pose(),
    [this](const Pose& pose)
    {
      this->stop_drag();
      this->apply_pose(pose);
    }));
}

void MainWindow::selection_changed()
{
  const int handle = this->handle_of_cell(
    this->viewport_->handle_widget()->GetHandleSetRepresentation()->GetSelectedHandle());
  this->panel_->select_handle(handle);
  this->posing_->select_handle(handle);
  if (this->is_bound())
  {
    this->weights_->choose_column(handle);
  }
}

void MainWindow::drag_began()
{
  this->posing_->drag_began();
  this->before_drag_ = this->pose();
  this->dragged_ = this->handle_of_cell(
    this->viewport_->handle_widget()->GetHandleSetRepresentation()->GetActiveHandle());
}

void MainWindow::drag_ended()
{
  if (!this->viewport_->handle_widget()->GetCancelled() && this->dragged_ >= 0)
  {
    this->remember(tr("move %1").arg(QString::fromStdString(this->handles_[this->dragged_].name)),
      this->before_drag_);
  }
  this->dragged_ = -1;
}

void MainWindow::set_method(int method)
{
  this->panel_->set_method(method);
  this->methods_->actions()[method]->setChecked(true);
  this->update_pose();
}

void MainWindow::set_mode(int handle, int mode)
{
  this->stop_drag();
  const Pose before = this->pose();
  Pose after = before;
  after[handle].mode = static_cast<HandleMode>(mode);
  this->apply_pose(after);
  this->remember(tr("mode of %1").arg(QString::fromStdString(this->handles_[handle].name)), before);
}

void MainWindow::back_to_rest()
{
  if (!this->handle_data_)
  {
    return;
  }
  this->stop_drag();
  const Pose before = this->pose();
  Pose rest(before.size());
  for (std::size_t k = 0; k < before.size(); ++k)
  {
    rest[k].mode = before[k].mode;
  }
  this->apply_pose(rest);
  this->remember(tr("back to rest"), before);
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
  QObject::connect(this->posing_, &Posing::moved, this, &MainWindow::draw_pose);
  QObject::connect(this->posing_, &Posing::failed, this, &MainWindow::show_error);
  QObject::connect(this->posing_, &Posing::pose_changed, this,
    [this](const Pose& pose)
    {
      if (this->before_change_.empty())
      {
        this->before_change_ = this->pose();
      }
      this->apply_pose(pose);
    });
  QObject::connect(this->posing_, &Posing::pose_done, this,
    [this](const QString& step)
    {
      if (!this->before_change_.empty())
      {
        this->remember(step, this->before_change_);
        this->before_change_.clear();
      }
    });
}

void MainWindow::update_pose()
{
  this->posing_->handles_moved();
  this->draw_pose();
}

void MainWindow::draw_pose()
{
  const bool volume_only = this->volume_view_->volume() && !(this->rest_ && this->handle_data_);
  QString reading = volume_only ? tr("Drag the slice to move it, elsewhere to turn the view.")
    : !this->rest_              ? tr("Open a mesh (Ctrl+O) or drop one here.")
    : !this->handle_data_       ? tr("Open handles (.tgf or .vtp) to bind and pose.")
    : this->is_binding()        ? tr("Binding; the view can be turned meanwhile.")
                                : tr("Bind (Ctrl+B), then drag the handles.");
  if (this->posing_->can_pose())
  {
    reading = this->posing_->reading();
  }
  if (this->rest_)
  {
    if (this->weights_->wants_rest())
    {
      this->viewport_->move_surface(this->rest_.Get());
    }
    else
    {
      this->posing_->draw();
    }
    this->weights_->move_surface(this->weights_->wants_rest() ? this->rest_.Get() : this->shown());
  }
  this->hint_->setText(reading);
  this->viewport_->refresh();
}

void MainWindow::update_panel()
{
  const bool ready = this->rest_ && this->handle_data_;
  const bool binding = this->is_binding();
  const bool bound = this->is_bound();
  this->panel_->set_state(ready, binding, bound);
  const int column = this->panel_->shown_column();
  this->panel_->show_column(
    bound && column < static_cast<int>(this->handles_.size()) ? column : -1);
  this->show_column(this->panel_->shown_column());
  this->panel_->set_note(binding            ? tr("Starting …")
      : bound                               ? tr("Bound with the mesh's weights.")
      : ready                               ? tr("Not bound yet.")
      : !this->rest_ && !this->handle_data_ ? tr("Needs a mesh and handles.")
      : this->rest_                         ? tr("Needs handles.")
                                            : tr("Needs a mesh."));
  const bool volume = this->volume_view_->volume();
  this->panels_->set_open(volume, this->rest_ || this->handle_data_, this->rest_);
  this->panels_->volume()->set_has_surface(this->rest_);
  this->update_surface_look();
  const bool nothing = !this->rest_ && !this->handle_data_ && !volume && !this->has_curves_;
  this->empty_->setVisible(nothing);
  this->save_shape_->setEnabled(this->rest_);
  this->save_picture_->setEnabled(!nothing);
  this->save_pose_->setEnabled(this->handle_data_);
  this->bind_->setEnabled(ready && !binding);
  this->rest_pose_->setEnabled(bound);
  this->methods_->setEnabled(ready);
  this->strip_->setVisible(ready);
}

/// Tets take the surface's place, and defects shine through it; else a volume decides.
void MainWindow::update_surface_look()
{
  int look = this->inspection_->surface_look();
  look = look == Viewport::solid ? this->weights_->surface_look() : look;
  this->viewport_->set_surface_look(look == Viewport::solid && this->volume_view_->volume()
      ? this->panels_->volume()->surface_look()
      : look);
}

void MainWindow::show_column(int column)
{
  const int handle = column < static_cast<int>(this->handles_.size()) ? column : -1;
  this->viewport_->show_column(handle,
    handle < 0
      ? QString()
      : tr("Weights of %1").arg(short_name(QString::fromStdString(this->handles_[handle].name))));
}

// ---- Saving and errors -------------------------------------------------------------------------

void MainWindow::save(const QString& what)
{
  const QString kinds = what == "shape" ? tr("Shapes (*.vtp *.ply *.obj *.off *.stl)")
    : what == "pose"                    ? tr("Poses (*.json)")
                                        : tr("Pictures (*.png)");
  QFileDialog dialog(this, tr("Save %1").arg(what), QString(), kinds);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(what == "shape" ? "vtp" : what == "pose" ? "json" : "png");
  if (dialog.exec() != QDialog::Accepted)
  {
    return;
  }
  const QString path = dialog.selectedFiles().front();
  if (what == "picture")
  {
    if (!this->viewport_->save_picture(path))
    {
      this->show_error(tr("%1 cannot be written.").arg(path));
    }
    return;
  }
  const Status status = what == "pose"
    ? write_pose(this->pose(), this->handles_, path.toStdString())
    : write_shape(this->shown(), path.toStdString());
  if (!status.ok())
  {
    this->show_error(QString::fromStdString(status.message));
  }
}

void MainWindow::show_error(const QString& sentence)
{
  this->error_bar_->show_sentence(sentence);
}

QString MainWindow::reading() const
{
  return this->reading_->text();
}

QString MainWindow::error() const
{
  return this->error_bar_->sentence();
}
