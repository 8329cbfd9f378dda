#include "app/weights/weight_inspection.h"

#include "app/view/viewport.h"
#include "app/weights/weight_panel.h"

#include "conversion.h"
#include "report_field_data.h"
#include "scene/categories.h"
#include "weights_arrays.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"

#include <QCoreApplication>

#include <algorithm>

namespace app::weights
{

using namespace bindpose;

namespace
{
/// Format a value for a narrow label.
QString short_number(double value)
{
  return QString::number(value, 'g', 2);
}

QString format_counts(const std::vector<Extremum>& extrema)
{
  const auto maxima = std::count_if(
    extrema.begin(), extrema.end(), [](const Extremum& extremum) { return extremum.maximum; });
  return WeightInspection::tr("Maxima: %1, minima: %2")
    .arg(maxima)
    .arg(static_cast<qlonglong>(extrema.size()) - maxima);
}

bool has_point_array(vtkDataSet* data, const char* name)
{
  return data && data->GetPointData()->HasArray(name) != 0;
}

/// Return the translated name of a method.
QString name_of(const char* method)
{
  return QCoreApplication::translate("Document", method);
}

QStringList names_of(vtkDataArray* weights)
{
  QStringList names;
  for (int c = 0; weights && c < weights->GetNumberOfComponents(); ++c)
  {
    const char* name = weights->GetComponentName(c);
    names << (name && *name ? QString::fromUtf8(name) : QString::number(c));
  }
  return names;
}
} // namespace

void add_weights(const BindResult& result, const Handles& handles, vtkPolyData* surface)
{
  surface->GetPointData()->AddArray(to_weights_array("Weights", result.weights, handles));
  surface->GetPointData()->RemoveArray("RawWeights");
  if (result.raw.size() > 0)
  {
    surface->GetPointData()->AddArray(to_weights_array("RawWeights", result.raw, handles));
  }
  for (const auto& array : to_certificate_arrays("Weights", result.solved))
  {
    surface->GetFieldData()->AddArray(array);
  }
  attach_report(surface, result.status.report);
}

vtkSmartPointer<vtkUnstructuredGrid> make_weighted_tets(
  const BindResult& result, const Handles& handles)
{
  if (!result.mesh.is_volume())
  {
    return nullptr;
  }
  auto grid = to_unstructured_grid(result.mesh.points, result.mesh.tets);
  grid->GetPointData()->AddArray(to_weights_array("Weights", result.solved.weights, handles));
  grid->GetPointData()->AddArray(to_weights_array("RawWeights", result.solved.raw, handles));
  return grid;
}

WeightInspection::WeightInspection(
  view::Viewport* viewport, WeightPanel* panel, MakeInput make_input)
  : QObject(viewport), viewport_(viewport), panel_(panel), view_(new WeightView(viewport)),
    make_input_(std::move(make_input))
{
  QObject::connect(panel, &WeightPanel::display_changed, this, &WeightInspection::update);
  QObject::connect(panel, &WeightPanel::tint_opacity_chosen, viewport, &view::Viewport::set_tint);
  QObject::connect(panel, &WeightPanel::comparison_requested, this, &WeightInspection::compare);
  QObject::connect(panel, &WeightPanel::cancel_requested, this, &WeightInspection::cancel);
  view::PlaneHandle* plane = this->view_->plane();
  QObject::connect(
    panel, &WeightPanel::orientation_chosen, plane, &view::PlaneHandle::set_orientation);
  QObject::connect(panel, &WeightPanel::position_chosen, plane, &view::PlaneHandle::set_position);
  QObject::connect(this->view_, &WeightView::plane_moved, this, &WeightInspection::show_position);
  QObject::connect(&this->job_, &BindJob::progress, panel, &WeightPanel::set_progress);
  QObject::connect(&this->job_, &BindJob::finished, this, &WeightInspection::comparison_finished);
}

void WeightInspection::set_data(vtkPolyData* surface, vtkUnstructuredGrid* volume, bool has_handles)
{
  this->cancel();
  this->surface_ = surface;
  this->volume_ = has_point_array(volume, "Weights") ? volume : nullptr;
  this->has_handles_ = has_handles;
  this->compared_ = nullptr;
  this->panel_->set_comparison(QString());
  vtkDataArray* weights = surface ? surface->GetPointData()->GetArray("Weights") : nullptr;
  this->panel_->set_columns(names_of(weights));
  this->view_->set_data(weights ? surface : nullptr, this->volume_);
  this->show_position();
  this->update_panel_state();
  this->update();
}

void WeightInspection::set_active(bool active)
{
  this->active_ = active;
  this->update();
}

void WeightInspection::choose_column(int column)
{
  if (this->active_ && column >= 0)
  {
    this->panel_->choose_column(column);
  }
}

int WeightInspection::surface_appearance() const
{
  return this->view_->is_sliced() ? view::Viewport::see_through : view::Viewport::solid;
}

void WeightInspection::show_position()
{
  const auto [lowest, highest] = this->view_->plane()->positions();
  this->panel_->set_position(this->view_->plane()->position(), lowest, highest);
}

void WeightInspection::update_panel_state()
{
  WeightPanel::State state;
  state.has_weights = has_point_array(this->surface_, "Weights");
  state.has_raw_weights = has_point_array(this->surface_, "RawWeights");
  state.has_handles = this->has_handles_;
  state.has_volume = this->volume_ != nullptr;
  state.has_picture = this->viewport_->has_picture();
  state.has_texture = this->viewport_->has_texture();
  state.comparing = this->job_.is_running();
  state.compared = this->compared_ != nullptr;
  state.method = method_of_weights(this->surface_);
  this->panel_->set_state(state);
}

/// Show the data that the panel requests.
void WeightInspection::update()
{
  const bool shown = this->active_ && has_point_array(this->surface_, "Weights");
  const int column = this->panel_->column();
  const int quantity = this->panel_->quantity();
  if (shown)
  {
    PictureOptions options;
    if (quantity == WeightPanel::row_sums)
    {
      options.color_by = ColorBy::row_sum;
    }
    else if (column < 0 && quantity == WeightPanel::weights)
    {
      options.color_by = ColorBy::handle;
    }
    else
    {
      options.array = this->panel_->raw() ? "RawWeights" : "Weights";
      options.component = std::to_string(std::max(column, 0));
    }
    options.subtracted_data = quantity == WeightPanel::difference ? this->compared_ : nullptr;
    options.bands = this->panel_->bands();
    options.isolines = this->panel_->isolines();
    options.extrema = this->panel_->extrema();
    options.slice = this->panel_->slice();
    const Status status = this->view_->show(options);
    if (!status.ok())
    {
      Q_EMIT this->failed(
        tr("Cannot show the weights: %1.").arg(QString::fromStdString(status.message)));
    }
    else
    {
      Q_EMIT this->succeeded();
    }
  }
  else
  {
    this->view_->hide();
  }
  this->panel_->set_certificate(this->certificate(quantity == WeightPanel::row_sums ? -1 : column));
  this->panel_->set_extrema(this->view_->is_shown() && this->panel_->extrema()
      ? format_counts(this->view_->extrema())
      : QString());
  if (this->view_->is_shown() && quantity == WeightPanel::difference)
  {
    const Report& numbers = this->view_->numbers();
    this->panel_->set_comparison(
      tr("Difference from %1 (%2 s): largest %3, rms %4")
        .arg(this->compared_method_)
        .arg(this->compared_seconds_, 0, 'f', 1)
        .arg(short_number(numbers.number("picture.difference.largest", 0.0)))
        .arg(short_number(numbers.number("picture.difference.rms", 0.0))));
  }
  if (this->sliced_ != this->view_->is_sliced() || this->view_->is_sliced())
  {
    this->sliced_ = this->view_->is_sliced();
    Q_EMIT this->surface_look_changed();
  }
}

/// Return a text about the optimality certificate of a column. Certificates are field arrays of the
/// surface. If `column` is -1, the text contains the worst values of all columns.
QString WeightInspection::certificate(int column) const
{
  vtkFieldData* fields = this->surface_ ? this->surface_->GetFieldData() : nullptr;
  const auto value = [&](const char* name)
  {
    vtkDataArray* array = fields ? fields->GetArray(name) : nullptr;
    double worst = -1.0;
    for (vtkIdType c = 0; array && c < array->GetNumberOfTuples(); ++c)
    {
      if (column < 0 || c == column)
      {
        worst = std::max(worst, array->GetComponent(c, 0));
      }
    }
    return worst;
  };
  const double gap = value("WeightsRelativeGap");
  const double residual = value("WeightsKKTResidual");
  if (gap < 0.0 || residual < 0.0)
  {
    return has_point_array(this->surface_, "Weights")
      ? tr("The accuracy of these weights is unknown.")
      : tr("There are no weights yet.");
  }
  const int method = method_of_weights(this->surface_);
  QString text = method < 0 ? tr("Weights of the mesh:\n")
                            : tr("%1 weights:\n").arg(name_of(weight_methods()[method].label));
  text += (column < 0 ? tr("Worst gap %1, residual %2\n") : tr("Gap %1, residual %2\n"))
            .arg(short_number(gap), short_number(residual));
  const double iterations = value("WeightsIterations");
  if (iterations >= 0.0)
  {
    text += tr("%1 iterations").arg(iterations, 0, 'f', 0);
  }
  return text;
}

// ---- Another method ----------------------------------------------------------------------------

void WeightInspection::compare(int method)
{
  BindInput input;
  if (this->job_.is_running() || !this->make_input_(input))
  {
    return;
  }
  const WeightMethod& other = weight_methods()[method];
  this->method_ = name_of(other.short_label);
  input.method = &other;
  input.preview = false;
  // Use the domain of the existing weights, if it is known.
  const std::string domain = read_report(this->surface_).text("domain");
  for (const WeightsDomain candidate :
    { WeightsDomain::surface, WeightsDomain::volume, WeightsDomain::embedding })
  {
    input.domain = domain == to_string(candidate) ? candidate : input.domain;
  }
  this->job_.start(std::move(input));
  this->panel_->set_comparison(tr("Starting …"));
  this->update_panel_state();
}

void WeightInspection::comparison_finished()
{
  const BindResult& result = this->job_.result();
  this->update_panel_state();
  const bool fits = this->surface_ && result.weights.rows() == this->surface_->GetNumberOfPoints();
  if (result.status.code == StatusCode::canceled || (result.status.usable() && !fits))
  {
    this->panel_->set_comparison(
      this->compared_ ? tr("Canceled; the last comparison is kept.") : tr("Canceled."));
    return;
  }
  if (!result.status.usable())
  {
    this->panel_->set_comparison(QString());
    Q_EMIT this->failed(
      tr("Cannot compare: %1.").arg(QString::fromStdString(result.status.message)));
    return;
  }
  Handles handles(static_cast<std::size_t>(result.weights.cols()));
  const QStringList names = names_of(this->surface_->GetPointData()->GetArray("Weights"));
  for (std::size_t k = 0; k < handles.size(); ++k)
  {
    handles[k].name = names.value(static_cast<int>(k)).toStdString();
  }
  this->compared_ = vtkSmartPointer<vtkPolyData>::New();
  this->compared_->CopyStructure(this->surface_);
  add_weights(result, handles, this->compared_);
  this->compared_method_ = this->method_;
  this->compared_seconds_ = result.status.report.number("seconds.total", 0.0);
  // If the weights of all handles were displayed, choose the column in which the weights of the two
  // methods differ most.
  if (this->panel_->column() < 0)
  {
    const auto surface_weights = to_matrix(this->surface_->GetPointData()->GetArray("Weights"));
    Index column = 0;
    (surface_weights.view() - result.weights).cwiseAbs().colwise().maxCoeff().maxCoeff(&column);
    this->panel_->choose_column(static_cast<int>(column));
  }
  this->update_panel_state();
  this->panel_->show_quantity(WeightPanel::difference);
}

} // namespace app::weights
