#ifndef app_parts_window_keys_h
#define app_parts_window_keys_h

#include "widgets/handle_bindings.h"

#include <array>
#include <cstring>
#include <string>
#include <vector>

// All keys and mouse buttons of the window in one table. Actions read their shortcuts from the
// table. The shortcut sheet and `bindpose key-table` show the table together with the bindings of
// the widgets. This header does not use Qt, because it is also compiled in builds without the
// window.

namespace app::parts
{

struct WindowKey
{
  /// Name of the action that uses the keys. Empty for rows that are only documentation.
  const char* action;
  const char* heading; ///< heading of the group in the shortcut sheet
  /// Keys as shown to users and read by QKeySequence; ", " separates several keys.
  const char* input;
  const char* text; ///< the effect of the keys
};

constexpr std::array<WindowKey, 46> window_keys{ {
  { "open", "anywhere", "Ctrl+O", "Open files" },
  { "save", "anywhere", "Ctrl+S", "Save the session" },
  { "save_as", "anywhere", "Ctrl+Shift+S", "Save the session under another name" },
  { "undo", "anywhere", "Ctrl+Z", "Undo" },
  { "redo", "anywhere", "Ctrl+Shift+Z, Ctrl+Y", "Redo" },
  { "bind", "anywhere", "Ctrl+B", "Bind" },
  { "auto_rig", "anywhere", "Ctrl+Shift+B", "Auto-rig: make bones along the shape and bind it" },
  { "rest_pose", "anywhere", "Ctrl+R", "Take all handles back to rest" },
  { "", "anywhere", "1 … 7",
    "Pose method: linear, dual quaternions, stretchable bones, centers of rotation, reduced ARAP, "
    "full ARAP, variational surface" },
  { "play", "anywhere", "Space", "Play key frames, or pause" },
  { "set_key", "anywhere", "K", "Set a key frame" },
  { "keys", "anywhere", "?, F1", "Show this list of keys" },
  { "quit", "anywhere", "Ctrl+Q", "Quit" },

  { "", "view", "Drag with the left button, away from handles",
    "Turn the view (2D view: move the view); on a slice or cut: move its plane (Esc cancels)" },
  { "", "view", "Drag with Shift + left button or with the middle button", "Move the view" },
  { "", "view", "Wheel, or drag with the right button", "Zoom" },
  { "whole_shape", "view", "Home", "Show the whole shape" },
  { "look_at_rest", "view", "T", "Show the rest shape, or the pose again" },

  { "gizmo.none", "tools", "Q", "Drag handles directly, without a gizmo" },
  { "gizmo.move", "tools", "W",
    "Gizmo for moving: arrows (along an axis) and squares (in a plane)" },
  { "gizmo.turn", "tools", "E", "Gizmo for rotating: rings" },
  { "gizmo.scale", "tools", "D", "Gizmo for scaling: boxes" },
  { "gizmo.all", "tools", "F", "Gizmo with all parts; for a bone also stretch and twist" },
  { "gizmo.local", "tools", "L",
    "Switch between handle axes and world axes for the gizmo and the keys X, Y, Z" },
  { "mode.pose", "tools", "Esc", "Back to posing" },
  { "mode.rest", "tools", "M", "Move rest positions" },
  { "mode.points", "tools", "A", "Add points" },
  { "mode.bones", "tools", "B", "Add bones" },
  { "mode.cage", "tools", "C", "Add a cage" },
  { "mode.regions", "tools", "P", "Paint regions" },
  { "inside", "tools", "I",
    "Switch between placing points and bones inside the shape and on its surface" },

  { "", "handles", "Right button on a handle", "Open the menu of the handle" },
  { "find", "handles", "Ctrl+F", "Find a handle by its name" },
  { "select_all", "handles", "Ctrl+A", "Select all handles" },
  { "rename", "handles", "F2", "Rename" },
  { "color", "handles", "Ctrl+K", "Recolor" },
  { "lock", "handles", "Ctrl+L", "Lock or unlock: a locked handle cannot be moved" },
  { "delete", "handles", "Delete", "Delete" },
  { "mirror.x", "handles", "Ctrl+M", "Mirror the selected handles, left to right" },
  { "snap", "handles", "Ctrl+T", "Snap to the surface" },
  { "cage_edge", "handles", "Ctrl+E", "Add or remove the edge between two cage vertices" },
  { "reset", "handles", "Ctrl+0", "Reset: back to rest" },
  { "fixes.auto", "handles", "Alt+0",
    "Fix the position, and the rotation if the handle was rotated" },
  { "fixes.full", "handles", "Alt+1", "Fix position and rotation" },
  { "fixes.position", "handles", "Alt+2", "Fix only the position" },
  { "fixes.free", "handles", "Alt+3", "Fix nothing" },
} };

/// Return the keys of an action, as in the table; empty if there are none.
inline std::string keys_of(const char* action)
{
  for (const WindowKey& key : window_keys)
  {
    if (std::strcmp(key.action, action) == 0)
    {
      return key.input;
    }
  }
  return "";
}

struct KeyGroup
{
  std::string heading;
  /// One pair per row: the keys or mouse buttons, and their effect.
  std::vector<std::pair<std::string, std::string>> rows;
};

/// Return the keys of the window and of the widgets, in the order in which they are shown. They are
/// grouped by the situations in which they apply.
inline std::vector<KeyGroup> all_keys()
{
  std::vector<KeyGroup> groups;
  const auto add = [&groups](const char* heading, const char* input, const char* text)
  {
    for (KeyGroup& group : groups)
    {
      if (group.heading == heading)
      {
        group.rows.emplace_back(input, text);
        return;
      }
    }
    groups.push_back({ heading, { { input, text } } });
  };
  for (const WindowKey& key : window_keys)
  {
    add(key.heading, key.input, key.text);
  }
  for (const bindpose::HandleBinding& binding : bindpose::handle_bindings)
  {
    add(binding.context, binding.input, binding.text);
  }
  for (const bindpose::BrushBinding& binding : bindpose::brush_bindings)
  {
    add(binding.context, binding.input, binding.text);
  }
  return groups;
}

} // namespace app::parts

#endif
