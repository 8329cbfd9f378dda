#ifndef rest_editor_h
#define rest_editor_h

#include "handle_data.h"
#include "handle_drag.h"
#include "handle_edit_cells.h"
#include "handle_picking.h"
#include "rest_surface.h"
#include "screen_view.h"

#include "vtkSmartPointer.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bindpose
{

/// What the hand does. The numbers are those of the representation's edit modes.
enum class EditMode
{
  pose = 0,
  move_rest = 1,
  add_points = 2,
  add_bones = 3,
  add_cage = 4
};

/// The mouse at one moment.
struct Hand
{
  Eigen::Vector2d mouse = Eigen::Vector2d::Zero();
  bool fine = false;
  bool snap = false;
};

struct EditSettings
{
  EditMode mode = EditMode::pose;
  bool place_inside = true; ///< points and bones at mid-thickness, else on the surface
  double length_step = 0.0; ///< of rest places that are moved and snap
  HandleSizes sizes;
  Eigen::Vector3d focus = Eigen::Vector3d::Zero(); ///< where there is no surface: at its depth
};

/// What an edit did to the numbers of cells.
struct EditResult
{
  bool changed = false;
  std::string message; ///< why it was refused; empty otherwise
  std::vector<Index> cell_of;
  std::vector<Index> added;
};

/// Handles at rest, made and moved by hand. Writes the dataset only when something is done: until
/// then there is a preview. Every edit is one of handle_edits.h; what these refuse changes nothing.
class RestEditor
{
public:
  explicit RestEditor(HandleData& data) : data_(data) {}
  RestSurface& surface() { return this->surface_; }

  /// The mouse is somewhere, no button held: the preview follows.
  void hover(const ScreenView& view, const Hand& hand, const EditSettings& settings);
  /// The mouse is on nothing.
  void leave();
  /// The button goes down. True when a drag or a placing has begun, or is done (see result()).
  /// @param selected  all of these are moved when one of them is
  bool press(const ScreenView& view, const Hand& hand, const EditSettings& settings,
    const std::vector<vtkIdType>& selected);
  void move(const ScreenView& view, const Hand& hand, const EditSettings& settings);
  void release(const ScreenView& view, const Hand& hand, const EditSettings& settings);
  /// Whether a button is held that began something.
  bool busy() const { return this->busy_; }
  /// The dataset as it was when that began.
  void cancel();
  /// Holds a move to axes of the world, a mask as in DragSetup; the same again: to none.
  void constrain(int axes);

  ///@{
  /// The cage that is being made: whether there is one; ends it as it is; takes its last vertex
  /// away. False when there is none.
  bool has_cage() const { return !this->cage_.empty(); }
  bool finish_cage();
  bool drop_cage_vertex();
  ///@}

  /// Of the last edit; asking clears it.
  EditResult take_result();
  /// "move rest", "add point", "add bone", "add cage vertex", "add cage edge", "close cage",
  /// "remove cage vertex".
  const std::string& name() const { return this->name_; }
  /// The end of a bone or the handle that a press would take; -1: none.
  vtkIdType target() const { return this->target_ ? this->target_->cell : -1; }

  struct Preview
  {
    std::optional<Eigen::Vector3d> ball;
    std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bone;
    std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bar;
    bool snapped = false; ///< the ball sits on something that was there
  };
  const Preview& preview() const { return this->preview_; }

private:
  /// Where something would be placed.
  struct Target
  {
    Vec3 place = Vec3::Zero();
    vtkIdType cell = -1; ///< a handle whose end is there
    bool tail = false;
    bool snapped = false;
  };
  std::optional<Target> find(const ScreenView& view, const Hand& hand, const EditSettings& settings,
    const std::optional<Vec3>& depth, bool take_ends);
  std::optional<Target> end_under(const ScreenView& view, const Eigen::Vector2d& mouse,
    const EditSettings& settings, bool any_kind) const;
  bool press_cage(const Target& target);
  bool press_rest(const ScreenView& view, const Hand& hand, const EditSettings& settings,
    const std::vector<vtkIdType>& selected);
  void move_rest(const ScreenView& view, const Hand& hand, const EditSettings& settings);
  bool edit(const char* name, const HandleListEdit& edit);
  /// The number in the list of handles that a cell has.
  Index handle_of(vtkIdType cell) const;
  vtkIdType cell_named(const std::string& name) const;
  void remember();

  HandleData& data_;
  RestSurface surface_;
  std::optional<Target> target_;
  Preview preview_;
  EditResult result_;
  std::string name_;
  bool busy_ = false;
  Target head_; // of the bone that is drawn
  std::vector<std::string> cage_; // names of the vertices that were added, in order
  // a move of rest places
  vtkSmartPointer<vtkPolyData> start_;
  std::optional<Drag> drag_;
  std::vector<HandleEnd> ends_;
  std::vector<Vec3> places_;
};

} // namespace bindpose

#endif
