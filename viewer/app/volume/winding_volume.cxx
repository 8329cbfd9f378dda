#include "app/volume/winding_volume.h"

#include "app/volume/volume_panel.h"
#include "document/document.h"

#include "conversion.h"
#include "grid_request.h"
#include "winding/winding_number.h"
#include "winding_field.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace app::volume
{

using namespace bindpose;

namespace
{
Status compute(ExecutionContext& context, const TriangleMesh& mesh, int samples,
  vtkSmartPointer<vtkImageData>& volume)
{
  GridRequest request;
  request.samples_along_longest_side = samples;
  SampleGrid grid;
  Status status = make_grid(request, bounding_box(mesh.points), grid);
  WindingNumber field;
  const double build_fraction = winding_build_fraction(mesh.triangles.rows(), grid.count());
  if (status.ok())
  {
    const Phase phase(context, "build", 0.0, build_fraction);
    WindingNumber::Options options;
    options.expected_queries = grid.count();
    status = field.build(context, mesh.points, mesh.triangles, options);
  }
  if (!status.ok())
  {
    return status;
  }
  const Phase phase(context, "evaluate", build_fraction, 1.0);
  vtkNew<vtkDoubleArray> values;
  values->SetName("WindingNumber");
  values->SetNumberOfTuples(grid.count());
  status = field.evaluate(context, grid, values->GetPointer(0));
  if (status.ok())
  {
    volume = vtkSmartPointer<vtkImageData>::New();
    volume->SetOrigin(grid.origin.data());
    volume->SetSpacing(grid.spacing.data());
    volume->SetDimensions(static_cast<int>(grid.size(0)), static_cast<int>(grid.size(1)),
      static_cast<int>(grid.size(2)));
    volume->GetPointData()->SetScalars(values);
  }
  return status;
}
} // namespace

WindingVolume::WindingVolume(Document* document, VolumePanel* panel, QObject* parent)
  : QObject(parent), document_(document), panel_(panel)
{
  QObject::connect(panel, &VolumePanel::compute_requested, this, &WindingVolume::start);
  QObject::connect(panel, &VolumePanel::cancel_requested, this, &WindingVolume::cancel);
  QObject::connect(&this->job_, &parts::KernelJob::progress, panel, &VolumePanel::set_progress);
  QObject::connect(&this->job_, &parts::KernelJob::finished, this, &WindingVolume::finish);
}

void WindingVolume::update()
{
  this->panel_->set_state(this->document_->surface() != nullptr, this->is_running(),
    this->document_->work().volume != nullptr);
}

void WindingVolume::start()
{
  SurfaceInput surface;
  if (this->is_running() || !this->document_->surface())
  {
    return;
  }
  const Status status = to_surface(this->document_->surface(), surface);
  if (!status.ok())
  {
    Q_EMIT this->failed(
      tr("Cannot compute winding numbers: %1.").arg(QString::fromStdString(status.message)));
    return;
  }
  TriangleMesh mesh;
  mesh.points = surface.points.view();
  mesh.triangles = surface.triangles.view();
  this->surface_ = this->document_->work().surface;
  this->new_volume_ = std::make_shared<vtkSmartPointer<vtkImageData>>();
  this->job_.start(
    [new_volume = this->new_volume_, mesh = std::move(mesh), samples = this->panel_->samples()](
      ExecutionContext& context) { return compute(context, mesh, samples, *new_volume); });
  this->panel_->set_note(tr("Starting …"));
  this->update();
}

void WindingVolume::finish()
{
  const Status& status = this->job_.status();
  const vtkSmartPointer<vtkImageData> volume = *this->new_volume_;
  this->new_volume_.reset();
  this->update();
  if (status.code == StatusCode::canceled)
  {
    this->panel_->set_note(tr("Canceled."));
  }
  else if (!status.ok() || !volume)
  {
    this->panel_->set_note(QString());
    Q_EMIT this->failed(
      tr("Cannot compute winding numbers: %1.").arg(QString::fromStdString(status.message)));
  }
  // discard the volume if another surface was opened during the computation
  else if (this->surface_ == this->document_->work().surface)
  {
    const int* size = volume->GetDimensions();
    double range[2];
    volume->GetScalarRange(range);
    constexpr double minimum_range = 1e-6;
    this->document_->set_volume(volume, tr("winding numbers"), {}, tr("compute winding numbers"));
    const double seconds = status.report.number("seconds.total", 0.0);
    this->panel_->set_note(range[1] - range[0] < minimum_range
        // All values are equal if each triangle exists twice, with opposite orientations.
        ? tr("Winding numbers are 0: triangles cancel out.")
        : tr("%1 × %2 × %3 samples in %4.")
            .arg(size[0])
            .arg(size[1])
            .arg(size[2])
            .arg(seconds < 1.0 ? tr("%1 ms").arg(1e3 * seconds, 0, 'f', 0)
                               : tr("%1 s").arg(seconds, 0, 'f', 1)));
    Q_EMIT this->succeeded();
  }
}

} // namespace app::volume
