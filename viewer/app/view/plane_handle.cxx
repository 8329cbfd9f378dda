// A plane that the mouse moves and rotates, implemented with VTK's implicit plane widget. The plane
// that the widget draws is nearly transparent; it exists only so that the mouse can grab it.
#include "app/view/plane_handle.h"

#include "app/view/viewport.h"

#include "scene/colors.h"

#include "vtkCommand.h"
#include "vtkImplicitPlaneRepresentation.h"
#include "vtkImplicitPlaneWidget2.h"
#include "vtkProperty.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkWidgetEventTranslator.h"

#include <QKeyEvent>

#include <algorithm>
#include <cmath>

namespace app::view
{

using bindpose::Vec3;

namespace
{
void set_color_and_opacity(vtkProperty* property, const bindpose::Rgb& color, double opacity = 1.0)
{
  bindpose::set_color(property, color);
  property->SetOpacity(opacity);
}
} // namespace

PlaneHandle::PlaneHandle(Viewport* viewport, QObject* parent) : QObject(parent), viewport_(viewport)
{
  vtkRenderer* renderer = viewport->renderer();
  this->plane_->SetPlaceFactor(1.0);
  this->plane_->TubingOff();
  this->plane_->OutlineTranslationOff();
  this->plane_->ScaleEnabledOff();
  this->plane_->CropPlaneToBoundingBoxOn();
  this->plane_->SetEdgeColor(
    bindpose::palette::line[0], bindpose::palette::line[1], bindpose::palette::line[2]);
  set_color_and_opacity(this->plane_->GetOutlineProperty(), bindpose::palette::edges);
  set_color_and_opacity(this->plane_->GetSelectedOutlineProperty(), bindpose::palette::edges);
  // Draw the plane nearly transparent. The mouse cannot grab a fully transparent plane.
  set_color_and_opacity(this->plane_->GetPlaneProperty(), bindpose::palette::white, 0.005);
  set_color_and_opacity(this->plane_->GetSelectedPlaneProperty(), bindpose::palette::white, 0.005);
  this->widget_->SetInteractor(viewport->interactor());
  this->widget_->SetRepresentation(this->plane_);
  this->widget_->SetCurrentRenderer(renderer);
  this->widget_->SetDefaultRenderer(renderer);
  // This priority is lower than the default of VTK's widgets, so that handles receive mouse events
  // first.
  this->widget_->SetPriority(0.4F);
  // Remove the middle and right mouse buttons from the widget. They then move and zoom the camera.
  for (const unsigned long event :
    { vtkCommand::MiddleButtonPressEvent, vtkCommand::MiddleButtonReleaseEvent,
      vtkCommand::RightButtonPressEvent, vtkCommand::RightButtonReleaseEvent })
  {
    this->widget_->GetEventTranslator()->RemoveTranslation(event);
  }
  this->widget_->AddObserver(vtkCommand::StartInteractionEvent, this, &PlaneHandle::drag_began);
  this->widget_->AddObserver(vtkCommand::InteractionEvent, this, &PlaneHandle::drag_continued);
  this->widget_->AddObserver(vtkCommand::EndInteractionEvent, this, &PlaneHandle::drag_ended);
  viewport->installEventFilter(this);
}

PlaneHandle::~PlaneHandle()
{
  this->widget_->SetInteractor(nullptr);
}

void PlaneHandle::set_box(const bindpose::Box& box)
{
  this->cancel();
  this->box_ = box;
  if (!box.empty())
  {
    double bounds[6];
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = box.lower[axis];
      bounds[2 * axis + 1] = box.upper[axis];
    }
    this->plane_->PlaceWidget(bounds);
  }
  this->apply_relative_position();
}

void PlaneHandle::draw_box(bool drawn)
{
  this->plane_->SetDrawOutline(drawn);
}

void PlaneHandle::show(bool shown)
{
  if (!shown)
  {
    this->cancel();
  }
  this->shown_ = shown;
  this->place_widget();
}

void PlaneHandle::set_orientation(int orientation)
{
  this->cancel();
  this->state_.orientation = orientation;
  if (orientation != free_plane)
  {
    this->state_.free_normal = Vec3::Unit(orientation);
  }
  this->apply_relative_position();
  Q_EMIT this->moved();
}

void PlaneHandle::set_free_normal(const Vec3& normal)
{
  this->cancel();
  this->state_.free_normal = normal;
  if (this->state_.orientation == free_plane)
  {
    this->apply_relative_position();
    Q_EMIT this->moved();
  }
}

void PlaneHandle::set_relative_position(double relative_position)
{
  this->cancel();
  this->state_.relative_position = relative_position;
  this->apply_relative_position();
  Q_EMIT this->moved();
}

void PlaneHandle::set_position(double position)
{
  this->cancel();
  // Ignore changes up to `round_off`. Otherwise setting the current position again could change the
  // relative position.
  constexpr double round_off = 1e-12;
  const double relative_position = this->to_relative_position(position);
  if (std::abs(relative_position - this->state_.relative_position) > round_off)
  {
    this->state_.relative_position = relative_position;
    this->state_.origin += (position - this->position()) * this->normal();
    this->place_widget();
  }
  Q_EMIT this->moved();
}

Vec3 PlaneHandle::normal() const
{
  return this->state_.orientation == free_plane ? this->state_.free_normal
                                                : Vec3(Vec3::Unit(this->state_.orientation));
}

double PlaneHandle::to_relative_position(double position) const
{
  const auto [first, last] = this->positions();
  return last > first ? std::clamp((position - first) / (last - first), 0.0, 1.0)
                      : this->state_.relative_position;
}

/// Move the plane to its relative position. Its arrow is drawn at the point of the plane that is
/// nearest to the center of the box.
void PlaneHandle::apply_relative_position()
{
  const auto [first, last] = this->positions();
  const Vec3 middle = this->box_.empty() ? Vec3(Vec3::Zero()) : this->box_.center();
  const Vec3 normal = this->normal();
  const double position = first + this->state_.relative_position * (last - first);
  this->state_.origin = middle + (position - middle.dot(normal)) * normal;
  this->place_widget();
}

std::pair<double, double> PlaneHandle::positions() const
{
  if (this->box_.empty())
  {
    return { 0.0, 1.0 };
  }
  std::pair<double, double> range{ 1e300, -1e300 };
  const Vec3 normal = this->normal();
  const Vec3 ends[2] = { this->box_.lower, this->box_.upper };
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 corner_position(
      ends[corner & 1].x(), ends[corner >> 1 & 1].y(), ends[corner >> 2 & 1].z());
    range.first = std::min(range.first, corner_position.dot(normal));
    range.second = std::max(range.second, corner_position.dot(normal));
  }
  return range;
}

/// Update the widget from the plane. The widget can be rotated only if the plane is free.
void PlaneHandle::place_widget()
{
  const int orientation = this->state_.orientation;
  const bool can_rotate = orientation == free_plane;
  this->plane_->SetNormalToXAxis(orientation == x_axis);
  this->plane_->SetNormalToYAxis(orientation == y_axis);
  this->plane_->SetNormalToZAxis(orientation == z_axis);
  this->plane_->SetNormal(this->normal().data());
  this->plane_->SetOrigin(this->state_.origin.data());
  const bindpose::Rgb arrow{ 0.17, 0.42, 0.66 }; // the accent color of the window
  set_color_and_opacity(this->plane_->GetNormalProperty(), arrow, can_rotate ? 1.0 : 0.0);
  set_color_and_opacity(
    this->plane_->GetSelectedNormalProperty(), bindpose::palette::line, can_rotate ? 1.0 : 0.0);
  this->widget_->SetEnabled(this->shown_ && !this->box_.empty());
}

// ---- The mouse ---------------------------------------------------------------------------------

void PlaneHandle::mouse_ray(Vec3& ray_origin, Vec3& ray_direction) const
{
  int event_position[2];
  this->viewport_->interactor()->GetEventPosition(event_position);
  this->viewport_->ray_at(event_position[0], event_position[1], ray_origin, ray_direction);
}

void PlaneHandle::drag_began()
{
  this->state_before_drag_ = this->state_;
  this->dragged_ = true;
  const Vec3 normal = this->normal();
  Vec3 ray_origin;
  Vec3 ray_direction;
  this->mouse_ray(ray_origin, ray_direction);
  const double cosine = ray_direction.dot(normal);
  this->grabbed_point_ = std::abs(cosine) > 1e-6
    ? Vec3(ray_origin + (this->position() - ray_origin.dot(normal)) / cosine * ray_direction)
    : this->state_.origin;
}

/// Compute the plane from the mouse. VTK's widget moves the plane by the motion of the mouse along
/// the projected normal, which is inaccurate if the normal is nearly parallel to the view
/// direction. Instead, this function moves the grabbed point along the normal to the point that is
/// nearest to the ray through the mouse.
void PlaneHandle::drag_continued()
{
  const bool pushed =
    this->plane_->GetInteractionState() == vtkImplicitPlaneRepresentation::Pushing;
  const double before = this->position();
  this->plane_->GetOrigin(this->state_.origin.data());
  if (this->state_.orientation == free_plane)
  {
    this->plane_->GetNormal(this->state_.free_normal.data());
  }
  const Vec3 normal = this->normal();
  const auto [first, last] = this->positions();
  double position = this->position();
  if (pushed)
  {
    Vec3 ray_origin;
    Vec3 ray_direction;
    this->mouse_ray(ray_origin, ray_direction);
    const double cosine = ray_direction.dot(normal);
    const double sine_squared = 1.0 - cosine * cosine;
    // If the view direction is nearly parallel to the normal, keep the widget's result.
    if (sine_squared > 0.01)
    {
      const Vec3 gap = ray_origin - this->grabbed_point_;
      position = this->grabbed_point_.dot(normal) +
        (gap.dot(normal) - gap.dot(ray_direction) * cosine) / sine_squared;
    }
  }
  position = std::isfinite(position) ? std::clamp(position, first, last) : before;
  this->state_.origin += (position - this->position()) * normal;
  this->state_.relative_position = this->to_relative_position(position);
  this->plane_->SetOrigin(this->state_.origin.data());
  Q_EMIT this->moved();
}

void PlaneHandle::drag_ended()
{
  if (!this->dragged_)
  {
    return; // the drag was canceled
  }
  this->dragged_ = false;
  const bool turned = this->state_.free_normal != this->state_before_drag_.free_normal;
  if (turned || this->state_.relative_position != this->state_before_drag_.relative_position)
  {
    Q_EMIT this->dragged(turned);
  }
}

void PlaneHandle::cancel()
{
  if (this->dragged_)
  {
    this->dragged_ = false;
    this->state_ = this->state_before_drag_;
    // Simulate the release of the button, because the widget has no function to end a drag.
    this->viewport_->interactor()->LeftButtonReleaseEvent();
    this->place_widget();
    Q_EMIT this->moved();
  }
}

bool PlaneHandle::eventFilter(QObject* watched, QEvent* event)
{
  const bool key = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
  if (key && this->dragged_ && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape)
  {
    if (event->type() == QEvent::KeyPress)
    {
      this->cancel();
    }
    // Accept the event. Otherwise Esc would also trigger the window's shortcut that leaves the edit
    // mode.
    event->accept();
    return true;
  }
  return QObject::eventFilter(watched, event);
}

} // namespace app::view
