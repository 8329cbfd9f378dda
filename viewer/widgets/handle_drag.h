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
  aim, ///< rotate an arm (from the pivot to a bone's tail) about the pivot toward the mouse
  scale,
  stretch, ///< lengthen an arm from the pivot
  reach ///< aim and stretch at the same time, so that the arm's end is under the mouse
};

/// The type, the positions and the constraint of a drag.
struct DragSetup
{
  DragKind kind = DragKind::move;
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero(); ///< center of rotations and scales
  /// The grabbed position. The plane or the line of a move goes through this position.
  Eigen::Vector3d grabbed = Eigen::Vector3d::Zero();
  /// Vector from the pivot to the end of the arm, for the kinds aim, stretch and reach.
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
  /// Axes of the constraint as columns, and a mask of the axes along which motion is allowed (bits
  /// 1, 2, 4). With all axes (7), a move is in the plane that faces the camera, a rotation is about
  /// the viewing direction, and a scale is uniform. With two axes, a rotation is about the third
  /// axis.
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  int axes = 7;
  /// Distance, in pixels, that the mouse moves for a rotation by 1 radian if the ring is seen
  /// edge-on.
  double ring_pixels = 80.0;
  double length_step = 0.0; ///< moves snap to multiples of this length; 0: no snapping
  double degree_step = 15.0;
  double factor_step = 0.1;
};

/// The result of a drag at the current mouse position.
struct DragMotion
{
  /// Motion in world coordinates since the start of the drag.
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  double amount = 0.0; ///< length of a move, degrees of a rotation, factor of a scale or stretch
  /// Factor on the arm's length for the kinds stretch and reach. `motion` does not include this
  /// factor.
  double factor = 1.0;
};

/// The geometry of one drag, independent of handles. The input is display positions, the output a
/// motion in world coordinates.
///
/// The drag sums the motions of the mouse, or a tenth of each motion in fine mode, so that nothing
/// jumps when fine mode begins or ends. The last motion is kept if the mouse is beyond the horizon
/// of the drag's plane, or if the line of a move or a stretch points at the viewer.
class Drag
{
public:
  Drag(const ScreenView& view, const DragSetup& setup, const Eigen::Vector2d& mouse);

  /// Follow the mouse to a new position.
  void move_to(const Eigen::Vector2d& mouse, bool fine);
  /// Change the constraint, as if the drag had begun with the new constraint.
  void constrain(const Eigen::Matrix3d& frame, int axes);
  void set_snapping(bool snap) { this->snap_ = snap; }
  /// Set a typed value that replaces the mouse: a length along the first axis on which motion is
  /// allowed, degrees, or a factor.
  void set_typed_amount(std::optional<double> amount) { this->typed_amount_ = amount; }

  const DragSetup& setup() const { return this->setup_; }
  /// Return the axis of a rotation, or of a move along a line.
  Eigen::Vector3d axis() const;
  /// Return the direction from the pivot to the grabbed position of a rotation: a unit vector
  /// perpendicular to the axis.
  Eigen::Vector3d start_arm() const;
  DragMotion motion();

private:
  void restart();
  std::optional<double> distance_along(
    const Eigen::Vector3d& axis, const Eigen::Vector2d& mouse) const;
  std::optional<double> angle(const Eigen::Vector2d& mouse) const;
  void follow_angle();
  DragMotion move_motion() const;
  DragMotion turn_motion() const;
  DragMotion aim_motion() const;
  DragMotion scale_motion() const;
  DragMotion stretch_motion() const;
  double snap_amount(double amount, double step) const;

  ScreenView view_;
  DragSetup setup_;
  Eigen::Vector2d mouse_; // last position of the mouse
  Eigen::Vector2d start_;
  // Mouse position that the drag uses; in fine mode it moves less than the mouse.
  Eigen::Vector2d current_;
  double rotation_angle_ = 0.0; // angle of the rotation so far, in radians
  double last_angle_ = 0.0;
  bool snap_ = false;
  std::optional<double> typed_amount_;
  DragMotion last_motion_;
};

} // namespace bindpose

#endif
