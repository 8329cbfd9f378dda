// Shows a volume of winding numbers in the 3D view: as a colored slice with a contour line, as an
// isosurface and as a cloud (volume rendering). PlaneHandle moves and rotates the plane of the
// slice.
#include "app/volume/volume_view.h"

#include "app/view/viewport.h"

#include "scene/colors.h"
#include "scene/volume.h"
#include "scene/volume_rendering.h"
#include "shapes/shaded_surface.h"

#include "vtkActor.h"
#include "vtkContourFilter.h"
#include "vtkLookupTable.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>

namespace app::volume
{

using bindpose::Vec3;

namespace
{
constexpr const char* array_name = "WindingNumber";

} // namespace

VolumeView::VolumeView(view::Viewport* viewport)
  : QObject(viewport), viewport_(viewport), plane_(new view::PlaneHandle(viewport, this))
{
  vtkRenderer* renderer = viewport->renderer();
  const bindpose::ColorMap map = bindpose::winding_map();
  this->slice_mapper_->SetScalarModeToUsePointFieldData();
  this->slice_mapper_->SelectColorArray(array_name);
  this->slice_mapper_->SetColorModeToMapScalars();
  this->slice_mapper_->InterpolateScalarsBeforeMappingOn();
  this->slice_mapper_->SetLookupTable(map.table);
  this->slice_mapper_->UseLookupTableScalarRangeOn();
  // Draw the contour in front of the slice, which has the same depth.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  this->slice_mapper_->SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0);
  this->slice_actor_->SetMapper(this->slice_mapper_);
  this->slice_actor_->GetProperty()->LightingOff();
  this->contour_mapper_->ScalarVisibilityOff();
  this->contour_actor_->SetMapper(this->contour_mapper_);
  this->contour_actor_->GetProperty()->LightingOff();
  bindpose::set_color(this->contour_actor_->GetProperty(), bindpose::palette::line);
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

  QObject::connect(this->plane_, &view::PlaneHandle::moved, this,
    [this]
    {
      this->update_slice();
      Q_EMIT this->slice_moved();
    });
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
  if (image)
  {
    double bounds[6];
    image->GetBounds(bounds);
    bindpose::Box box;
    box.add(Vec3(bounds[0], bounds[2], bounds[4]));
    box.add(Vec3(bounds[1], bounds[3], bounds[5]));
    this->viewport_->set_extra_bounds(box);
    this->plane_->set_box(box);
  }
  else
  {
    this->viewport_->set_extra_bounds(bindpose::Box());
  }
  this->update();
  Q_EMIT this->volume_changed();
}

void VolumeView::set_active(bool active)
{
  if (active != this->active_)
  {
    this->active_ = active;
    this->update();
  }
}

void VolumeView::update()
{
  this->viewport_->show_legend(view::Viewport::volume_legend,
    this->is_active() ? tr("Winding number w") : QString(), bindpose::winding_map());
  this->plane_->show(this->is_slice_shown());
  this->update_slice();
  this->update_isosurface();
  this->update_cloud();
  Q_EMIT this->shown_changed();
}

// ---- Slice -------------------------------------------------------------------------------------

void VolumeView::show_slice(bool shown)
{
  this->slice_shown_ = shown;
  this->update();
}

void VolumeView::update_slice()
{
  const bool shown = this->is_slice_shown();
  this->slice_actor_->SetVisibility(shown);
  this->contour_actor_->SetVisibility(shown);
  if (shown)
  {
    // If the slice is on the border of the volume, move the slice slightly inside. VTK's flying
    // edges filter finds no cell exactly on the border.
    const auto [first, last] = this->positions();
    const double clamped_position =
      std::clamp(this->position(), first + 1e-6 * (last - first), last - 1e-6 * (last - first));
    const Vec3 normal = this->slice_normal();
    const Vec3 origin = this->slice_origin() + (clamped_position - this->position()) * normal;
    const auto cut = bindpose::slice(this->image_, array_name, origin, normal);
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
  this->update();
}

void VolumeView::set_level(double level)
{
  this->level_ = level;
  this->update_isosurface();
}

void VolumeView::update_isosurface()
{
  const bool shown = this->is_active() && this->isosurface_shown_;
  this->isosurface_->Initialize();
  if (shown)
  {
    this->isosurface_->ShallowCopy(bindpose::isosurface(this->image_, array_name, this->level_));
    this->isosurface_mapper_->SetInputData(this->isosurface_);
    bindpose::set_color(
      this->isosurface_actor_->GetProperty(), bindpose::winding_color(this->level_));
    Q_EMIT this->area_changed(bindpose::surface_area(this->isosurface_));
  }
  this->isosurface_actor_->SetVisibility(shown && this->isosurface_->GetNumberOfPolys() > 0);
  this->viewport_->refresh();
}

void VolumeView::show_cloud(bool shown)
{
  this->cloud_shown_ = shown;
  this->update();
}

void VolumeView::update_cloud()
{
  if (this->is_cloud_shown() && !this->cloud_)
  {
    this->cloud_ = bindpose::make_winding_volume(this->image_, array_name, 0.0);
    this->cloud_->PickableOff();
    this->viewport_->renderer()->AddVolume(this->cloud_);
  }
  if (this->cloud_)
  {
    this->cloud_->SetVisibility(this->is_cloud_shown());
  }
  this->viewport_->refresh();
}

} // namespace app::volume
