// Draws the ghost, the shape of the compared method, over the shape of the current method or in the
// right half of a split view. Both halves share one camera, so that rotating one half rotates the
// other.
#include "app/posing/pose_ghost.h"

#include "app/view/viewport.h"

#include "pictures/tile_actors.h"
#include "scene/colors.h"
#include "shapes/moved_surface_mapper.h"
#include "shapes/outline.h"
#include "shapes/shaded_surface.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCommand.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTexture.h"

namespace app::posing
{

namespace
{
constexpr bindpose::Rgb ghost_color{ 0.20, 0.50, 0.76 };
constexpr double ghost_opacity = 0.38;
/// Distance from the current shape at which the ghost reaches its maximum opacity, in bounding-box
/// diagonals.
constexpr double opaque_distance = 0.02;
constexpr const char* distance_name = "bindpose.Distance";
} // namespace

PoseGhost::PoseGhost(view::Viewport* viewport) : viewport_(viewport)
{
  this->actor_->SetMapper(this->mapper_);
  this->actor_->PickableOff();
  this->mapper_->ScalarVisibilityOff();
  this->mapper_->SetScalarModeToUsePointFieldData();
  this->mapper_->SetColorModeToMapScalars();
  this->mapper_->SelectColorArray(distance_name);
  this->mapper_->UseLookupTableScalarRangeOn();
  constexpr int steps = 64;
  this->opacity_table_->SetNumberOfTableValues(steps);
  this->opacity_table_->SetTableRange(0.0, opaque_distance);
  for (int k = 0; k < steps; ++k)
  {
    this->opacity_table_->SetTableValue(
      k, ghost_color[0], ghost_color[1], ghost_color[2], k / (steps - 1.0));
  }
  this->mapper_->SetLookupTable(this->opacity_table_);
  // If points have moved only within the surface, the ghost is visible, because its points differ
  // from those of the current shape. But both surfaces have the same depth. Draw the current shape
  // in front.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  this->mapper_->SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0);
  this->distances_->SetName(distance_name);
  bindpose::use_surface_material(this->actor_);
  bindpose::add_lights(this->renderer_);
  vtkRenderer* first = viewport->renderer();
  this->renderer_->SetActiveCamera(first->GetActiveCamera());
  this->outline_ = std::make_unique<bindpose::Outline>(this->renderer_);
  this->renderer_->GradientBackgroundOn();
  this->renderer_->SetViewport(0.5, 0.0, 1.0, 1.0);
  for (vtkRenderer* half : { first, this->renderer_.Get() })
  {
    half->AddObserver(
      vtkCommand::ResetCameraClippingRangeEvent, this, &PoseGhost::clipping_range_changed);
  }
}

PoseGhost::~PoseGhost() = default;

void PoseGhost::set_surface(vtkPolyData* surface)
{
  this->surface_ = surface;
  if (surface && this->shaded_ && this->shaded_->has_same_mesh(surface))
  {
    this->shaded_->set_arrays(surface);
  }
  else
  {
    this->mapper_->SetInputData(nullptr);
    this->outline_->set_shape(nullptr);
    this->shaded_ = nullptr;
    this->make_shape();
  }
  this->update();
}

/// Create `shaded_`, from which the ghost is drawn. A hidden ghost does not need it.
void PoseGhost::make_shape()
{
  if (this->surface_ && !this->shaded_ && this->is_drawn())
  {
    this->shaded_ = std::make_unique<bindpose::ShadedSurface>(this->surface_);
    this->mapper_->SetInputData(this->shaded_->polydata());
    this->outline_->set_shape(this->shaded_.get());
  }
}

void PoseGhost::set_display_mode(
  DisplayMode mode, bindpose::PointsView points, bindpose::PointsView first)
{
  this->display_mode_ = mode;
  this->make_shape();
  this->move(points, first); // must precede update(), which fits the view to the moved points
  this->update();
}

void PoseGhost::move(bindpose::PointsView points, bindpose::PointsView first)
{
  if (this->shaded_ && this->is_drawn() && points.rows() > 0)
  {
    if (this->display_mode_ == beside)
    {
      this->match_first_shape();
    }
    else
    {
      this->update_opacities(points, first);
    }
    this->viewport_->move_shape(*this->shaded_, points);
  }
}

/// Make the ghost transparent where it coincides with the current shape. Otherwise round-off would
/// determine for each pixel which of the two surfaces is visible.
void PoseGhost::update_opacities(bindpose::PointsView points, bindpose::PointsView first)
{
  if (points.rows() != first.rows())
  {
    return;
  }
  const double scale = 1.0 / this->surface_->GetLength();
  const std::vector<bindpose::Index>& drawn = this->shaded_->input_points();
  this->distances_->SetNumberOfValues(static_cast<vtkIdType>(drawn.size()));
  double* distance = this->distances_->GetPointer(0);
  for (const bindpose::Index point : drawn)
  {
    *distance++ = scale * (points.row(point) - first.row(point)).norm();
  }
  this->distances_->Modified();
  this->shaded_->polydata()->GetPointData()->AddArray(this->distances_);
}

/// In the right half of a split view, draw the ghost with the same picture or outlines as the
/// current shape. (Both halves show meshes without the materials of their files.)
void PoseGhost::match_first_shape()
{
  vtkTexture* picture = this->viewport_->surface_actor()->GetTexture();
  const bindpose::Rgb& color = picture ? bindpose::palette::white : bindpose::palette::surface;
  vtkProperty* property = this->actor_->GetProperty();
  bindpose::set_color(property, color);
  property->SetLighting(!picture);
  this->actor_->SetTexture(picture);
  this->actor_->SetForceOpaque(picture != nullptr);
  this->outline_->show(this->viewport_->has_outlines() && !picture,
    bindpose::outline_width * this->viewport_->devicePixelRatioF());
}

void PoseGhost::update()
{
  const DisplayMode mode = this->shaded_ && this->is_drawn() ? this->display_mode_ : hidden;
  vtkRenderWindow* window = this->viewport_->renderWindow();
  this->viewport_->renderer()->RemoveActor(this->actor_);
  this->renderer_->RemoveActor(this->actor_);
  this->mapper_->SetScalarVisibility(mode == over);
  vtkProperty* property = this->actor_->GetProperty();
  if (mode == over)
  {
    bindpose::set_color(property, ghost_color);
    property->SetOpacity(ghost_opacity);
    property->LightingOn();
    this->actor_->SetTexture(nullptr);
    this->actor_->ForceOpaqueOff();
    this->viewport_->renderer()->AddActor(this->actor_);
  }
  else if (mode == beside)
  {
    property->SetOpacity(1.0);
    this->match_first_shape();
    this->renderer_->AddActor(this->actor_);
  }
  const bool is_beside = mode == beside;
  if (is_beside != this->is_renderer_added_)
  {
    this->is_renderer_added_ = is_beside;
    if (is_beside)
    {
      window->AddRenderer(this->renderer_);
    }
    else
    {
      window->RemoveRenderer(this->renderer_);
    }
  }
  this->viewport_->set_split(
    is_beside ? this->renderer_.Get() : nullptr, is_beside ? this->shaded_->polydata() : nullptr);
  this->viewport_->set_ghosted(mode == over);
}

/// Called when one half of the split view has set the clipping range of the shared camera. Set a
/// range that contains the shapes in both halves.
void PoseGhost::clipping_range_changed()
{
  if (this->display_mode_ != beside || this->is_updating_clipping_)
  {
    return;
  }
  this->is_updating_clipping_ = true;
  vtkBoundingBox both;
  for (vtkRenderer* half : { this->viewport_->renderer(), this->renderer_.Get() })
  {
    double bounds[6];
    half->ComputeVisiblePropBounds(bounds);
    both.AddBounds(bounds);
  }
  if (both.IsValid())
  {
    double bounds[6];
    both.GetBounds(bounds);
    this->renderer_->ResetCameraClippingRange(bounds);
  }
  this->is_updating_clipping_ = false;
}

} // namespace app::posing
