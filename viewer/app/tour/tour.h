#ifndef app_tour_tour_h
#define app_tour_tour_h

#include "base/status.h"

#include <array>
#include <string>
#include <vector>

namespace app::tour
{

/// A description of a mouse position in the 3D view. The position in pixels is computed when the
/// step is played.
struct TourPosition
{
  std::string handle; ///< name of a handle; empty: the position is relative to the view
  double bone_fraction = 0.0; ///< position on a bone, from its head (0) to its tail (1)
  /// A part of the selected handle's gizmo, one of bindpose::GizmoPart; 0: no part. The position is
  /// the point at which the mouse can best grab the part.
  int gizmo_part = 0;
  /// For the view: the position from its upper left corner, as fractions of its width and height.
  /// For a handle or a gizmo: an offset to the right and down, in pixels.
  std::array<double, 2> position{ 0.0, 0.0 };
};

/// The actions of a step. The words in a tour file have the same names.
enum class TourVerb
{
  open, ///< open a file
  action, ///< trigger an entry of the menus, by its object name
  push, ///< click a button, by its text
  option, ///< set an option, by its key (document/options.h)
  panel, ///< show a panel to the right of the 3D view: pose, weights, tets or volume
  select, ///< select a handle in the list
  type, ///< type a text into a field, as with the keyboard
  mode, ///< set the mode of the selected handles: full, position, free, tail, ends or auto
  click,
  double_click,
  press,
  move,
  release,
  drag,
  wheel,
  scrub, ///< click on the timeline at the time `seconds`
  key, ///< press a key, in the notation of menus: "Ctrl+Z", "Esc"
  resize,
  wait, ///< wait for "bind", "idle", or a number of seconds
  film, ///< begin to record every motion as numbered images; the argument "end" stops the recording
  screenshot,
  check
};
/// Return the word for a verb in a tour file.
const char* to_string(TourVerb verb);

enum class TourButton
{
  left,
  middle,
  right
};

/// How a check compares a value with the expected value.
enum class TourRelation
{
  is,
  at_least,
  at_most,
  as_at ///< equal to the value at an earlier screenshot
};

enum class TourPart
{
  window,
  view, ///< the 3D view in the window
  dialog ///< a non-modal dialog in front of the window
};

struct TourStep
{
  TourVerb verb = TourVerb::wait;
  std::string text; ///< argument of the verb: a file, a name, a key or a text
  std::string field; ///< accessible name of the field to type into
  /// The player enters this file name in the file dialog that the step opens. The file is in the
  /// folder of screenshots. If the name is empty, the step fails when it opens a modal dialog.
  std::string answer;
  std::string narration; ///< explanation of the step, for tutorials

  TourPosition mouse_position; ///< position of the mouse; for a drag: its start
  TourPosition to; ///< for a drag: its end
  int moves = 8; ///< for a drag: number of mouse moves
  TourButton button = TourButton::left;
  bool shift = false, ctrl = false, alt = false;
  double turns = 0.0; ///< notches of the mouse wheel; positive: away from the user

  double seconds = -1.0; ///< for `wait`: duration; for `scrub`: time on the timeline
  std::array<int, 2> size{ 0, 0 }; ///< for `resize`: new size of the window, in pixels
  TourPart part = TourPart::window; ///< the part that a screenshot shows
  int width = 0; ///< maximum width of a screenshot in pixels; 0: no limit
  /// For a screenshot of the view: each pixel of the view becomes `scale` by `scale` pixels.
  int scale = 1;
  bool transparent = false; ///< true: a screenshot of the view has a transparent background

  TourRelation relation = TourRelation::is;
  std::string expected_text; ///< expected word, or the name of the screenshot for `as_at`
  /// Expected numbers, one per component. For the verb `option`: the new value of the option.
  std::vector<double> expected;
  bool expects_text = false, expects_bool = false;
  double tolerance = 0.0;
};

/// A sequence of user actions in the window, played by TourPlayer.
struct Tour
{
  std::string name;
  std::array<int, 2> size{ 1280, 800 }; ///< size of the window, in pixels
  /// Size of the 3D view in pixels; 0: no fixed size. The window is resized until the view has this
  /// size, because the sizes of other widgets depend on the font.
  std::array<int, 2> view{ 0, 0 };
  double seconds = 300.0; ///< maximum duration of the tour
  std::vector<TourStep> steps;
};

/// Read a tour from JSON: {"tour": {"schema": 1, …}, "steps": [{"open": "a.off"}, …]}.
/// viewer/sessions_and_tours.md documents the format. If the text does not follow the format, for
/// example because of an unknown field, return invalid_input with a sentence that names the step.
bindpose::Status parse_tour(const std::string& text, Tour& tour);
/// Read a tour from a file. Messages begin with the name of the file.
bindpose::Status read_tour(const std::string& path, Tour& tour);

/// Return the name of a step for messages, such as "step 3 (drag)".
std::string step_name(std::size_t index, const TourStep& step);

} // namespace app::tour

#endif
