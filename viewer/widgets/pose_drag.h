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

/// Settings for all drags of one widget.
struct DragSettings
{
  /// The gizmo and the keys X, Y, Z use the handle's own axes. If false, they use the world's axes.
  bool local_space = false;
  bool with_descendants = true;
  /// True: write stretches and twists to the arrays `Stretch` and `Twist`. False: multiply them
  /// into `Transform`.
  bool writes_bone_arrays = true;
  bool reach = false; ///< dragging a tail also stretches the bone
  double ring_pixels = 80.0;
  double length_step = 0.0;
  double degree_step = 15.0;
  double factor_step = 0.1;
};

/// Return the mask of axes (see DragSetup) to which a part of the gizmo is constrained; 7 for parts
/// without a constraint.
int axes_of_part(int part);

/// A drag of one or more handles by one part. Its Drag converts the motion of the mouse to a motion
/// in world coordinates; poses() applies this motion to the handles.
class PoseDrag
{
public:
  /// @param part      HandlePart or GizmoPart
  /// @param grabbed   cells of the handles to drag; the handle under the mouse comes first. The
  /// caller must leave out handles that cannot be dragged (locked, or in mode free unless DragFree
  /// is on).
  PoseDrag(const ScreenView& view, std::vector<HandleRecord> records, int part,
    const std::vector<vtkIdType>& grabbed, const Eigen::Vector2d& mouse,
    const DragSettings& settings);

  Drag& drag() { return this->drag_; }
  const HandleGroup& group() const { return this->group_; }
  std::vector<HandleData::CellPose> poses();

  /// Handle an axis key: constrain the drag to an axis, or to the plane perpendicular to it. The
  /// first press uses the axes of the space in the settings. A second press of the same key uses
  /// the axes of the other space. A third press removes the constraint.
  void press_axis(int axis, bool plane);
  /// Handle a key that edits a typed value: a digit, '.', '-' (toggles the sign) or 'b' (deletes
  /// the last character). Return false for any other key.
  bool type(char key);
  const std::string& typed_text() const { return this->typed_text_; }

  /// Return the type of the drag: "move", "turn", "scale", "stretch", "twist".
  const char* name() const;
  /// Return the amount for display, such as "X 0.25" or "30.0°".
  std::string text();
  /// Return the part of the gizmo that corresponds to the drag, for drawing; no_part if there is
  /// none.
  int part() const;
  /// Return the axes of the constraint.
  const Eigen::Matrix3d& frame() const { return this->drag_.setup().frame; }
  /// Return the ends of the two lines from the pivot to the ring of a rotation; see GizmoMarks.
  std::array<std::optional<Eigen::Vector3d>, 2> spokes(double radius);

private:
  int start_part_;
  std::vector<HandleRecord> records_;
  HandleGroup group_;
  DragSettings settings_;
  Drag drag_;
  int axis_presses_ = 0;
  int pressed_axes_ = 0;
  std::string typed_text_;
};

} // namespace bindpose

#endif
