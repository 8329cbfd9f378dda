#ifndef gizmo_h
#define gizmo_h

#include "handle_shapes.h"
#include "screen_view.h"

#include <optional>
#include <string>
#include <vector>

namespace bindpose
{

enum class GizmoKind
{
  none = 0,
  move = 1,
  turn = 2,
  scale = 3,
  all = 4
};

/// The parts of the gizmo: arrows, plates, rings and boxes around a selected handle. The values
/// equal the interaction states of the representation. In a group of three parts, such as move_x to
/// move_z, the index of a part's axis is its value minus the value of the first part.
enum GizmoPart : int
{
  no_part = 0,
  move_x = 10,
  move_y,
  move_z,
  move_yz, ///< plate that moves the handle in the plane perpendicular to the part's axis
  move_zx,
  move_xy,
  turn_x = 20,
  turn_y,
  turn_z,
  turn_view, ///< ring that rotates the handle about the viewing direction
  scale_x = 30,
  scale_y,
  scale_z,
  scale_all,
  stretch_bone = 40,
  twist_head,
  twist_tail
};

/// Names of the parts in tours, the scripted demonstrations of the window.
struct GizmoPartWord
{
  const char* word;
  GizmoPart part;
};
constexpr GizmoPartWord gizmo_part_words[] = { { "move_x", move_x }, { "move_y", move_y },
  { "move_z", move_z }, { "move_yz", move_yz }, { "move_zx", move_zx }, { "move_xy", move_xy },
  { "turn_x", turn_x }, { "turn_y", turn_y }, { "turn_z", turn_z }, { "turn_view", turn_view },
  { "scale_x", scale_x }, { "scale_y", scale_y }, { "scale_z", scale_z },
  { "scale_all", scale_all }, { "stretch", stretch_bone }, { "twist_head", twist_head },
  { "twist_tail", twist_tail } };

struct GizmoSetup
{
  GizmoKind kind = GizmoKind::all;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< center of the gizmo, in world coordinates
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity(); ///< axes of the gizmo as columns
  bool only_moves = false; ///< true: the gizmo has no parts for rotating, scaling or stretching
  std::optional<Eigen::Vector3d> tail; ///< tail of a bone, whose head is the origin
  /// True: two twist rings, at head and tail; false: one ring in the middle.
  bool two_twist_rings = true;
  /// Size in window pixels: distance of a scale box from the origin, for kind `scale`.
  double pixels = 80.0;
  /// Colors of the x, y and z axes: red, green and blue, in shades that viewers with any type of
  /// color blindness can distinguish.
  Color axes[3] = { { 0.80, 0.15, 0.25 }, { 0.50, 0.80, 0.25 }, { 0.18, 0.43, 0.93 } };
  Color bone = { 0.72, 0.40, 0.72 };
  Color plain = { 0.60, 0.61, 0.65 }; ///< color of parts without an axis
};

/// Return a kind of gizmo that has the part; `kind` itself if possible.
GizmoKind gizmo_with(int part, GizmoKind kind);
/// Return the radius of a ring, in pixels of the window.
double ring_pixels(const GizmoSetup& setup, int part);

/// The state of the gizmo in an interaction with the mouse.
struct GizmoMarks
{
  int hovered = no_part;
  int active = no_part; ///< the dragged part; all other parts are left out
  /// During a rotation, two lines are drawn from the gizmo's center to its ring. These are their
  /// ends on the ring, in world coordinates: first the position where the drag began, then the
  /// position to which the drag has rotated it.
  std::optional<Eigen::Vector3d> spokes[2];
};

/// The gizmo: arrows, plates, rings and boxes around one position, with constant size on the
/// screen. They are laid out in world coordinates for one view, for picking or drawing.
class Gizmo
{
public:
  Gizmo(const ScreenView& view, const GizmoSetup& setup, const GizmoMarks& marks = {});

  /// Return the part under the mouse. The order of priority is: boxes, cones and bone parts;
  /// plates; shafts; rings; the ring that faces the camera. Among parts of equal priority, the
  /// nearest to the mouse wins, then the nearest to the camera.
  /// @param tolerance  a part is hit if the mouse is at most this far from the drawn part, in
  /// pixels
  int pick(const Eigen::Vector2d& mouse, double tolerance) const;
  /// Draw the parts.
  /// @param solid  receives the shapes of the parts
  /// @param outline  receives the same shapes, slightly larger, for the outlines
  void draw(HandleShapes& solid, HandleShapes& outline) const;
  /// The letter X, Y or Z next to a tip, or next to a ring under the mouse.
  struct Label
  {
    std::string text;
    Eigen::Vector2d display;
    Color color;
  };
  std::vector<Label> labels() const;
  /// Return a screen position at which a part can be grabbed, or nothing if the part is not shown.
  std::optional<Eigen::Vector2d> grip(int part_id) const;

private:
  struct Part
  {
    int part = no_part;
    int rank = 0;
    Color color{};
    std::vector<Eigen::Vector3d> path; // the center line of a tube
    double thickness = 2.4; // pixels
    std::vector<Eigen::Vector3d> plate; // the four corners of a plate
    std::vector<Eigen::Vector3d> box; // the center of a box
    double box_half = 0.0; // half of the box's side, in pixels
    std::vector<Eigen::Vector3d> cone; // the base and the tip of a cone
    double cone_radius = 0.0; // pixels
    bool guide = false; // true: a guide line, which is visible but cannot be picked
    bool omits_outline = false; // true: drawn without an outline
    std::string label;
  };
  void add_axes();
  void add_rings();
  void add_bone();
  void add_drag();
  Part ring(int part, const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double pixels,
    bool is_full_circle) const;
  Eigen::Vector3d at(int axis, double pixels) const;

  ScreenView view_;
  GizmoSetup setup_;
  GizmoMarks marks_;
  double pixel_ = 0.0; // world length of a pixel at the origin
  double layout_scale_ = 1.0; // window pixels per pixel of the layout
  std::vector<Part> parts_;
};

} // namespace bindpose

#endif
