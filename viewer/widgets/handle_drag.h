#ifndef handle_drag_h
#define handle_drag_h

#include "screen_view.h"

#include <Eigen/Geometry>

#include <optional>

namespace bindpose
{

enum class DragKind
{
  move,
  turn,
  aim, ///< turn an arm about the pivot towards the mouse
  scale,
  stretch, ///< lengthen an arm from the pivot
  reach ///< aim and stretch: the arm's end is under the mouse
};

/// What is dragged, and how it is held.
struct DragSetup
{
  DragKind kind = DragKind::move;
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero(); ///< turned and scaled about
  Eigen::Vector3d grabbed = Eigen::Vector3d::Zero(); ///< moved along a plane or line through it
  Eigen::Vector3d arm = Eigen::Vector3d::Zero(); ///< aim, stretch, reach: from the pivot to its end
  /// Axes of the constraint as columns, and which are free: bits 1, 2, 4. With all (7) a move
  /// stays in the plane that faces the camera, a turn is about the line of sight, a scale uniform.
  /// With two a turn is about the third.
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  int axes = 7;
  double ring_pixels = 80.0; ///< the way of the mouse that turns a ring seen from the side by 1 rad
  double length_step = 0.0; ///< 0: moves do not snap
  double degree_step = 15.0;
  double factor_step = 0.1;
};

/// Where the mouse has taken it.
struct DragMotion
{
  Eigen::Affine3d motion = Eigen::Affine3d::Identity(); ///< of the world, from the drag's start
  double amount = 0.0; ///< length moved, degrees turned, factor of scale or stretch
  double factor = 1.0; ///< stretch, reach: of the arm's length; not part of the motion
};

/// The mathematics of one drag: display positions in, a motion of the world out. Knows no handle.
///
/// The mouse is followed by its steps, a tenth of each while it is fine, so that nothing jumps when
/// that begins or ends. Where a ray does not meet the plane or line it is held to (at the horizon,
/// or seen along it), the last motion stays.
class Drag
{
public:
  Drag(const ScreenView& view, const DragSetup& setup, const Eigen::Vector2d& mouse);

  /// The mouse has moved.
  void move_to(const Eigen::Vector2d& mouse, bool fine);
  /// Another constraint, as if the drag had begun with it.
  void constrain(const Eigen::Matrix3d& frame, int axes);
  void set_snapping(bool snap) { this->snap_ = snap; }
  /// A number in place of the mouse: length along the one free axis (the first where there are
  /// more), degrees, factor.
  void set_typed(std::optional<double> amount) { this->typed_ = amount; }

  const DragSetup& setup() const { return this->setup_; }
  /// The axis of a turn, or of a move along a line.
  Eigen::Vector3d axis() const;
  /// A turn: unit, across the axis, from the pivot to where the mouse grabbed.
  Eigen::Vector3d start_arm() const;
  DragMotion motion();

private:
  void restart();
  std::optional<double> along(const Eigen::Vector3d& axis, const Eigen::Vector2d& mouse) const;
  std::optional<double> angle(const Eigen::Vector2d& mouse) const;
  void follow_angle();
  DragMotion moved() const;
  DragMotion turned() const;
  DragMotion aimed() const;
  DragMotion scaled() const;
  DragMotion stretched() const;
  double snapped(double amount, double step) const;

  ScreenView view_;
  DragSetup setup_;
  Eigen::Vector2d mouse_; // the real one's last place
  Eigen::Vector2d start_;
  Eigen::Vector2d now_; // the followed one
  double turned_ = 0.0; // radians
  double last_angle_ = 0.0;
  bool snap_ = false;
  std::optional<double> typed_;
  DragMotion last_;
};

} // namespace bindpose

#endif
