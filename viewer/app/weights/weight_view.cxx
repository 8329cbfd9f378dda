// Draws weights. Values are computed at the vertices of the surface at rest, and copied to the
// drawn points: a vertex on a sharp edge has several drawn points. When the pose changes, only the
// isolines and the balls at extrema are moved. The slice belongs to the tets at rest.
#include "app/weights/weight_view.h"

#include "app/view/viewport.h"

#include "conversion.h"
#include "scene/categories.h"
#include "scene/colors.h"
#include "shapes/tet_slice.h"

#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"

#include <algorithm>

namespace app::weights
{

using namespace bindpose;

WeightView::WeightView(view::Viewport* viewport)
  : QObject(viewport), viewport_(viewport), plane_(new view::PlaneHandle(viewport, this)),
    slice_(vtkSmartPointer<vtkPolyData>::New())
{
  vtkRenderer* renderer = viewport->renderer();
  this->slice_mapper_->SetColorModeToMapScalars();
  this->slice_mapper_->UseLookupTableScalarRangeOn();
  this->slice_mapper_->SelectColorArray(color_array_name);
  // Isolines have the same depth as the surface or slice on which they are drawn. Draw the isolines
  // in front.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  this->slice_mapper_->SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0);
  this->slice_actor_->SetMapper(this->slice_mapper_);
  this->slice_actor_->GetProperty()->LightingOff();
  for (const int part : { 0, 1 })
  {
    this->isoline_mappers_[part]->SetInputData(this->isolines_[part]);
    this->isoline_mappers_[part]->ScalarVisibilityOff();
    this->isoline_mappers_[part]->SetRelativeCoincidentTopologyLineOffsetParameters(-2.0, -2.0);
    this->isoline_actors_[part]->SetMapper(this->isoline_mappers_[part]);
    vtkProperty* property = this->isoline_actors_[part]->GetProperty();
    property->LightingOff();
    set_color(property, palette::line);
  }
  for (vtkActor* actor :
    { this->slice_actor_.Get(), this->isoline_actors_[0].Get(), this->isoline_actors_[1].Get() })
  {
    actor->VisibilityOff();
    actor->PickableOff();
    renderer->AddActor(actor);
  }
  for (const auto& actor : this->balls_.actors())
  {
    renderer->AddActor(actor);
  }
  this->balls_.face_eye(Vec3::Zero()); // hide the actors, because there are no balls yet
  renderer->AddObserver(vtkCommand::StartEvent, this, &WeightView::orient_balls);
  this->plane_->draw_box(false); // no box is needed: the surface shows the extent of the tets
  QObject::connect(this->plane_, &view::PlaneHandle::moved, this,
    [this]
    {
      this->update_slice();
      Q_EMIT this->plane_moved();
    });
}

void WeightView::set_data(vtkPolyData* surface, vtkUnstructuredGrid* volume)
{
  this->hide();
  this->surface_ = surface;
  this->shape_ = surface;
  if (volume != this->volume_)
  {
    this->volume_ = volume;
    this->plane_->set_box(volume ? bounding_box(to_points(volume).view()) : Box());
  }
}

void WeightView::move_surface(vtkPolyData* shape)
{
  this->shape_ = shape;
  if (this->shown_)
  {
    this->draw_isolines(0, this->viewport_->drawn());
    this->place_extrema();
  }
}

void WeightView::hide()
{
  this->shown_ = false;
  this->coloring_ = Coloring();
  this->extrema_.clear();
  this->volume_values_ = nullptr;
  this->viewport_->show_values(nullptr, true);
  this->viewport_->show_legend(view::Viewport::extremum_legend, QString());
  this->draw_isolines(0, nullptr);
  this->update_slice();
  this->place_extrema();
}

Status WeightView::show(const PictureOptions& options)
{
  this->hide();
  if (!this->surface_)
  {
    return Status::invalid_input("there is no surface");
  }
  const bool sliced = options.slice && this->volume_;
  const Tile tile{ sliced ? static_cast<vtkDataSet*>(this->volume_) : this->surface_, nullptr, "" };
  Status status = choose_coloring({ tile }, options, this->coloring_);
  std::vector<std::vector<Extremum>> extrema;
  if (status.ok() && options.extrema)
  {
    status = find_extrema({ tile }, this->coloring_, extrema);
  }
  if (!status.ok())
  {
    this->coloring_ = Coloring();
    return status;
  }
  this->options_ = options;
  this->options_.slice = sliced;
  this->shown_ = true;
  this->show_surface();
  if (this->options_.slice)
  {
    this->volume_values_ = vtkSmartPointer<vtkUnstructuredGrid>::New();
    this->volume_values_->CopyStructure(this->volume_);
    bool on_points = true;
    const auto values = color_values(this->volume_, this->coloring_, on_points);
    vtkDataSetAttributes* to = this->volume_values_->GetPointData();
    (on_points ? to : this->volume_values_->GetCellData())->AddArray(values);
  }
  this->update_slice();
  if (options.extrema)
  {
    this->extrema_ = extrema.front();
    ColorMap map = category_map(count_extrema(extrema));
    this->viewport_->show_legend(
      view::Viewport::extremum_legend, map.texts.empty() ? tr("No extrema") : tr("Extrema"), map);
  }
  this->place_extrema();
  return status;
}

void WeightView::show_surface()
{
  const QString name = QString::fromStdString(this->coloring_.legend_name());
  if (this->options_.slice)
  {
    this->viewport_->show_values(nullptr, true, name, this->coloring_.map);
    return; // show no colors on the surface: users would mistake them for colors of the slice
  }
  vtkPolyData* drawn = this->viewport_->drawn();
  bool on_points = true;
  vtkSmartPointer<vtkDoubleArray> values = color_values(this->surface_, this->coloring_, on_points);
  if (on_points)
  {
    const auto rest_values = values;
    values = vtkSmartPointer<vtkDoubleArray>::New();
    for (const Index v : this->viewport_->drawn_points())
    {
      values->InsertNextValue(rest_values->GetValue(v));
    }
  }
  else
  {
    values = color_values(drawn, this->coloring_, on_points); // one value per triangle
  }
  this->viewport_->show_values(values, on_points, name, this->coloring_.map);
  this->draw_isolines(0, drawn);
}

void WeightView::draw_isolines(int part, vtkPolyData* data)
{
  const bool shows_isolines =
    this->shown_ && data && this->options_.isolines && part == this->is_sliced();
  const auto lines = shows_isolines ? contour_lines(data, this->coloring_.isolines)
                                    : vtkSmartPointer<vtkPolyData>::New();
  this->isolines_[part]->ShallowCopy(lines);
  this->isoline_actors_[part]->SetVisibility(lines->GetNumberOfLines() > 0);
  this->isoline_actors_[part]->GetProperty()->SetLineWidth(
    static_cast<float>(isoline_width * this->viewport_->devicePixelRatioF()));
  this->viewport_->refresh();
}

void WeightView::update_slice()
{
  const bool shown = this->is_sliced() && this->volume_values_;
  this->plane_->show(shown);
  this->slice_actor_->SetVisibility(shown);
  if (shown)
  {
    // If the plane is at an end of the box, move the plane slightly inside. At the lower end the
    // tets only touch the plane, so the slice would be empty.
    const auto [first, last] = this->plane_->positions();
    const double clamped_position = std::clamp(
      this->plane_->position(), first + 1e-6 * (last - first), last - 1e-6 * (last - first));
    const Vec3 normal = this->plane_->normal();
    this->slice_ = slice_tets(this->volume_values_,
      this->plane_->origin() + (clamped_position - this->plane_->position()) * normal, normal);
    const bool on_points = this->slice_->GetPointData()->HasArray(color_array_name) != 0;
    if (on_points)
    {
      this->slice_mapper_->SetScalarModeToUsePointFieldData();
    }
    else
    {
      this->slice_mapper_->SetScalarModeToUseCellFieldData();
    }
    this->slice_mapper_->SetInterpolateScalarsBeforeMapping(on_points);
    this->slice_mapper_->SetLookupTable(this->coloring_.map.table);
    this->slice_mapper_->SetInputData(this->slice_);
  }
  this->draw_isolines(1, shown ? this->slice_.Get() : nullptr);
}

void WeightView::place_extrema()
{
  vtkDataSet* data = this->is_sliced() ? static_cast<vtkDataSet*>(this->volume_) : this->shape_;
  std::vector<ExtremumBalls::Marker> markers;
  for (const Extremum& extremum : this->extrema_)
  {
    markers.push_back({ Vec3(data->GetPoint(extremum.vertex)), extremum.maximum });
  }
  this->balls_.set(markers, this->surface_ ? 0.01 * this->surface_->GetLength() : 1.0);
  this->orient_balls();
  this->viewport_->refresh();
}

void WeightView::orient_balls()
{
  if (!this->extrema_.empty() || this->balls_.actors().front()->GetVisibility() ||
    this->balls_.actors().back()->GetVisibility())
  {
    this->balls_.face_eye(Vec3(this->viewport_->renderer()->GetActiveCamera()->GetPosition()));
  }
}

} // namespace app::weights
