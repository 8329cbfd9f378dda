#ifndef tour_h
#define tour_h

#include "base/status.h"

#include <array>
#include <string>
#include <vector>

namespace bindpose
{

/// A place in the picture, found when the step is played.
struct TourPlace
{
  std::string handle; ///< empty: a place of the view
  double along = 0.0; ///< of a bone, from its head (0) to its tail (1)
  /// Where a part of the selected handle's gizmo is best grabbed: one of bindpose::GizmoPart;
  /// 0: none is meant.
  int gizmo_part = 0;
  /// Of the view: from its upper left corner, in shares of its width and height. Of a handle and of
  /// the gizmo: this many pixels to the right of it and below it.
  std::array<double, 2> at{ 0.0, 0.0 };
};

/// What a step does; the words are those of the file.
enum class TourVerb
{
  open, ///< a file
  action, ///< an entry of the menus, by its object name
  push, ///< a button, by its text
  option, ///< by its key (document/options.h)
  panel, ///< right of the picture: pose, weights, tets or volume
  select, ///< a handle, in the list
  type, ///< a text into a field, as with the keyboard
  mode, ///< of the selected handle: full, position, free, tail or ends
  click,
  double_click,
  press,
  move,
  release,
  drag,
  wheel,
  scrub, ///< the key frames' time to so many seconds, by the mouse
  key, ///< as menus write it: "Ctrl+Z", "Esc"
  resize,
  wait, ///< for "bind", "idle", or so many seconds
  film, ///< from now on every motion is a picture, until "end"
  screenshot,
  check
};
/// One of the words above.
const char* to_string(TourVerb verb);

enum class TourButton
{
  left,
  middle,
  right
};

/// What a check holds a value against.
enum class TourRelation
{
  is,
  at_least,
  at_most,
  as_at ///< as it was at a screenshot before
};

enum class TourPart
{
  window,
  view, ///< the picture in it
  dialog ///< what stands in front of it and lets it go on
};

struct TourStep
{
  TourVerb verb = TourVerb::wait;
  std::string text; ///< file, name, key, sentence: whatever the verb is about
  std::string field; ///< to type into, by its accessible name
  /// Name of a file in the folder of screenshots, for the file dialog that the step opens. Empty:
  /// a dialog is an error.
  std::string answer;
  std::string say; ///< what a tutorial says about it

  TourPlace place; ///< of the mouse
  TourPlace to; ///< of a drag
  int moves = 8; ///< of a drag: how many
  TourButton button = TourButton::left;
  bool shift = false, ctrl = false, alt = false;
  double turns = 0.0; ///< of the wheel, away from the person

  double seconds = -1.0; ///< to wait, or to scrub to
  std::array<int, 2> size{ 0, 0 }; ///< to resize to
  TourPart part = TourPart::window; ///< that a picture is of
  int width = 0; ///< of a screenshot, smaller than it is; 0: as it is
  int scale = 1; ///< of a screenshot of the view: so many times as many pixels each way
  bool transparent = false; ///< the same: its background

  TourRelation relation = TourRelation::is;
  std::string wanted_text; ///< a word, or the screenshot of as_at
  std::vector<double> wanted; ///< numbers: one, or one a component; of an option its value
  bool wants_text = false, wants_truth = false;
  double tolerance = 0.0;
};

/// Steps that a person would do in the window, to be played by TourPlayer.
struct Tour
{
  std::string name;
  std::array<int, 2> size{ 1280, 800 }; ///< of the window
  /// Of the picture in it, which the window is resized for, whatever the fonts; 0: as it comes.
  std::array<int, 2> view{ 0, 0 };
  double seconds = 300.0; ///< it may take at most
  std::vector<TourStep> steps;
};

/// Reads a tour: JSON, {"tour": {"schema": 1, …}, "steps": [{"open": "a.off"}, …]}; the format is
/// told in viewer/sessions_and_tours.md. invalid_input, one sentence that names the step, for
/// whatever is not of it, unknown fields included.
Status parse_tour(const std::string& text, Tour& tour);
/// The same of a file, whose name the sentence begins with.
Status read_tour(const std::string& path, Tour& tour);

/// "step 3 (drag)"
std::string step_name(std::size_t index, const TourStep& step);

} // namespace bindpose

#endif
