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
  aim, ///< turn an arm about the pivot toward the mouse
  scale,
  stretch, ///< lengthen an arm from the pivot
  reach ///< aim and stretch, so that the arm's end is under the mouse
};

/// The type, the positions and the constraint of a drag.
struct DragSetup
{
  DragKind kind = DragKind::move;
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero(); ///< center of turns and scales
  Eigen::Vector3d grabbed = Eigen::Vector3d::Zero(); ///< moves are along a plane or line through it
  Eigen::Vector3d arm = Eigen::Vector3d::Zero(); ///< aim, stretch, reach: vector from the pivot to
                                                 ///< the end of the arm
  /// Axes of the constraint as columns, and a mask of the free axes (bits 1, 2, 4). With all axes
  /// (7), a move is in the plane that faces the camera, a turn is about the viewing direction, and
  /// a scale is uniform. With two axes, a turn is about the third.
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  int axes = 7;
  double ring_pixels = 80.0; ///< mouse motion, in pixels, that turns a ring seen from the side by 1
                             ///< radian
  double length_step = 0.0; ///< 0: moves do not snap
  double degree_step = 15.0;
  double factor_step = 0.1;
};

/// The result of a drag at the current mouse position.
struct DragMotion
{
  Eigen::Affine3d motion = Eigen::Affine3d::Identity(); ///< motion in world coordinates since the
                                                        ///< start of the drag
  double amount = 0.0; ///< length of a move, degrees of a turn, factor of a scale or stretch
  double factor = 1.0; ///< stretch, reach: factor on the arm's length; not part of the motion
};

/// The mathematics of one drag. The input is display positions, the output a motion in world
/// coordinates. The class is independent of handles.
///
/// The drag accumulates the steps of the mouse, or a tenth of each in fine mode. So nothing jumps
/// when fine mode begins or ends. If a ray does not intersect the plane or line of the constraint
/// (at the horizon, or seen along it), the last motion is kept.
class Drag
{
public:
  Drag(const ScreenView& view, const DragSetup& setup, const Eigen::Vector2d& mouse);

  /// Follow the mouse to a new position.
  void move_to(const Eigen::Vector2d& mouse, bool fine);
  /// Change the constraint as if the drag had begun with it.
  void constrain(const Eigen::Matrix3d& frame, int axes);
  void set_snapping(bool snap) { this->snap_ = snap; }
  /// Set a number that replaces the mouse: a length along the free axis (the first of several),
  /// degrees or a factor.
  void set_typed(std::optional<double> amount) { this->typed_ = amount; }

  const DragSetup& setup() const { return this->setup_; }
  /// Return the axis of a turn, or of a move along a line.
  Eigen::Vector3d axis() const;
  /// Return the arm of a turn: a unit vector perpendicular to the axis, from the pivot to the
  /// grabbed position.
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
  Eigen::Vector2d mouse_; // last position of the real mouse
  Eigen::Vector2d start_;
  Eigen::Vector2d now_; // position after fine mode is applied
  double turned_ = 0.0; // radians
  double last_angle_ = 0.0;
  bool snap_ = false;
  std::optional<double> typed_;
  DragMotion last_;
};

} // namespace bindpose

#endif
