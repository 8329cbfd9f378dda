#ifndef handle_bindings_h
#define handle_bindings_h

#include <array>

namespace bindpose
{

/// The effects of keys and buttons on the widget. Actions without a key are listed only for the
/// documentation.
enum class HandleAction
{
  select,
  toggle,
  drag_gizmo,
  start_move,
  start_turn,
  start_scale,
  constrain_to_axis,
  constrain_to_plane,
  fine,
  snap,
  reach,
  type,
  confirm,
  cancel,
  move_rest,
  add_point,
  add_bone,
  add_cage_vertex,
  close_cage,
  finish_cage,
  drop_vertex,
  snap_position
};

/// The effects of keys and buttons on the region brush.
enum class BrushAction
{
  paint,
  erase,
  grow,
  shrink,
  cancel
};

/// One row of the table of keys and buttons. The table is used three times: for the widget's
/// documentation, for the program's key sheet, and by the widget to look up keys.
template <typename Action>
struct InputBinding
{
  Action action;
  /// The mode or state in which the row applies: "pose", "drag" (in any mode), "move rest", "add
  /// points", "add bones", "add cage", "paint regions".
  const char* context;
  const char* input; ///< the key or button, in the form shown to users
  const char* keys; ///< key names (KeySym of vtkRenderWindowInteractor), each between blanks; or ""
  const char* text; ///< description of the action
};

using HandleBinding = InputBinding<HandleAction>;
using BrushBinding = InputBinding<BrushAction>;

constexpr std::array<HandleBinding, 22> handle_bindings{ {
  { HandleAction::select, "pose", "Left button on a handle", "",
    "Select and drag the handle: a ball, a bone or the head of a bone moves; the tail of a bone "
    "rotates "
    "the bone" },
  { HandleAction::toggle, "pose", "Shift + left button on a handle", "",
    "Add the handle to the selection, or remove it from the selection" },
  { HandleAction::drag_gizmo, "pose", "Left button on the gizmo", "",
    "Move, turn, scale, stretch or twist all selected handles" },
  { HandleAction::start_move, "pose", "G", " g ", "Move the selected handles with the mouse" },
  { HandleAction::start_turn, "pose", "R", " r ", "Turn the selected handles with the mouse" },
  { HandleAction::start_scale, "pose", "S", " s ", "Scale the selected handles with the mouse" },
  { HandleAction::constrain_to_axis, "drag", "X, Y, Z", " x y z ",
    "Constrain the drag to an axis; press again to switch between handle axis and world axis, a "
    "third time for "
    "no axis" },
  { HandleAction::constrain_to_plane, "drag", "Shift + X, Y, Z", " x y z ",
    "Constrain the drag to the plane perpendicular to an axis" },
  { HandleAction::fine, "drag", "Shift, held", "", "Drag finely: a tenth of the mouse motion" },
  { HandleAction::snap, "drag", "Ctrl, held", "",
    "Snap: lengths to the grid's step, angles to 15°, factors to 0.1" },
  { HandleAction::reach, "pose", "Alt + left button on a bone's tail", "",
    "Rotate and stretch the bone so that its tail follows the mouse" },
  { HandleAction::type, "drag", "0–9 . − Backspace",
    " 0 1 2 3 4 5 6 7 8 9 period comma minus BackSpace KP_0 KP_1 KP_2 KP_3 KP_4 KP_5 KP_6 KP_7 "
    "KP_8 KP_9 KP_Decimal KP_Subtract ",
    "Type the length, the angle in degrees or the factor" },
  { HandleAction::confirm, "drag", "Enter, left button", " Return KP_Enter ", "Finish the drag" },
  { HandleAction::cancel, "drag", "Esc, right button", " Escape ",
    "Cancel the drag and restore the state before it" },
  { HandleAction::move_rest, "move rest", "Left button on a handle", "",
    "Move the rest position of a point, a bone (drag its body), or a joint and all bones that "
    "share "
    "it" },
  { HandleAction::add_point, "add points", "Left button on the surface", "",
    "Add a point, inside the shape or on its surface" },
  { HandleAction::add_bone, "add bones", "Left button, drag", "",
    "Draw a bone from head to tail; a bone that starts at the end of another bone becomes its "
    "child" },
  { HandleAction::add_cage_vertex, "add cage", "Left button", "",
    "Add a cage vertex that is connected to the last vertex" },
  { HandleAction::close_cage, "add cage", "Left button on the first vertex", "", "Close the cage" },
  { HandleAction::finish_cage, "add cage", "Enter, double click", " Return KP_Enter ",
    "Finish the cage without closing it" },
  { HandleAction::drop_vertex, "add cage", "Esc", " Escape ",
    "Remove the last vertex; leave the mode if there is none" },
  { HandleAction::snap_position, "add points, add bones, add cage, move rest", "Ctrl, held", "",
    "Snap to the ends of handles and to the surface's vertices" },
} };

constexpr std::array<BrushBinding, 5> brush_bindings{ {
  { BrushAction::paint, "paint regions", "Left button on the surface", "",
    "Paint the region's label" },
  { BrushAction::erase, "paint regions", "Ctrl + left button", "", "Erase labels" },
  { BrushAction::grow, "paint regions", "], Shift + wheel up", " bracketright ] ",
    "Enlarge the brush" },
  { BrushAction::shrink, "paint regions", "[, Shift + wheel down", " bracketleft [ ",
    "Shrink the brush" },
  { BrushAction::cancel, "paint regions", "Esc", " Escape ",
    "Cancel the stroke and restore all labels" },
} };

} // namespace bindpose

#endif
