// Lays out, draws and picks the gizmo: the arrows, plates, rings and boxes with which users move,
// rotate and scale a handle. The layout is defined for axes of 80 pixels and scaled to the
// requested size. Parts that point at the viewer or are seen edge-on are left out, because users
// can neither recognize nor use them. Only the half of a ring toward the camera is drawn, so that
// three rings do not look like a cage.
#include "gizmo.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace bindpose
{
namespace
{
/// Distances of the gizmo's parts from its origin, in pixels, for axes of 80 pixels. 0 means that
/// the gizmo has no such part.
struct Layout
{
  double shaft; // end of an arrow's shaft, which begins at `gap`
  double cone; // tip of an arrow's cone
  /// Center of a plate, the small square that moves the handle in the plane of two axes. The number
  /// is the coordinate of the center along each of these axes.
  double plate;
  double box; // center of a box
  double ring; // radius of the rings about the axes
  double view_ring; // radius of the ring that faces the camera
};
// One layout per GizmoKind, in the same order.
constexpr Layout layouts[5] = { {}, { 74, 92, 33, 0, 0, 0 }, { 0, 0, 0, 0, 78, 96 },
  { 76, 0, 0, 80, 0, 104 }, { 84, 102, 27, 45, 64, 124 } };
// Distance from the origin that is kept free for the ball of the handle.
constexpr double gap = 15.0;
constexpr double plate_half = 7.0;
constexpr double cone_radius = 5.6;
constexpr double box_half = 4.6;
constexpr double line_width = 2.4;
constexpr double hovered_line_width = 3.8; // thickness of a part under the mouse
constexpr double outline = 1.2;
constexpr double twist_radius = 20.0;
constexpr double stretch_from = 10.0;
constexpr double stretch_to = 30.0;
// Minimum distance between the stretch box of a bone and the tip of an arrow.
constexpr double stretch_room = 32.0;
constexpr int ring_sides = 72;
// Limits for the angle between an axis and the viewing direction. An arrow or scale box is
// drawn if |cos| is below axis_on_cosine: otherwise it points at the viewer. A plate perpendicular
// to the axis is drawn if |cos| is above plate_edge_on_cosine: otherwise it is seen edge-on. A ring
// about the axis is drawn as a full circle if sin is below ring_face_on_sine.
constexpr double axis_on_cosine = 0.985;
constexpr double plate_edge_on_cosine = 0.13;
constexpr double ring_face_on_sine = 0.3;

const char* const letters[3] = { "X", "Y", "Z" };

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b)
{
  const Vector2d segment_vector = b - a;
  const double length2 = segment_vector.squaredNorm();
  const double s =
    length2 > 0.0 ? std::clamp((p - a).dot(segment_vector) / length2, 0.0, 1.0) : 0.0;
  return (a + s * segment_vector - p).norm();
}

bool is_inside_convex(const Vector2d& p, const std::vector<Vector2d>& corners)
{
  int left = 0;
  int right = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vector2d side = corners[(k + 1) % corners.size()] - corners[k];
    const Vector2d displacement = p - corners[k];
    const double turn = side[0] * displacement[1] - side[1] * displacement[0];
    left += turn > 0.0;
    right += turn < 0.0;
  }
  return left == 0 || right == 0;
}
} // namespace

GizmoKind gizmo_with(int part, GizmoKind kind)
{
  if (kind == GizmoKind::all || part == no_part)
  {
    return kind;
  }
  if (part < turn_x)
  {
    return GizmoKind::move;
  }
  const bool is_rotation = part <= turn_view || part == twist_head || part == twist_tail;
  return is_rotation ? GizmoKind::turn : GizmoKind::scale;
}

double ring_pixels(const GizmoSetup& setup, int part)
{
  const Layout& layout = layouts[static_cast<int>(setup.kind)];
  return (part == turn_view ? layout.view_ring : layout.ring) * setup.pixels / 80.0;
}

Gizmo::Gizmo(const ScreenView& view, const GizmoSetup& setup, const GizmoMarks& marks)
  : view_(view), setup_(setup), marks_(marks)
{
  this->pixel_ = view.pixel_length_at(setup.origin);
  this->layout_scale_ = setup.pixels / 80.0;
  if (setup.kind == GizmoKind::none || !(this->pixel_ > 0.0))
  {
    return;
  }
  this->add_axes();
  if (!setup.only_moves)
  {
    this->add_rings();
    this->add_bone();
  }
  if (marks.active != no_part)
  {
    const auto others = [&](const Part& part) { return part.part != marks.active; };
    this->parts_.erase(
      std::remove_if(this->parts_.begin(), this->parts_.end(), others), this->parts_.end());
    this->add_drag();
  }
}

Vector3d Gizmo::at(int axis, double pixels) const
{
  return this->setup_.origin +
    pixels * this->layout_scale_ * this->pixel_ * this->setup_.frame.col(axis);
}

void Gizmo::add_axes()
{
  const bool only_moves = this->setup_.only_moves;
  const GizmoKind kind =
    only_moves && (this->setup_.kind == GizmoKind::all || this->setup_.kind == GizmoKind::move)
    ? GizmoKind::move
    : this->setup_.kind;
  if (only_moves && kind != GizmoKind::move)
  {
    return;
  }
  const Layout& layout = layouts[static_cast<int>(kind)];
  const Vector3d forward = this->view_.direction_to(this->setup_.origin);
  for (int k = 0; k < 3; ++k)
  {
    const double cosine = std::abs(this->setup_.frame.col(k).dot(forward));
    if (cosine < axis_on_cosine && layout.shaft > 0.0)
    {
      Part arrow;
      arrow.color = this->setup_.axes[k];
      arrow.path = { this->at(k, gap), this->at(k, layout.shaft) };
      arrow.thickness = line_width;
      arrow.rank = 2;
      arrow.label = letters[k];
      arrow.part = layout.cone > 0.0 ? move_x + k : scale_x + k;
      if (layout.cone > 0.0)
      {
        arrow.cone = { this->at(k, layout.shaft), this->at(k, layout.cone) };
        arrow.cone_radius = cone_radius;
      }
      Part box = arrow;
      if (layout.box > 0.0)
      {
        box.box = { this->at(k, layout.box) };
        box.box_half = box_half;
        box.part = scale_x + k;
      }
      if (layout.cone > 0.0)
      {
        this->parts_.push_back(arrow);
        box.path.clear();
        box.cone.clear();
        box.label.clear();
      }
      if (layout.box > 0.0)
      {
        box.rank = 0;
        this->parts_.push_back(box);
      }
    }
    if (cosine > plate_edge_on_cosine && layout.plate > 0.0)
    {
      Part plate;
      plate.part = move_yz + k;
      plate.rank = 1;
      plate.color = this->setup_.axes[k];
      const Vector3d u = this->setup_.frame.col((k + 1) % 3) * this->layout_scale_ * this->pixel_;
      const Vector3d v = this->setup_.frame.col((k + 2) % 3) * this->layout_scale_ * this->pixel_;
      for (const auto& [a, b] : { std::pair{ -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } })
      {
        plate.plate.push_back(this->setup_.origin + (layout.plate + a * plate_half) * u +
          (layout.plate + b * plate_half) * v);
      }
      this->parts_.push_back(plate);
    }
  }
}

Gizmo::Part Gizmo::ring(
  int part, const Vector3d& center, const Vector3d& axis, double pixels, bool is_full_circle) const
{
  Part ring;
  ring.part = part;
  ring.rank = 3;
  ring.thickness = line_width;
  const double radius = pixels * this->layout_scale_ * this->pixel_;
  const Vector3d forward = this->view_.direction_to(center);
  // Begin the ring on the side away from the camera, so that the half in front is one polyline.
  Vector3d u = forward - axis * axis.dot(forward);
  is_full_circle = is_full_circle || u.norm() < ring_face_on_sine;
  u = u.norm() > 1e-6 ? Vector3d(u.normalized()) : axis.unitOrthogonal();
  const Vector3d v = axis.cross(u);
  for (int side = 0; side <= ring_sides; ++side)
  {
    const double angle = 2.0 * EIGEN_PI * side / ring_sides;
    if (is_full_circle || std::cos(angle) < 0.06)
    {
      ring.path.push_back(center + radius * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  return ring;
}

void Gizmo::add_rings()
{
  const Layout& layout = layouts[static_cast<int>(this->setup_.kind)];
  const Vector3d& origin = this->setup_.origin;
  for (int k = 0; k < 3 && layout.ring > 0.0; ++k)
  {
    Part ring = this->ring(turn_x + k, origin, this->setup_.frame.col(k), layout.ring,
      this->marks_.active == turn_x + k);
    ring.color = this->setup_.axes[k];
    if (this->marks_.hovered == ring.part)
    {
      ring.label = letters[k];
    }
    this->parts_.push_back(ring);
  }
  if (layout.view_ring > 0.0)
  {
    const bool scales = this->setup_.kind == GizmoKind::scale;
    Part ring = this->ring(scales ? scale_all : turn_view, origin,
      -this->view_.direction_to(origin), layout.view_ring, true);
    ring.color = this->setup_.plain;
    ring.rank = 4;
    ring.omits_outline = true;
    ring.thickness = 1.8;
    if (scales || this->setup_.kind == GizmoKind::all)
    {
      Part knob = ring;
      knob.part = scale_all;
      knob.rank = 0;
      const Vector3d corner = (this->view_.right() + this->view_.up()).normalized();
      knob.box = { origin + layout.view_ring * this->layout_scale_ * this->pixel_ * corner };
      knob.box_half = box_half;
      if (!scales)
      {
        knob.path.clear();
        this->parts_.push_back(ring);
      }
      else
      {
        knob.rank = 4;
      }
      this->parts_.push_back(knob);
    }
    else
    {
      this->parts_.push_back(ring);
    }
  }
}

void Gizmo::add_bone()
{
  if (!this->setup_.tail || (*this->setup_.tail - this->setup_.origin).norm() == 0.0)
  {
    return;
  }
  const Vector3d& head = this->setup_.origin;
  const Vector3d& tail = *this->setup_.tail;
  const Vector3d axis = (tail - head).normalized();
  const GizmoKind kind = this->setup_.kind;
  if (kind == GizmoKind::scale || kind == GizmoKind::all)
  {
    Part knob;
    knob.part = stretch_bone;
    knob.color = this->setup_.bone;
    const double pixel = this->layout_scale_ * this->pixel_;
    // Move the stretch box farther out if the tip of an arrow is near it.
    double out = stretch_to;
    const auto is_arrow_tip_near = [&]()
    {
      const Vector2d at = this->view_.to_display(tail + out * pixel * axis).head<2>();
      return std::any_of(this->parts_.begin(), this->parts_.end(),
        [&](const Part& part)
        {
          const Vector3d* tip = !part.cone.empty() ? &part.cone[1]
            : !part.box.empty()                    ? &part.box[0]
                                                   : nullptr;
          return tip &&
            (this->view_.to_display(*tip).head<2>() - at).norm() <
            stretch_room * this->layout_scale_;
        });
    };
    for (int step = 0; step < 8 && is_arrow_tip_near(); ++step)
    {
      out += 0.5 * stretch_room;
    }
    knob.path = { tail + stretch_from * pixel * axis, tail + out * pixel * axis };
    knob.box = { knob.path[1] };
    knob.box_half = box_half;
    knob.thickness = line_width;
    this->parts_.push_back(knob);
  }
  if (kind == GizmoKind::turn || kind == GizmoKind::all)
  {
    const bool separate_rings = this->setup_.two_twist_rings;
    for (const int part : { twist_head, twist_tail })
    {
      if (part == twist_head && !separate_rings)
      {
        continue;
      }
      const double fraction = !separate_rings ? 0.5 : part == twist_head ? 0.3 : 0.7;
      Part ring = this->ring(
        part, head + fraction * (tail - head), axis, twist_radius, this->marks_.active == part);
      ring.rank = 0;
      ring.color = this->setup_.bone;
      this->parts_.push_back(ring);
    }
  }
}

/// Add guide lines for the dragged part: a long line along each axis to which a move or a scale is
/// constrained, or the two lines of a rotation (see GizmoMarks::spokes).
void Gizmo::add_drag()
{
  const int part = this->marks_.active;
  const auto line = [&](const Vector3d& from, const Vector3d& to, const Color& color)
  {
    Part guide;
    guide.part = part;
    guide.guide = true;
    guide.path = { from, to };
    guide.thickness = 1.4;
    guide.color = color;
    this->parts_.push_back(guide);
  };
  const double far = 30.0;
  const bool moves = part >= move_x && part <= move_z;
  if (moves || (part >= scale_x && part <= scale_z))
  {
    const int k = part - (moves ? move_x : scale_x);
    line(this->at(k, -far * 80.0), this->at(k, far * 80.0), this->setup_.axes[k]);
  }
  if (part >= move_yz && part <= move_xy)
  {
    for (const int k : { (part - move_yz + 1) % 3, (part - move_yz + 2) % 3 })
    {
      line(this->at(k, -far * 80.0), this->at(k, far * 80.0), this->setup_.axes[k]);
    }
  }
  for (const std::optional<Vector3d>& spoke : this->marks_.spokes)
  {
    if (spoke)
    {
      line(this->setup_.origin, *spoke, this->setup_.plain);
    }
  }
}

int Gizmo::pick(const Vector2d& mouse, double tolerance) const
{
  int best = no_part;
  std::tuple<int, double, double> best_order{ 9, 0.0, 0.0 };
  for (const Part& part : this->parts_)
  {
    if (part.guide)
    {
      continue;
    }
    const auto keep_if_best = [&](int rank, double distance, const Vector3d& position)
    {
      const std::tuple<int, double, double> order{ rank, distance,
        this->view_.to_display(position)[2] };
      if (order < best_order)
      {
        best = part.part;
        best_order = order;
      }
    };
    for (std::size_t i = 0; i + 1 < part.path.size(); ++i)
    {
      const double distance =
        distance_to_segment(mouse, this->view_.to_display(part.path[i]).head<2>(),
          this->view_.to_display(part.path[i + 1]).head<2>());
      if (distance <= 0.5 * part.thickness * this->layout_scale_ + tolerance)
      {
        keep_if_best(part.rank, distance, part.path[i]);
      }
    }
    for (const Vector3d& box : part.box)
    {
      const double distance = (this->view_.to_display(box).head<2>() - mouse).norm();
      if (distance <= part.box_half * this->layout_scale_ + tolerance)
      {
        keep_if_best(0, distance, box);
      }
    }
    if (!part.cone.empty())
    {
      const double distance =
        distance_to_segment(mouse, this->view_.to_display(part.cone[0]).head<2>(),
          this->view_.to_display(part.cone[1]).head<2>());
      if (distance <= part.cone_radius * this->layout_scale_ + 0.5 * tolerance)
      {
        keep_if_best(0, distance, part.cone[1]);
      }
    }
    if (!part.plate.empty())
    {
      std::vector<Vector2d> corners;
      Vector3d middle = Vector3d::Zero();
      for (const Vector3d& corner : part.plate)
      {
        corners.emplace_back(this->view_.to_display(corner).head<2>());
        middle += 0.25 * corner;
      }
      if (is_inside_convex(mouse, corners))
      {
        keep_if_best(part.rank, (this->view_.to_display(middle).head<2>() - mouse).norm(), middle);
      }
    }
  }
  return best;
}

void Gizmo::draw(HandleShapes& solid, HandleShapes& hull) const
{
  const Color dark = { 0.13, 0.13, 0.15 };
  for (const Part& part : this->parts_)
  {
    const bool is_highlighted =
      !part.guide && (part.part == this->marks_.hovered || part.part == this->marks_.active);
    // Show the part under the mouse larger and lighter. A mixture with more white would no longer
    // show the color of the axis.
    Color color = part.color;
    for (double& c : color)
    {
      c += is_highlighted ? 0.35 * (1.0 - c) : 0.0;
    }
    const double pixel = this->layout_scale_ * this->pixel_;
    const double highlight_scale = is_highlighted ? 1.25 : 1.0;
    const double margin = outline * pixel;
    const double tube = 0.5 * pixel *
      (is_highlighted ? std::max(hovered_line_width, part.thickness) : part.thickness);
    if (part.path.size() > 1)
    {
      solid.add_tube(part.path, tube, color);
      if (!part.guide && !(part.omits_outline && !is_highlighted))
      {
        hull.add_tube(part.path, tube + margin, dark);
      }
    }
    for (const Vector3d& box : part.box)
    {
      const double half = highlight_scale * part.box_half * pixel;
      Eigen::Matrix3d frame = this->setup_.frame;
      if (part.part == scale_all || part.part == stretch_bone)
      {
        frame << this->view_.right(), this->view_.up(), -this->view_.forward();
      }
      solid.add_box(box, frame, Vector3d::Constant(half), color);
      hull.add_box(box, frame, Vector3d::Constant(half + margin), dark);
    }
    if (!part.cone.empty())
    {
      const double radius = highlight_scale * part.cone_radius * pixel;
      const Vector3d axis = (part.cone[1] - part.cone[0]).normalized();
      solid.add_cone(part.cone[0], part.cone[1], radius, color);
      hull.add_cone(part.cone[0] - margin * axis, part.cone[1] + 2.5 * margin * axis,
        radius + 1.3 * margin, dark);
    }
    if (!part.plate.empty())
    {
      const Vector3d middle =
        0.25 * (part.plate[0] + part.plate[1] + part.plate[2] + part.plate[3]);
      Eigen::Matrix3d frame;
      frame.col(0) = (part.plate[1] - part.plate[0]).normalized();
      frame.col(1) = (part.plate[3] - part.plate[0]).normalized();
      frame.col(2) = frame.col(0).cross(frame.col(1));
      const double half = 0.5 * highlight_scale * (part.plate[1] - part.plate[0]).norm();
      solid.add_box(middle, frame, Vector3d(half, half, 0.6 * pixel), color);
      hull.add_box(
        middle, frame, Vector3d(half + margin, half + margin, 0.6 * pixel + margin), dark);
    }
  }
}

std::vector<Gizmo::Label> Gizmo::labels() const
{
  std::vector<Label> labels;
  const Vector2d origin = this->view_.to_display(this->setup_.origin).head<2>();
  for (const Part& part : this->parts_)
  {
    if (part.label.empty())
    {
      continue;
    }
    const Vector3d tip = !part.cone.empty() ? part.cone[1]
      : !part.box.empty()                   ? part.box[0]
                                            : part.path[part.path.size() / 2];
    const Vector2d display = this->view_.to_display(tip).head<2>();
    Vector2d label_direction = display - origin;
    label_direction =
      label_direction.norm() > 0.0 ? Vector2d(label_direction.normalized()) : Vector2d(1.0, 0.0);
    labels.push_back({ part.label,
      display + (part.cone.empty() ? 18.0 : 12.0) * this->layout_scale_ * label_direction,
      part.color });
  }
  return labels;
}

std::optional<Vector2d> Gizmo::grip(int part_id) const
{
  for (const Part& part : this->parts_)
  {
    if (part.part != part_id || part.guide)
    {
      continue;
    }
    Vector3d position;
    if (!part.box.empty())
    {
      position = part.box[0];
    }
    else if (!part.cone.empty())
    {
      position = 0.5 * (part.cone[0] + part.cone[1]);
    }
    else if (!part.plate.empty())
    {
      position = 0.5 * (part.plate[0] + part.plate[2]);
    }
    else
    {
      // Do not use the middle of the drawn arc, because another ring may cross the arc there.
      position = part.path[part.path.size() * 2 / 5];
    }
    return Vector2d(this->view_.to_display(position).head<2>());
  }
  return std::nullopt;
}

} // namespace bindpose
