#ifndef pose_drag_h
#define pose_drag_h

#include "gizmo.h"
#include "handle_drag.h"
#include "handle_picking.h"
#include "handle_poses.h"

#include <array>
#include <string>

namespace bindpose
{

/// What all drags of one widget share.
struct DragSettings
{
  bool local_space = false; ///< axes of the gizmo and of keys: the handle's own
  bool descend = true;
  bool bone_arrays = true; ///< stretch and twist go to their arrays, else into the transform
  bool reach = false; ///< a tail's drag stretches, too
  double ring_pixels = 80.0;
  double length_step = 0.0;
  double degree_step = 15.0;
  double factor_step = 0.1;
};

/// The axes that a part of the gizmo is held to, as a mask; 7 for those that are not.
int axes_of_part(int part);

/// One drag of handles: what the mouse holds becomes a drag, the drag's motion becomes poses.
class PoseDrag
{
public:
  /// @param part      HandlePart or GizmoPart
  /// @param grabbed   cells, the one that the mouse holds first; none of them free or locked
  PoseDrag(const ScreenView& view, std::vector<HandlePlace> places, int part,
    const std::vector<vtkIdType>& grabbed, const Eigen::Vector2d& mouse,
    const DragSettings& settings);

  Drag& drag() { return this->drag_; }
  const HandleGroup& group() const { return this->group_; }
  std::vector<HandleData::CellPose> poses();

  /// A key: held to an axis, or to the plane across it. Once: in the settings' space; again: in the
  /// other one; a third time: not held.
  void press_axis(int axis, bool plane);
  /// A key of a number: digits, '.', '-' (turns the sign), 'b' (takes the last back). False for
  /// any other.
  bool type(char key);
  const std::string& typed() const { return this->typed_; }

  /// "move", "turn", "scale", "stretch", "twist".
  const char* name() const;
  /// "0.25 along X", "30°": for people.
  std::string text();
  /// The part of the gizmo that this is like, to be drawn; no_part for none.
  int part() const;
  /// The axes that it is held to.
  const Eigen::Matrix3d& frame() const { return this->drag_.setup().frame; }
  /// A turn's ends, from the pivot to the ring: see GizmoMarks.
  std::array<std::optional<Eigen::Vector3d>, 2> spokes(double radius);

private:
  int start_part_;
  std::vector<HandlePlace> places_;
  HandleGroup group_;
  DragSettings settings_;
  Drag drag_;
  int presses_ = 0;
  int pressed_axes_ = 0;
  std::string typed_;
};

} // namespace bindpose

#endif
