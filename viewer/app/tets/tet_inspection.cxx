#include "app/tets/tet_inspection.h"

#include "app/tets/tet_panel.h"
#include "app/view/viewport.h"

#include "scene/categories.h"

#include "conversion.h"
#include "inside/tetrahedralize.h"
#include "surface/surface_defects.h"
#include "surface/surface_repair.h"
#include "surface_defects_data.h"
#include "tets_data.h"

#include <memory>

namespace app::tets
{

using namespace bindpose;

namespace
{
TetrahedralizeOptions options_of(int method)
{
  TetrahedralizeOptions options;
  options.method = method == TetPanel::remesh ? TetMethod::remesh
    : method == TetPanel::embed               ? TetMethod::embed
    : method == TetPanel::wrap                ? TetMethod::wrap
    : method == TetPanel::ftetwild            ? TetMethod::ftetwild
    : method == TetPanel::automatic           ? TetMethod::automatic
                                              : TetMethod::cdt;
  options.keep_outside = method == TetPanel::whole_hull;
  return options;
}

/// Return a copy of the surface for use on another thread.
TriangleMesh copy_of(const SurfaceInput& surface)
{
  TriangleMesh mesh;
  mesh.points = surface.points.view();
  mesh.triangles = surface.triangles.view();
  return mesh;
}

Status find_defects(
  ExecutionContext& context, const TriangleMesh& mesh, vtkSmartPointer<vtkPolyData>& defects)
{
  RepairOptions options;
  options.orient = false;
  RepairedSurface repaired;
  Status status = repair_surface(context, mesh.points, mesh.triangles, options, repaired);
  if (status.ok())
  {
    defects = to_polydata(list_defects(mesh.points, mesh.triangles, repaired), mesh.points, {});
  }
  return status;
}

/// Return the number of all defects, as counted in the legend.
qlonglong count_all(vtkPolyData* defects)
{
  std::vector<Category> categories = defect_categories();
  count_defects(defects, categories);
  Index sum = 0;
  for (const Category& category : categories)
  {
    sum += category.count;
  }
  return sum;
}

/// Return a text with the number of defects per type, like "boundary: 12, fold: 3"; empty if there
/// are no defects.
QString format_counts(vtkPolyData* defects)
{
  std::vector<Category> categories = defect_categories();
  count_defects(defects, categories);
  QStringList counts;
  for (const Category& category : categories)
  {
    if (category.count > 0)
    {
      counts << QString("%1: %L2")
                  .arg(QString::fromStdString(category.name))
                  .arg(static_cast<qlonglong>(category.count));
    }
  }
  return counts.join(", ");
}
} // namespace

TetInspection::TetInspection(view::Viewport* viewport, TetPanel* panel)
  : QObject(viewport), viewport_(viewport), panel_(panel), tets_(new TetView(viewport)),
    defects_(viewport)
{
  QObject::connect(panel, &TetPanel::tets_requested, this, &TetInspection::make_tets);
  QObject::connect(panel, &TetPanel::cancel_requested, this, [this] { this->tet_job_.cancel(); });
  QObject::connect(
    panel, &TetPanel::show_tets_requested, this, [this] { this->set_active(this->active_); });
  QObject::connect(panel, &TetPanel::cut_requested, this->tets_, &TetView::set_cut);
  QObject::connect(panel, &TetPanel::other_side_requested, this->tets_, &TetView::set_other_side);
  view::PlaneHandle* plane = this->tets_->plane();
  QObject::connect(
    panel, &TetPanel::orientation_chosen, plane, &view::PlaneHandle::set_orientation);
  QObject::connect(panel, &TetPanel::position_chosen, plane, &view::PlaneHandle::set_position);
  QObject::connect(panel, &TetPanel::shrink_chosen, this->tets_, &TetView::set_shrink);
  QObject::connect(panel, &TetPanel::colors_chosen, this, &TetInspection::choose_colors);
  QObject::connect(panel, &TetPanel::defects_requested, this, &TetInspection::update_defects);
  QObject::connect(this->tets_, &TetView::plane_moved, this, &TetInspection::show_position);
  QObject::connect(this->tets_, &TetView::count_changed, panel, &TetPanel::set_count);
  QObject::connect(&this->tet_job_, &parts::KernelJob::progress, panel, &TetPanel::set_progress);
  QObject::connect(
    &this->tet_job_, &parts::KernelJob::finished, this, &TetInspection::tets_finished);
  QObject::connect(
    &this->defect_job_, &parts::KernelJob::finished, this, &TetInspection::defects_finished);
  QObject::connect(viewport, &QOpenGLWidget::frameSwapped, this, &TetInspection::view_drawn);
}

void TetInspection::set_active(bool active)
{
  this->active_ = active;
  this->tets_->show(active && this->panel_->wants_tets());
  this->update_defects();
}

void TetInspection::set_surface(vtkPolyData* surface, vtkUnstructuredGrid* tets)
{
  this->cancel();
  this->surface_ = surface;
  this->defects_.set_defects(nullptr);
  this->tets_->set_tets(tets);
  this->colors_ = TetPanel::plain;
  this->tets_->set_colors(std::nullopt);
  this->panel_->set_colors(TetPanel::plain);
  this->panel_->set_note(tets
      ? tr("%L1 tets, opened from a file.").arg(qlonglong(tets->GetNumberOfCells()))
      : tr("No tets yet."));
  this->update_panel();
  this->show_position();
  this->panel_->show_tets(tets != nullptr);
  this->set_active(this->active_);
}

void TetInspection::cancel()
{
  this->tet_job_.cancel();
  this->defect_job_.cancel();
}

int TetInspection::surface_appearance() const
{
  return this->tets_->is_shown() ? view::Viewport::hidden
    : this->defects_.is_shown()  ? view::Viewport::see_through
                                 : view::Viewport::solid;
}

void TetInspection::update_panel()
{
  this->panel_->set_state(
    this->surface_ != nullptr, this->tet_job_.is_running(), this->tets_->tets() != nullptr);
}

void TetInspection::show_position()
{
  const auto [lowest, highest] = this->tets_->plane()->positions();
  this->panel_->set_position(this->tets_->plane()->position(), lowest, highest);
}

// ---- Tets --------------------------------------------------------------------------------------

void TetInspection::make_tets(int method)
{
  SurfaceInput surface;
  const Status status =
    this->surface_ ? to_surface(this->surface_, surface) : Status::invalid_input("no surface");
  if (!status.ok() || this->tet_job_.is_running())
  {
    return;
  }
  this->new_tets_ = std::make_shared<vtkSmartPointer<vtkUnstructuredGrid>>();
  this->tet_job_.start(
    [output = this->new_tets_, mesh = copy_of(surface), options = options_of(method)](
      ExecutionContext& context)
    {
      TetrahedralizeResult result;
      Status tet_status = tetrahedralize(context, mesh.points, mesh.triangles, options, result);
      if (tet_status.usable())
      {
        *output = to_unstructured_grid(result, tet_status.report.text("method"));
      }
      return tet_status;
    });
  this->panel_->set_note(tr("Starting …"));
  this->update_panel();
}

void TetInspection::tets_finished()
{
  this->update_panel();
  const Status& status = this->tet_job_.status();
  if (status.code == StatusCode::canceled || !this->surface_)
  {
    this->panel_->set_note(
      this->tets_->tets() ? tr("Canceled; the tets are unchanged.") : tr("Canceled."));
    return;
  }
  if (!status.usable() || !*this->new_tets_)
  {
    this->panel_->set_note(
      this->tets_->tets() ? tr("Failed; the tets are unchanged.") : tr("Failed."));
    Q_EMIT this->failed(tr("Cannot make tets: %1.").arg(QString::fromStdString(status.message)));
    return;
  }
  const bool first = !this->tets_->tets();
  this->tets_->set_tets(*this->new_tets_);
  if (first)
  {
    Q_EMIT this->first_tets_computed();
  }
  this->choose_colors(this->colors_);
  this->update_panel();
  this->show_position();
  this->panel_->set_note(tr("%L1 tets in %3 s (method %2).")
                           .arg(qlonglong(this->tets_->tets()->GetNumberOfCells()))
                           .arg(QString::fromStdString(status.report.text("method")))
                           .arg(status.report.number("seconds.total", 0.0), 0, 'f', 1));
  this->panel_->show_tets(true);
  this->set_active(this->active_);
  if (!status.warnings.empty())
  {
    Q_EMIT this->notice_requested(
      tr("Tets made with a warning: %1.").arg(QString::fromStdString(status.warnings.front())));
  }
}

void TetInspection::choose_colors(int colors)
{
  std::optional<ColorBy> by;
  switch (colors)
  {
    case TetPanel::winding_number:
      by = ColorBy::winding_number;
      break;
    case TetPanel::label:
      by = ColorBy::label;
      break;
    case TetPanel::quality:
      by = ColorBy::quality;
      break;
    case TetPanel::method:
      by = ColorBy::method;
      break;
    default:
      break;
  }
  const Status status = this->tets_->set_colors(by);
  if (status.ok())
  {
    this->colors_ = colors;
    Q_EMIT this->succeeded();
    return;
  }
  this->panel_->set_colors(this->colors_);
  Q_EMIT this->failed(tr("Cannot color the tets: %1.").arg(QString::fromStdString(status.message)));
}

// ---- Defects -----------------------------------------------------------------------------------

/// Show or hide the defects. The first request starts the search for them.
void TetInspection::update_defects()
{
  const bool shows_defects = this->active_ && this->panel_->wants_defects() && this->surface_;
  this->defects_.show(shows_defects);
  if (shows_defects)
  {
    this->start_defect_search();
  }
  vtkPolyData* found = this->defects_.defects();
  this->panel_->set_defects_note(!shows_defects ? QString()
      : !found                                  ? tr("Checking the surface …")
                                                : tr("%L1 defects").arg(count_all(found)));
  Q_EMIT this->surface_look_changed();
}

void TetInspection::search_defects()
{
  this->reports_defects_ = this->surface_ != nullptr;
  // Begin the search after the surface is drawn: software rendering uses all cores, and the search
  // would slow it down.
  this->waits_for_drawing_ = this->reports_defects_ && this->viewport_->isVisible();
  if (!this->waits_for_drawing_)
  {
    this->start_defect_search();
  }
}

void TetInspection::view_drawn()
{
  if (this->waits_for_drawing_)
  {
    this->waits_for_drawing_ = false;
    this->start_defect_search();
  }
}

void TetInspection::show_defects()
{
  this->panel_->show_defects(true);
}

/// Search for defects in the background. The search runs once per surface.
void TetInspection::start_defect_search()
{
  SurfaceInput surface;
  if (this->surface_ && !this->defects_.defects() && !this->defect_job_.is_running() &&
    to_surface(this->surface_, surface).ok())
  {
    this->new_defects_ = std::make_shared<vtkSmartPointer<vtkPolyData>>();
    this->defect_job_.start(
      [output = this->new_defects_, mesh = copy_of(surface)](ExecutionContext& context)
      { return find_defects(context, mesh, *output); });
  }
}

void TetInspection::defects_finished()
{
  const Status& status = this->defect_job_.status();
  if (status.code == StatusCode::canceled)
  {
    this->update_defects(); // another surface may have been opened during the search
    if (this->reports_defects_)
    {
      this->start_defect_search();
    }
    return;
  }
  if (!status.ok() || !*this->new_defects_)
  {
    this->reports_defects_ = false;
    if (!this->panel_->wants_defects())
    {
      return; // the user has not requested defects
    }
    this->panel_->show_defects(false);
    Q_EMIT this->failed(
      tr("Cannot check the surface: %1.").arg(QString::fromStdString(status.message)));
    return;
  }
  this->defects_.set_defects(*this->new_defects_);
  this->update_defects();
  const QString counts = format_counts(this->defects_.defects());
  if (this->reports_defects_ && !counts.isEmpty())
  {
    Q_EMIT this->defects_found(counts);
  }
  this->reports_defects_ = false;
}

} // namespace app::tets
