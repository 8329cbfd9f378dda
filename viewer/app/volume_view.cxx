// VTK's plane widget moves and turns the plane; the slice itself, its colours and its contour are
// drawn here. The widget's own plane is all but invisible: it is there to be caught by the mouse.
#include "volume_view.h"

#include "viewport.h"

#include "scene/colours.h"
#include "scene/shaded_surface.h"
#include "scene/volume.h"
#include "scene/volume_rendering.h"

#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkContourFilter.h"
#include "vtkImplicitPlaneRepresentation.h"
#include "vtkImplicitPlaneWidget2.h"
#include "vtkLookupTable.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkWidgetEventTranslator.h"

#include <algorithm>
#include <cmath>

using bindpose::Vec3;

namespace
{
constexpr const char* array_name = "WindingNumber";

void colour(vtkProperty* property, const bindpose::Rgb& rgb, double opacity)
{
  property->SetColor(rgb[0], rgb[1], rgb[2]);
  property->SetOpacity(opacity);
}
} // namespace

VolumeView::VolumeView(Viewport* viewport) : QObject(viewport), viewport_(viewport)
{
  vtkRenderer* renderer = viewport->renderer();
  const bindpose::ColourMap map = bindpose::winding_map();
  this->slice_mapper_->SetScalarModeToUsePointFieldData();
  this->slice_mapper_->SelectColorArray(array_name);
  this->slice_mapper_->SetColorModeToMapScalars();
  this->slice_mapper_->InterpolateScalarsBeforeMappingOn();
  this->slice_mapper_->SetLookupTable(map.table);
  this->slice_mapper_->UseLookupTableScalarRangeOn();
  // The contour lies in the slice and must win against it.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  this->slice_mapper_->SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0);
  this->slice_actor_->SetMapper(this->slice_mapper_);
  this->slice_actor_->GetProperty()->LightingOff();
  this->contour_mapper_->ScalarVisibilityOff();
  this->contour_actor_->SetMapper(this->contour_mapper_);
  this->contour_actor_->GetProperty()->LightingOff();
  colour(this->contour_actor_->GetProperty(), bindpose::palette::line, 1.0);
  this->isosurface_mapper_->ScalarVisibilityOff();
  this->isosurface_actor_->SetMapper(this->isosurface_mapper_);
  bindpose::use_surface_material(this->isosurface_actor_);
  this->isosurface_actor_->GetProperty()->SetAmbient(0.14);
  this->isosurface_actor_->GetProperty()->SetDiffuse(0.76);
  for (vtkActor* actor :
    { this->slice_actor_.Get(), this->contour_actor_.Get(), this->isosurface_actor_.Get() })
  {
    actor->VisibilityOff();
    actor->PickableOff();
    renderer->AddActor(actor);
  }

  this->plane_->SetPlaceFactor(1.0);
  this->plane_->TubingOff();
  this->plane_->OutlineTranslationOff();
  this->plane_->ScaleEnabledOff();
  this->plane_->CropPlaneToBoundingBoxOn();
  this->plane_->SetEdgeColor(
    bindpose::palette::line[0], bindpose::palette::line[1], bindpose::palette::line[2]);
  colour(this->plane_->GetOutlineProperty(), bindpose::palette::edges, 1.0);
  colour(this->plane_->GetSelectedOutlineProperty(), bindpose::palette::edges, 1.0);
  // Not quite clear: what is clear cannot be caught.
  colour(this->plane_->GetPlaneProperty(), bindpose::palette::white, 0.005);
  colour(this->plane_->GetSelectedPlaneProperty(), bindpose::palette::white, 0.005);
  this->widget_->SetInteractor(viewport->interactor());
  this->widget_->SetRepresentation(this->plane_);
  this->widget_->SetCurrentRenderer(renderer);
  this->widget_->SetDefaultRenderer(renderer);
  this->widget_->SetPriority(0.4F); // handles lie before it
  // The other buttons move and zoom the view, here as everywhere.
  for (const unsigned long event :
    { vtkCommand::MiddleButtonPressEvent, vtkCommand::MiddleButtonReleaseEvent,
      vtkCommand::RightButtonPressEvent, vtkCommand::RightButtonReleaseEvent })
  {
    this->widget_->GetEventTranslator()->RemoveTranslation(event);
  }
  this->widget_->AddObserver(vtkCommand::StartInteractionEvent, this, &VolumeView::widget_caught);
  this->widget_->AddObserver(vtkCommand::InteractionEvent, this, &VolumeView::widget_moved);
  viewport->interactor()->AddObserver(
    vtkCommand::MouseMoveEvent, this, &VolumeView::mouse_moved, 1.0F);
  viewport->interactor()->AddObserver(vtkCommand::LeaveEvent, this, &VolumeView::mouse_left, 1.0F);
}

VolumeView::~VolumeView()
{
  this->widget_->SetInteractor(nullptr);
}

void VolumeView::set_volume(vtkImageData* image, double lowest, double highest)
{
  this->image_ = image;
  this->lowest_ = lowest;
  this->highest_ = highest;
  if (this->cloud_)
  {
    this->viewport_->renderer()->RemoveVolume(this->cloud_);
    this->cloud_ = nullptr;
  }
  this->viewport_->show_winding_legend(image != nullptr);
  if (image)
  {
    double bounds[6];
    image->GetBounds(bounds);
    bindpose::Box box;
    box.add(Vec3(bounds[0], bounds[2], bounds[4]));
    box.add(Vec3(bounds[1], bounds[3], bounds[5]));
    this->viewport_->set_also_shown(box);
    this->plane_->PlaceWidget(bounds);
    this->origin_ = box.center();
  }
  else
  {
    this->viewport_->set_also_shown(bindpose::Box());
    this->mouse_left();
  }
  this->set_orientation(this->orientation_);
  this->update_isosurface();
  this->show_cloud(this->cloud_shown_);
  Q_EMIT this->volume_changed();
}

Vec3 VolumeView::center() const
{
  return this->image_ ? Vec3(this->image_->GetCenter()) : Vec3::Zero();
}

// ---- Slice -------------------------------------------------------------------------------------

void VolumeView::show_slice(bool shown)
{
  this->slice_shown_ = shown;
  this->place_widget();
  this->update_slice();
}

void VolumeView::set_orientation(int orientation)
{
  this->orientation_ = orientation;
  if (orientation != free_plane)
  {
    this->normal_ = Vec3::Unit(orientation);
  }
  this->place_widget();
  this->update_slice();
}

void VolumeView::set_position(double position)
{
  this->origin_ += (position - this->position()) * this->normal_;
  this->place_widget();
  this->update_slice();
}

std::pair<double, double> VolumeView::positions() const
{
  if (!this->image_)
  {
    return { 0.0, 1.0 };
  }
  double bounds[6];
  this->image_->GetBounds(bounds);
  std::pair<double, double> range{ 1e300, -1e300 };
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 place(
      bounds[corner & 1], bounds[2 + (corner >> 1 & 1)], bounds[4 + (corner >> 2 & 1)]);
    range.first = std::min(range.first, place.dot(this->normal_));
    range.second = std::max(range.second, place.dot(this->normal_));
  }
  return range;
}

/// The widget stands where the slice is, and can be turned only when that is wanted.
void VolumeView::place_widget()
{
  const bool turns = this->orientation_ == free_plane;
  this->plane_->SetNormalToXAxis(this->orientation_ == x_axis);
  this->plane_->SetNormalToYAxis(this->orientation_ == y_axis);
  this->plane_->SetNormalToZAxis(this->orientation_ == z_axis);
  this->plane_->SetNormal(this->normal_.data());
  this->plane_->SetOrigin(this->origin_.data());
  const bindpose::Rgb arrow{ 0.17, 0.42, 0.66 }; // the window's accent
  colour(this->plane_->GetNormalProperty(), arrow, turns ? 1.0 : 0.0);
  colour(this->plane_->GetSelectedNormalProperty(), bindpose::palette::line, turns ? 1.0 : 0.0);
  this->widget_->SetEnabled(this->image_ && this->slice_shown_);
}

void VolumeView::widget_caught()
{
  int at[2];
  this->viewport_->interactor()->GetEventPosition(at);
  Vec3 from;
  Vec3 along;
  this->ray_at(at[0], at[1], from, along);
  const double slope = along.dot(this->normal_);
  this->grip_ = std::abs(slope) > 1e-6
    ? Vec3(from + (this->position() - from.dot(this->normal_)) / slope * along)
    : this->origin_;
}

/// The widget pushes its plane by the mouse's way along the normal as the picture shows it, which
/// is little when one looks along the normal. Here the place that the mouse has caught follows it:
/// to the point of its line along the normal that is nearest to the mouse's ray.
void VolumeView::widget_moved()
{
  const bool pushed =
    this->plane_->GetInteractionState() == vtkImplicitPlaneRepresentation::Pushing;
  const double before = this->position();
  this->plane_->GetOrigin(this->origin_.data());
  this->plane_->GetNormal(this->normal_.data());
  if (pushed)
  {
    int at[2];
    this->viewport_->interactor()->GetEventPosition(at);
    Vec3 from;
    Vec3 along;
    this->ray_at(at[0], at[1], from, along);
    const double slope = along.dot(this->normal_);
    const double steep = 1.0 - slope * slope;
    double position = this->position();
    if (steep > 0.01) // else the normal is seen as a point: the widget's way is as good as any
    {
      const Vec3 gap = from - this->grip_;
      position =
        this->grip_.dot(this->normal_) + (gap.dot(this->normal_) - gap.dot(along) * slope) / steep;
    }
    const auto [first, last] = this->positions();
    position = std::isfinite(position) ? std::clamp(position, first, last) : before;
    this->origin_ += (position - this->position()) * this->normal_;
    this->plane_->SetOrigin(this->origin_.data());
  }
  this->update_slice();
  Q_EMIT this->slice_moved();
}

void VolumeView::update_slice()
{
  const bool shown = this->image_ && this->slice_shown_;
  this->slice_actor_->SetVisibility(shown);
  this->contour_actor_->SetVisibility(shown);
  if (shown)
  {
    // On the volume's very border flying edges find no cell to cut.
    const auto [first, last] = this->positions();
    const double inside =
      std::clamp(this->position(), first + 1e-6 * (last - first), last - 1e-6 * (last - first));
    const Vec3 origin = this->origin_ + (inside - this->position()) * this->normal_;
    const auto cut = bindpose::slice(this->image_, array_name, origin, this->normal_);
    this->slice_mapper_->SetInputData(cut);
    vtkNew<vtkContourFilter> contour;
    contour->SetInputData(cut);
    contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array_name);
    contour->SetValue(0, 0.5);
    contour->ComputeScalarsOff();
    contour->Update();
    this->contour_mapper_->SetInputData(contour->GetOutput());
    this->contour_actor_->GetProperty()->SetLineWidth(
      static_cast<float>(1.6 * this->viewport_->devicePixelRatioF()));
  }
  this->viewport_->refresh();
}

// ---- Isosurface and cloud ----------------------------------------------------------------------

void VolumeView::show_isosurface(bool shown)
{
  this->isosurface_shown_ = shown;
  this->update_isosurface();
}

void VolumeView::set_level(double level)
{
  this->level_ = level;
  this->update_isosurface();
}

void VolumeView::update_isosurface()
{
  const bool shown = this->image_ && this->isosurface_shown_;
  this->isosurface_->Initialize();
  if (shown)
  {
    this->isosurface_->ShallowCopy(bindpose::isosurface(this->image_, array_name, this->level_));
    this->isosurface_mapper_->SetInputData(this->isosurface_);
    colour(this->isosurface_actor_->GetProperty(), bindpose::winding_colour(this->level_), 1.0);
    Q_EMIT this->area_changed(bindpose::surface_area(this->isosurface_));
  }
  this->isosurface_actor_->SetVisibility(shown && this->isosurface_->GetNumberOfPolys() > 0);
  this->viewport_->refresh();
}

void VolumeView::show_cloud(bool shown)
{
  this->cloud_shown_ = shown;
  if (shown && this->image_ && !this->cloud_)
  {
    this->cloud_ = bindpose::make_winding_volume(this->image_, array_name, 0.0);
    this->cloud_->PickableOff();
    this->viewport_->renderer()->AddVolume(this->cloud_);
  }
  if (this->cloud_)
  {
    this->cloud_->SetVisibility(shown);
  }
  this->viewport_->refresh();
}

// ---- Reading -----------------------------------------------------------------------------------

/// The points that a pixel shows: from the near clipping plane on, along a unit vector.
void VolumeView::ray_at(int x, int y, Vec3& from, Vec3& along) const
{
  vtkRenderer* renderer = this->viewport_->renderer();
  const auto world = [&](double depth)
  {
    renderer->SetDisplayPoint(x + 0.5, y + 0.5, depth);
    renderer->DisplayToWorld();
    return Vec3(Eigen::Map<const Eigen::Vector4d>(renderer->GetWorldPoint()).hnormalized());
  };
  from = world(0.0);
  along = (world(1.0) - from).normalized();
}

bool VolumeView::read_at(int x, int y, Vec3& place, double& value) const
{
  if (!this->image_ || !this->slice_shown_)
  {
    return false;
  }
  Vec3 from;
  Vec3 along;
  this->ray_at(x, y, from, along);
  const double slope = along.dot(this->normal_);
  if (std::abs(slope) < 1e-9)
  {
    return false; // seen edge-on
  }
  const double way = (this->position() - from.dot(this->normal_)) / slope;
  place = from + way * along;
  if (way < 0.0 || !bindpose::value_at(this->image_, array_name, place, value))
  {
    return false;
  }
  vtkRenderer* renderer = this->viewport_->renderer();
  renderer->SetDisplayPoint(x + 0.5, y + 0.5, renderer->GetZ(x, y));
  renderer->DisplayToWorld();
  const Vec3 seen = Eigen::Map<const Eigen::Vector4d>(renderer->GetWorldPoint()).hnormalized();
  return way - (seen - from).dot(along) < 0.005 * this->image_->GetLength();
}

void VolumeView::mouse_moved()
{
  if (!this->image_)
  {
    return;
  }
  int at[2];
  this->viewport_->interactor()->GetEventPosition(at);
  Vec3 place;
  double value = 0.0;
  Q_EMIT this->reading_changed(this->read_at(at[0], at[1], place, value)
      ? QString("%1  %2  %3:  w = %4")
          .arg(place.x(), 0, 'g', 4)
          .arg(place.y(), 0, 'g', 4)
          .arg(place.z(), 0, 'g', 4)
          .arg(value, 0, 'f', 3)
      : QString());
}

void VolumeView::mouse_left()
{
  Q_EMIT this->reading_changed(QString());
}
