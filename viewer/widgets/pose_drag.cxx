// Converts a drag of the mouse to poses. Each grabbed part has its own type of drag. Balls, bodies
// and heads move in the plane that faces the camera. A tail rotates its bone toward the mouse; with
// `reach` it also stretches the bone. The names of the gizmo's parts state their effects. If a
// handle is in mode position, every drag moves the handle, whatever part is grabbed.
#include "pose_drag.h"

#include "pose/transform_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace bindpose
{
namespace
{
bool is_twist(int part)
{
  return part == twist_head || part == twist_tail;
}

DragKind kind_of_part(int part, bool reach)
{
  if (part == static_cast<int>(HandlePart::tail))
  {
    return reach ? DragKind::reach : DragKind::aim;
  }
  if ((part >= turn_x && part <= turn_view) || is_twist(part))
  {
    return DragKind::turn;
  }
  if (part >= scale_x && part <= scale_all)
  {
    return DragKind::scale;
  }
  return part == stretch_bone ? DragKind::stretch : DragKind::move;
}

/// Report whether a part affects only the grabbed handle, not all selected handles.
bool affects_one_handle(int part)
{
  return part == static_cast<int>(HandlePart::tail) || part >= stretch_bone;
}

Matrix3d axes_in(bool local, const HandleRecord& record)
{
  return local ? posed_axes(record) : Matrix3d(Matrix3d::Identity());
}

DragSetup setup_of(const HandleRecord& record, int part, const DragSettings& settings)
{
  DragSetup setup;
  const bool on_tail = part == static_cast<int>(HandlePart::tail);
  setup.kind = record.only_moves() ? DragKind::move : kind_of_part(part, settings.reach);
  setup.pivot = setup.grabbed = record.head;
  setup.arm = record.tail - record.head;
  if (part == static_cast<int>(HandlePart::body))
  {
    setup.grabbed = 0.5 * (record.head + record.tail);
  }
  else if (on_tail || part == stretch_bone)
  {
    setup.grabbed = record.tail;
  }
  setup.frame = axes_in(settings.local_space, record);
  setup.axes = axes_of_part(part);
  if (is_twist(part))
  {
    // Rotate about the axis of the bone, which is the y axis of this frame.
    setup.frame = minimal_rotation(Vector3d::UnitY(), setup.arm).toRotationMatrix();
    setup.axes = 2;
  }
  setup.ring_pixels = settings.ring_pixels;
  setup.length_step = settings.length_step;
  setup.degree_step = settings.degree_step;
  setup.factor_step = settings.factor_step;
  return setup;
}
} // namespace

int axes_of_part(int part)
{
  const auto is_in_group = [&](int first) { return part >= first && part < first + 3; };
  if (is_in_group(move_yz))
  {
    return 7 ^ (1 << (part - move_yz));
  }
  for (const int first : { move_x, turn_x, scale_x })
  {
    if (is_in_group(first))
    {
      return 1 << (part - first);
    }
  }
  return 7;
}

PoseDrag::PoseDrag(const ScreenView& view, std::vector<HandleRecord> records, int part,
  const std::vector<vtkIdType>& grabbed, const Vector2d& mouse, const DragSettings& settings)
  : start_part_(part), records_(std::move(records)),
    group_(make_group(this->records_,
      affects_one_handle(part) ? std::vector<vtkIdType>{ grabbed.front() } : grabbed,
      settings.with_descendants)),
    settings_(settings),
    drag_(view, setup_of(this->records_[static_cast<std::size_t>(grabbed.front())], part, settings),
      mouse)
{
}

std::vector<HandleData::CellPose> PoseDrag::poses()
{
  const DragMotion result = this->drag_.motion();
  GrabbedChange change;
  change.factor = result.factor;
  change.writes_arrays = this->settings_.writes_bone_arrays;
  Eigen::Affine3d motion = result.motion;
  if (is_twist(this->start_part_) && this->drag_.setup().kind == DragKind::turn)
  {
    motion.setIdentity();
    change.twist[this->start_part_ == twist_head && change.writes_arrays ? 0 : 1] = result.amount;
  }
  return moved_poses(this->records_, this->group_, motion, change);
}

void PoseDrag::press_axis(int axis, bool plane)
{
  if (is_twist(this->start_part_) || this->drag_.setup().kind == DragKind::stretch)
  {
    return; // these drags have their own axis, which cannot be changed
  }
  const int axes = plane ? 7 ^ (1 << axis) : 1 << axis;
  this->axis_presses_ = axes == this->pressed_axes_ ? (this->axis_presses_ + 1) % 3 : 1;
  this->pressed_axes_ = axes;
  const HandleRecord& record = this->records_[static_cast<std::size_t>(this->group_.cells.front())];
  const bool local = this->settings_.local_space == (this->axis_presses_ == 1);
  this->drag_.constrain(axes_in(local, record), this->axis_presses_ == 0 ? 7 : axes);
}

bool PoseDrag::type(char key)
{
  if ((key >= '0' && key <= '9') ||
    (key == '.' && this->typed_text_.find('.') == std::string::npos))
  {
    this->typed_text_ += key;
  }
  else if (key == '-')
  {
    const bool negative = !this->typed_text_.empty() && this->typed_text_[0] == '-';
    this->typed_text_ = negative ? this->typed_text_.substr(1) : "-" + this->typed_text_;
  }
  else if (key == 'b' && !this->typed_text_.empty())
  {
    this->typed_text_.pop_back();
  }
  else
  {
    return false;
  }
  const bool number = this->typed_text_.find_first_of("0123456789") != std::string::npos;
  this->drag_.set_typed_amount(
    number ? std::optional<double>(std::strtod(this->typed_text_.c_str(), nullptr)) : std::nullopt);
  return true;
}

const char* PoseDrag::name() const
{
  switch (this->drag_.setup().kind)
  {
    case DragKind::turn:
      return is_twist(this->start_part_) ? "twist" : "turn";
    case DragKind::aim:
      return "turn";
    case DragKind::scale:
      return "scale";
    case DragKind::stretch:
    case DragKind::reach:
      return "stretch";
    case DragKind::move:
      break;
  }
  return "move";
}

std::string PoseDrag::text()
{
  const DragSetup& setup = this->drag_.setup();
  char number[64];
  const double amount = this->drag_.motion().amount;
  const bool degrees = setup.kind == DragKind::turn || setup.kind == DragKind::aim;
  std::snprintf(number, sizeof(number), degrees ? "%.1f°" : "%.4g", amount);
  std::string text = this->typed_text_.empty() ? number : this->typed_text_ + (degrees ? "°" : "");
  if (setup.axes != 7 && !is_twist(this->start_part_))
  {
    text = " " + text;
    for (int k = 2; k >= 0; --k)
    {
      if ((setup.axes >> k) & 1)
      {
        text = "XYZ"[k] + text;
      }
    }
  }
  return text;
}

int PoseDrag::part() const
{
  const DragSetup& setup = this->drag_.setup();
  if (is_twist(this->start_part_) || setup.kind == DragKind::stretch)
  {
    return this->start_part_;
  }
  int axis = -1;
  for (int k = 0; k < 3; ++k)
  {
    if (setup.axes == 1 << k || setup.axes == (7 ^ (1 << k)))
    {
      axis = k;
    }
  }
  const bool plane = setup.axes == (7 ^ (1 << std::max(axis, 0)));
  switch (setup.kind)
  {
    case DragKind::move:
      return axis < 0 ? no_part : (plane ? move_yz : move_x) + axis;
    case DragKind::turn:
      return axis < 0 ? turn_view : turn_x + axis;
    case DragKind::scale:
      return axis < 0 || plane ? scale_all : scale_x + axis;
    default:
      return no_part;
  }
}

std::array<std::optional<Vector3d>, 2> PoseDrag::spokes(double radius)
{
  std::array<std::optional<Vector3d>, 2> spokes;
  const DragSetup& setup = this->drag_.setup();
  if (setup.kind == DragKind::turn && !is_twist(this->start_part_))
  {
    const Vector3d from = radius * this->drag_.start_arm();
    spokes[0] = setup.pivot + from;
    spokes[1] = setup.pivot + this->drag_.motion().motion.linear() * from;
  }
  return spokes;
}

} // namespace bindpose
