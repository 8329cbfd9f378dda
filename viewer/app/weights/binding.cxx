// Starts binds and uses their results. The job works on copies of the surface and the handles.
// While the job runs, the surface or the handles may be replaced, so the result is checked before
// it is used.
#include "app/weights/binding.h"

#include "app/handles/side_panel.h"
#include "app/parts/notice_bar.h"
#include "app/weights/weight_inspection.h"
#include "document/document.h"
#include "document/work_inputs.h"

#include "conversion.h"
#include "handle_geometry.h"
#include "weights_input.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"

namespace app::weights
{

using namespace bindpose;

Binding::Binding(
  Document* document, handles::SidePanel* panel, parts::NoticeBar* bar, QObject* parent)
  : QObject(parent), document_(document), panel_(panel), bar_(bar), job_(new BindJob(this))
{
  QObject::connect(this->job_, &BindJob::progress, panel, &handles::SidePanel::set_progress);
  QObject::connect(this->job_, &BindJob::preview, this, &Binding::show_preview);
  QObject::connect(this->job_, &BindJob::finished, this, &Binding::finish);
}

void Binding::start()
{
  BindInput input;
  if (!this->document_->surface() || !this->document_->handle_data() || this->is_running() ||
    !this->make_input(input))
  {
    return;
  }
  input.method = &this->panel_->method();
  input.domain = this->panel_->domain();
  this->document_->begin_bind();
  this->job_->start(std::move(input));
  this->offer_rebind();
  Q_EMIT this->changed();
}

bool Binding::make_input(BindInput& input)
{
  SurfaceInput surface;
  HandleGeometry geometry;
  vtkPolyData* surface_data = this->document_->surface();
  Status status = to_surface(surface_data, surface);
  if (status.ok())
  {
    status = to_handle_geometry(this->document_->handle_data(), geometry);
  }
  if (status.ok())
  {
    status = to_region_ids(surface_data, "RegionId", input.region_of_vertex);
  }
  if (!status.ok())
  {
    Q_EMIT this->failed(tr("Cannot bind: %1.").arg(QString::fromStdString(status.message)));
    return false;
  }
  input.surface.points = surface.points.view();
  input.surface.triangles = surface.triangles.view();
  input.handles = this->document_->handles();
  input.handle_elements = to_handle_elements(geometry);
  return true;
}

/// Offer another bind. The bind is optional, because the existing weights remain usable, see
/// BoundColumns.
void Binding::offer_rebind()
{
  const QString reason = this->is_running() ? QString() : this->document_->rebind_reason();
  if (reason != this->reason_)
  {
    this->reason_ = reason;
    this->bar_->hide();
    if (!reason.isEmpty())
    {
      this->bar_->offer(reason, { { tr("Bind again"), [this] { this->start(); } } }, tr("Later"));
    }
  }
}

/// Return a copy of the bound surface with the new weights; null if the weights do not fit the
/// surface.
vtkSmartPointer<vtkPolyData> Binding::with_weights(const BindResult& result) const
{
  vtkPolyData* surface = this->document_->work().surface;
  const Handles& handles = this->document_->bound_handles();
  if (!surface || result.weights.rows() != surface->GetNumberOfPoints() ||
    result.weights.cols() != static_cast<Index>(handles.size()))
  {
    return nullptr; // another mesh was opened during the bind
  }
  auto bound = vtkSmartPointer<vtkPolyData>::New();
  bound->ShallowCopy(surface);
  // a shallow copy shares the field data of the original, so give the copy its own field data
  vtkNew<vtkFieldData> own_fields;
  own_fields->ShallowCopy(surface->GetFieldData());
  bound->SetFieldData(own_fields);
  add_weights(result, handles, bound);
  return bound;
}

void Binding::show_preview(const Weights& weights)
{
  BindResult preview;
  preview.weights = weights;
  const auto bound = this->is_running() ? this->with_weights(preview) : nullptr;
  if (bound && this->document_->set_preview(bound))
  {
    this->preview_ = bound;
    this->panel_->set_note(tr("Preview weights are ready; computing exact weights …"));
  }
}

void Binding::finish()
{
  const BindResult& result = this->job_->result();
  const vtkSmartPointer<vtkPolyData> preview = std::move(this->preview_);
  this->document_->drop_preview();
  this->offer_rebind();
  Q_EMIT this->changed();
  if (result.status.code == StatusCode::canceled)
  {
    if (this->document_->is_bound())
    {
      this->panel_->set_note(tr("Canceled; the weights are unchanged."));
    }
    else if (preview && this->document_->set_bound(preview, nullptr))
    {
      this->panel_->set_note(
        tr("Canceled; preview weights are kept. Bind again for exact weights."));
    }
    else
    {
      this->panel_->set_note(tr("Canceled."));
    }
    return;
  }
  if (!result.status.usable())
  {
    Q_EMIT this->failed(tr("Cannot bind: %1.").arg(QString::fromStdString(result.status.message)));
    return;
  }
  const auto bound = this->with_weights(result);
  if (!bound ||
    !this->document_->set_bound(
      bound, make_weighted_tets(result, this->document_->bound_handles())))
  {
    return;
  }
  Q_EMIT this->bound();
  const Report& report = result.status.report;
  this->panel_->set_note(result.status.ok()
      ? tr("Bound in %1 s. Optimal to within %2.")
          .arg(report.number("seconds.total", 0.0), 0, 'f', 1)
          .arg(report.number("relative_gap", 0.0), 0, 'e', 1)
      : tr("Not converged: gap %1, residual %2.")
          .arg(report.number("relative_gap", 0.0), 0, 'e', 1)
          .arg(report.number("kkt_residual", 0.0), 0, 'e', 1));
  if (!result.status.warnings.empty())
  {
    Q_EMIT this->notice_requested(
      tr("Bound with a warning: %1.").arg(QString::fromStdString(result.status.warnings.front())));
  }
}

} // namespace app::weights
