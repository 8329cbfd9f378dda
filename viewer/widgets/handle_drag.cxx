// Converts mouse motion to a motion in world coordinates. Every type of drag compares two mouse
// positions: the position at the start and the current position (slowed down in fine mode). Each
// mouse position defines a ray from the eye.
//
// - A move in a plane is the difference between the intersections of the two rays with the plane.
// - A move along a line also uses a plane: of all planes that contain the line, the plane that
// faces
//   the camera most. Only the component along the line is kept.
// - A rotation is the angle at the pivot between the intersections of the two rays with the ring's
//   plane. Angles are summed move by move, so that several turns are counted. For a ring seen
//   edge-on, these intersections are unusable. Instead, the angle is proportional to the distance
//   that the mouse moves along the near side of the ring.
// - A scale is the ratio of distances from the pivot, on the screen or along an axis.
// - An arm (the vector from the pivot to the tail of a bone) is rotated, by the smallest rotation,
//   toward the dragged tail. The tail is dragged in the plane that faces the camera.
#include "handle_drag.h"

#include "motion_about.h"

#include "pose/transform_parts.h"

#include <algorithm>
#include <cmath>

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace bindpose
{
namespace
{
constexpr double fine_fraction = 0.1;
// Limits of |cos(angle between an axis and the viewing direction)|: above maximum_line_cosine, a
// drag along the axis has no effect; below edge_on_cosine, a ring about the axis is seen edge-on.
constexpr double maximum_line_cosine = 0.998;
constexpr double edge_on_cosine = 0.12;
constexpr double smallest_factor = 0.01;
// a scale uses a ratio of distances only if it starts farther than this from the pivot
constexpr double near_pixels = 8.0;
// near the pivot, a scale depends on the motion of the mouse: this many pixels double the size
constexpr double double_pixels = 80.0;

int count_bits(int axes)
{
  return (axes & 1) + ((axes >> 1) & 1) + ((axes >> 2) & 1);
}

/// Return the only axis in the mask, or the only axis that is not in the mask. Return -1 for masks
/// of no axis or all axes.
int single_axis(int axes)
{
  const int mask = count_bits(axes) == 2 ? 7 ^ axes : axes;
  return count_bits(mask) == 1 ? mask / 2 : -1; // 1, 2, 4: 0, 1, 2
}
} // namespace

Drag::Drag(const ScreenView& view, const DragSetup& setup, const Vector2d& mouse)
  : view_(view), setup_(setup), mouse_(mouse), start_(mouse), current_(mouse)
{
  this->restart();
}

void Drag::restart()
{
  this->rotation_angle_ = 0.0;
  this->last_angle_ = this->angle(this->start_).value_or(0.0);
  this->last_motion_ = DragMotion();
  this->follow_angle();
}

void Drag::move_to(const Vector2d& mouse, bool fine)
{
  this->current_ += (fine ? fine_fraction : 1.0) * (mouse - this->mouse_);
  this->mouse_ = mouse;
  this->follow_angle();
}

void Drag::constrain(const Matrix3d& frame, int axes)
{
  this->setup_.frame = frame;
  this->setup_.axes = axes;
  if (this->setup_.kind == DragKind::aim || this->setup_.kind == DragKind::reach)
  {
    this->setup_.kind = DragKind::turn;
  }
  this->restart();
}

Vector3d Drag::axis() const
{
  const int single = single_axis(this->setup_.axes);
  return single < 0 ? Vector3d(-this->view_.direction_to(this->setup_.pivot))
                    : Vector3d(this->setup_.frame.col(single));
}

/// Return the distance of the mouse along an axis through the grabbed position; nothing if the axis
/// points at the viewer.
std::optional<double> Drag::distance_along(const Vector3d& axis, const Vector2d& mouse) const
{
  const Vector3d& position = this->setup_.grabbed;
  const Vector3d forward = this->view_.direction_to(position);
  const Vector3d normal = forward - axis * axis.dot(forward);
  Vector3d hit;
  if (std::abs(axis.dot(forward)) > maximum_line_cosine ||
    !intersect_plane(this->view_.ray(mouse), position, normal, hit))
  {
    return std::nullopt;
  }
  return axis.dot(hit - position);
}

std::optional<double> Drag::angle(const Vector2d& mouse) const
{
  const Vector3d axis = this->axis();
  const Vector3d& pivot = this->setup_.pivot;
  const Vector3d forward = this->view_.direction_to(pivot);
  if (single_axis(this->setup_.axes) < 0)
  {
    const Vector2d displacement = mouse - this->view_.to_display(pivot).head<2>();
    return std::atan2(displacement[1], displacement[0]);
  }
  if (std::abs(axis.dot(forward)) < edge_on_cosine)
  {
    const double pixel = this->view_.pixel_length_at(pivot);
    const Vector3d near_point = pivot - this->setup_.ring_pixels * pixel * forward;
    const Vector2d displacement =
      (this->view_.to_display(near_point + pixel * axis.cross(-forward)) -
        this->view_.to_display(near_point))
        .head<2>();
    return displacement.norm() > 0.0
      ? displacement.normalized().dot(mouse - this->start_) / this->setup_.ring_pixels
      : 0.0;
  }
  Vector3d hit;
  if (!intersect_plane(this->view_.ray(mouse), pivot, axis, hit))
  {
    return std::nullopt;
  }
  const Vector3d u = axis.unitOrthogonal();
  const Vector3d v = axis.cross(u);
  return std::atan2(v.dot(hit - pivot), u.dot(hit - pivot));
}

void Drag::follow_angle()
{
  const std::optional<double> angle = this->angle(this->current_);
  if (angle)
  {
    this->rotation_angle_ += std::remainder(*angle - this->last_angle_, 2.0 * EIGEN_PI);
    this->last_angle_ = *angle;
  }
}

double Drag::snap_amount(double amount, double step) const
{
  return this->snap_ && step > 0.0 ? step * std::round(amount / step) : amount;
}

DragMotion Drag::move_motion() const
{
  const DragSetup& s = this->setup_;
  DragMotion result = this->last_motion_;
  const int bits = count_bits(s.axes);
  const int single = single_axis(s.axes);
  Vector3d displacement = Vector3d::Zero();
  if (this->typed_amount_)
  {
    const int first = (s.axes & 1) ? 0 : (s.axes & 2) ? 1 : 2;
    displacement = *this->typed_amount_ * s.frame.col(first);
  }
  else if (bits == 1)
  {
    const std::optional<double> before = this->distance_along(s.frame.col(single), this->start_);
    const std::optional<double> after = this->distance_along(s.frame.col(single), this->current_);
    if (!before || !after)
    {
      return result;
    }
    displacement = this->snap_amount(*after - *before, s.length_step) * s.frame.col(single);
  }
  else
  {
    const Vector3d normal = bits == 2 ? Vector3d(s.frame.col(single)) : this->view_.forward();
    Vector3d before;
    Vector3d after;
    if (!intersect_plane(this->view_.ray(this->start_), s.grabbed, normal, before) ||
      !intersect_plane(this->view_.ray(this->current_), s.grabbed, normal, after))
    {
      return result;
    }
    displacement = after - before;
    if (bits == 2 || (this->snap_ && s.length_step > 0.0))
    {
      Vector3d local_offset = s.frame.transpose() * displacement;
      for (int k = 0; k < 3; ++k)
      {
        // components outside of the plane are exactly 0, without round-off
        local_offset[k] =
          (s.axes >> k) & 1 ? this->snap_amount(local_offset[k], s.length_step) : 0.0;
      }
      displacement = s.frame * local_offset;
    }
  }
  result.motion = Affine3d(Eigen::Translation3d(displacement));
  result.amount = bits == 1 ? displacement.dot(s.frame.col(single)) : displacement.norm();
  return result;
}

DragMotion Drag::turn_motion() const
{
  DragMotion result;
  const double degrees = this->typed_amount_
    ? *this->typed_amount_
    : this->snap_amount(this->rotation_angle_ * 180.0 / EIGEN_PI, this->setup_.degree_step);
  result.amount = degrees;
  result.motion = motion_about(this->setup_.pivot,
    Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, this->axis().normalized()).toRotationMatrix());
  return result;
}

DragMotion Drag::aim_motion() const
{
  const DragSetup& s = this->setup_;
  DragMotion result = this->last_motion_;
  Vector3d before;
  Vector3d after;
  if (!intersect_plane(this->view_.ray(this->start_), s.grabbed, this->view_.forward(), before) ||
    !intersect_plane(this->view_.ray(this->current_), s.grabbed, this->view_.forward(), after))
  {
    return result;
  }
  const Vector3d arm = s.arm + (after - before);
  const double length = s.arm.norm();
  if (!(length > 0.0) || arm.norm() <= 1e-6 * length)
  {
    return result;
  }
  Eigen::AngleAxisd rotation(minimal_rotation(s.arm, arm));
  rotation.angle() =
    this->snap_amount(rotation.angle(), this->setup_.degree_step * EIGEN_PI / 180.0);
  result.motion = motion_about(s.pivot, rotation.toRotationMatrix());
  result.amount = rotation.angle() * 180.0 / EIGEN_PI;
  if (s.kind == DragKind::reach)
  {
    result.factor =
      std::max(this->snap_amount(arm.norm() / length, s.factor_step), smallest_factor);
    result.amount = result.factor;
  }
  return result;
}

DragMotion Drag::scale_motion() const
{
  const DragSetup& s = this->setup_;
  DragMotion result = this->last_motion_;
  double factor = 1.0;
  const Vector2d pivot = this->view_.to_display(s.pivot).head<2>();
  const double far = (this->start_ - pivot).norm();
  std::optional<double> before;
  std::optional<double> after;
  if (count_bits(s.axes) == 1)
  {
    const Vector3d axis = s.frame.col(single_axis(s.axes));
    const double offset = axis.dot(s.grabbed - s.pivot);
    before = this->distance_along(axis, this->start_);
    after = this->distance_along(axis, this->current_);
    if (before && after)
    {
      *before += offset;
      *after += offset;
    }
  }
  if (this->typed_amount_)
  {
    // A negative typed factor gives a reflection. The magnitude of the factor is at least
    // smallest_factor.
    factor = std::copysign(
      std::max(std::abs(*this->typed_amount_), smallest_factor), *this->typed_amount_);
  }
  else if (before && after &&
    std::abs(*before) > near_pixels * this->view_.pixel_length_at(s.pivot))
  {
    factor = *after / *before;
  }
  else if (far > near_pixels)
  {
    factor = (this->current_ - pivot).norm() / far;
  }
  else
  {
    factor = 1.0 + (this->current_ - this->start_).sum() * std::sqrt(0.5) / double_pixels;
  }
  if (!this->typed_amount_)
  {
    factor = std::max(this->snap_amount(factor, s.factor_step), smallest_factor);
  }
  Vector3d factors;
  for (int k = 0; k < 3; ++k)
  {
    factors[k] = (s.axes >> k) & 1 ? factor : 1.0;
  }
  result.motion = motion_about(s.pivot,
    s.axes == 7 ? Matrix3d(factor * Matrix3d::Identity())
                : Matrix3d(s.frame * factors.asDiagonal() * s.frame.transpose()));
  result.amount = factor;
  return result;
}

DragMotion Drag::stretch_motion() const
{
  const DragSetup& s = this->setup_;
  DragMotion result = this->last_motion_;
  const double length = s.arm.norm();
  if (!(length > 0.0))
  {
    return result;
  }
  const Vector3d axis = s.arm / length;
  const std::optional<double> before = this->distance_along(axis, this->start_);
  const std::optional<double> after = this->distance_along(axis, this->current_);
  if (!this->typed_amount_ && (!before || !after))
  {
    return result;
  }
  const double factor = this->typed_amount_
    ? *this->typed_amount_
    : this->snap_amount((length + *after - *before) / length, s.factor_step);
  result.factor = std::max(factor, smallest_factor);
  result.amount = result.factor;
  return result;
}

Vector3d Drag::start_arm() const
{
  const Vector3d axis = this->axis().normalized();
  Vector3d hit;
  const Vector3d forward = this->view_.direction_to(this->setup_.pivot);
  if (std::abs(axis.dot(forward)) < edge_on_cosine ||
    !intersect_plane(this->view_.ray(this->start_), this->setup_.pivot, axis, hit))
  {
    hit = this->setup_.pivot - forward;
  }
  const Vector3d arm = hit - this->setup_.pivot;
  const Vector3d across = arm - axis * axis.dot(arm);
  return across.norm() > 0.0 ? Vector3d(across.normalized()) : axis.unitOrthogonal();
}

DragMotion Drag::motion()
{
  switch (this->setup_.kind)
  {
    case DragKind::move:
      this->last_motion_ = this->move_motion();
      break;
    case DragKind::turn:
      this->last_motion_ = this->turn_motion();
      break;
    case DragKind::aim:
    case DragKind::reach:
      this->last_motion_ = this->typed_amount_ ? this->turn_motion() : this->aim_motion();
      break;
    case DragKind::scale:
      this->last_motion_ = this->scale_motion();
      break;
    case DragKind::stretch:
      this->last_motion_ = this->stretch_motion();
      break;
  }
  return this->last_motion_;
}

} // namespace bindpose
