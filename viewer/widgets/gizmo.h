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

/// Parts of the gizmo. The numbers are those of the representation's states; the axis of a part of
/// three is its number less the first one's.
enum GizmoPart : int
{
  no_part = 0,
  move_x = 10,
  move_y,
  move_z,
  move_yz, ///< in a plane: the number says which axis stays
  move_zx,
  move_xy,
  turn_x = 20,
  turn_y,
  turn_z,
  turn_view, ///< about the line of sight
  scale_x = 30,
  scale_y,
  scale_z,
  scale_all,
  stretch_bone = 40,
  twist_head,
  twist_tail
};

/// The words for them, in tours.
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
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity(); ///< axes as columns
  bool only_moves = false; ///< no turning, scaling, stretching
  std::optional<Eigen::Vector3d> tail; ///< of a bone; its head is the origin
  bool twists_apart = true; ///< a twist ring at each end, else one in the middle
  double pixels = 80.0; ///< length of the axes of the gizmo that only moves
  /// Red, green and blue as everywhere, but told apart without each kind of cone.
  Colour axes[3] = { { 0.80, 0.15, 0.25 }, { 0.50, 0.80, 0.25 }, { 0.18, 0.43, 0.93 } };
  Colour bone = { 0.72, 0.40, 0.72 };
  Colour plain = { 0.60, 0.61, 0.65 }; ///< what belongs to no axis
};

/// The kind of gizmo that has a part, the given one if it has.
GizmoKind gizmo_with(int part, GizmoKind kind);
/// The radius of a ring, in pixels of the window.
double ring_pixels(const GizmoSetup& setup, int part);

/// What the mouse does with the gizmo.
struct GizmoMarks
{
  int hovered = no_part;
  int active = no_part; ///< dragged: all other parts are left out
  /// A turn: from the origin to where it was grabbed (world), and to where that is now.
  std::optional<Eigen::Vector3d> spokes[2];
};

/// Arrows, plates, rings and boxes around one place, all of a constant size on the screen: laid out
/// in the world for one view, to be picked or drawn.
class Gizmo
{
public:
  Gizmo(const ScreenView& view, const GizmoSetup& setup, const GizmoMarks& marks = {});

  /// The part under the mouse. Boxes, cones and bone parts win over plates, plates over shafts,
  /// shafts over rings, rings over the ring that faces the camera; among equals the nearest to the
  /// mouse, then to the camera.
  /// @param tolerance  pixels beyond what is drawn
  int pick(const Eigen::Vector2d& mouse, double tolerance) const;
  /// @param outline  the same, a little larger, for the hull
  void draw(HandleShapes& solid, HandleShapes& outline) const;
  /// X, Y, Z beside the tips, and beside a ring that the mouse is on.
  struct Label
  {
    std::string text;
    Eigen::Vector2d display;
    Colour colour;
  };
  std::vector<Label> labels() const;
  /// Where a part is best grabbed, on the screen; nothing when it is not there.
  std::optional<Eigen::Vector2d> grip(int part) const;

private:
  struct Part
  {
    int part = no_part;
    int rank = 0;
    Colour colour{};
    std::vector<Eigen::Vector3d> path; // a tube
    double thickness = 2.4; // pixels
    std::vector<Eigen::Vector3d> plate; // four corners
    std::vector<Eigen::Vector3d> box; // one centre
    double box_half = 0.0; // pixels
    std::vector<Eigen::Vector3d> cone; // base and tip
    double cone_radius = 0.0; // pixels
    bool guide = false; // is only seen
    bool quiet = false; // without an outline
    std::string label;
  };
  void add_axes();
  void add_rings();
  void add_bone();
  void add_drag();
  Part ring(int part, const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double pixels,
    bool whole) const;
  Eigen::Vector3d at(int axis, double pixels) const;

  ScreenView view_;
  GizmoSetup setup_;
  GizmoMarks marks_;
  double pixel_ = 0.0; // world length of a pixel at the origin
  double unit_ = 1.0; // pixels of a pixel of the layout
  std::vector<Part> parts_;
};

} // namespace bindpose

#endif
