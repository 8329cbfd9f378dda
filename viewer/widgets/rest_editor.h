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

/// The effect of the mouse. The values equal the edit modes of the representation.
enum class EditMode
{
  pose = 0,
  move_rest = 1,
  add_points = 2,
  add_bones = 3,
  add_cage = 4
};

/// State of the mouse and the modifiers.
struct MouseState
{
  Eigen::Vector2d mouse = Eigen::Vector2d::Zero();
  bool fine = false;
  bool snap = false;
};

struct EditSettings
{
  EditMode mode = EditMode::pose;
  /// Place points and bones inside the surface, at half of its thickness. If false, place them on
  /// the surface.
  bool place_inside = true;
  double length_step = 0.0; ///< moves of rest positions snap to multiples of this length
  HandleSizes sizes;
  /// Without a surface, new handles are placed in the plane that contains this position and faces
  /// the camera.
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();
};

/// The result of an edit: whether the dataset has changed, and the new ids of the cells.
struct EditResult
{
  bool changed = false;
  std::string message; ///< reason why the edit was refused; empty if it was not refused
  std::vector<Index> cell_of; ///< for each cell before the edit, its id after the edit, or -1
  std::vector<Index> added; ///< ids of the new cells
};

/// Creates and moves handles at rest interactively. The dataset is written only when an edit is
/// complete; until then there is a preview. The functions of handle_edits.h perform all edits. If a
/// function refuses an edit, nothing changes.
class RestEditor
{
public:
  explicit RestEditor(HandleData& data) : data_(data) {}
  RestSurface& surface() { return this->surface_; }

  /// Update the preview for a mouse position without a pressed button.
  void hover(const ScreenView& view, const MouseState& mouse_state, const EditSettings& settings);
  /// Clear the preview, for example when the mouse has left the view.
  void clear_preview();
  /// Handle a press of the button. Return true if a drag or a placement has begun or is complete
  /// (see take_result()).
  /// @param selected  selected cells; all of them are moved if one of them is dragged
  bool press(const ScreenView& view, const MouseState& mouse_state, const EditSettings& settings,
    const std::vector<vtkIdType>& selected);
  void move(const ScreenView& view, const MouseState& mouse_state, const EditSettings& settings);
  void release(const ScreenView& view, const MouseState& mouse_state, const EditSettings& settings);
  /// Report whether an interaction is in progress, i.e. a press of the button has begun an
  /// interaction, and neither a release nor a cancel has ended it.
  bool is_busy() const { return this->busy_; }
  /// Restore the dataset to its state before the interaction.
  void cancel();
  /// Constrain the current move of rest positions to axes of the world. `axes` is a mask as in
  /// DragSetup. A second call with the same mask removes the constraint.
  void constrain(int axes);

  ///@{
  /// Operations on the unfinished cage: report whether there is one; end it unchanged; remove its
  /// last vertex. Return false if there is no unfinished cage.
  bool has_cage() const { return !this->cage_.empty(); }
  bool finish_cage();
  bool drop_cage_vertex();
  ///@}

  /// Return the result of the last edit and clear it.
  EditResult take_result();
  /// Return the type of the last edit: "move rest", "add point", "add bone", "add cage vertex",
  /// "add cage edge", "close cage", "remove cage vertex".
  const std::string& name() const { return this->name_; }
  /// Return the bone or other handle to whose end a press would snap; -1 if there is none.
  vtkIdType target() const { return this->target_ ? this->target_->cell : -1; }

  struct Preview
  {
    std::optional<Eigen::Vector3d> ball;
    std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bone;
    std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bar;
    bool snapped = false; ///< the ball is on an existing handle or vertex
  };
  const Preview& preview() const { return this->preview_; }

private:
  /// The position at which a press would place a handle.
  struct Target
  {
    Vec3 position = Vec3::Zero();
    vtkIdType cell = -1; ///< a handle whose end is at this position; -1 if there is none
    bool tail = false;
    bool snapped = false;
  };
  std::optional<Target> find(const ScreenView& view, const MouseState& mouse_state,
    const EditSettings& settings, const std::optional<Vec3>& depth_point, bool snap_to_ends);
  std::optional<Target> handle_end_at(const ScreenView& view, const Eigen::Vector2d& mouse,
    const EditSettings& settings, bool any_kind) const;
  bool press_cage(const Target& target);
  bool press_rest(const ScreenView& view, const MouseState& mouse_state,
    const EditSettings& settings, const std::vector<vtkIdType>& selected);
  void move_rest(
    const ScreenView& view, const MouseState& mouse_state, const EditSettings& settings);
  bool edit(const char* name, const HandleListEdit& edit);
  /// Return the index of a cell's handle in the list of handles.
  Index handle_index(vtkIdType cell) const;
  vtkIdType cell_named(const std::string& name) const;
  void save_start();

  HandleData& data_;
  RestSurface surface_;
  std::optional<Target> target_;
  Preview preview_;
  EditResult result_;
  std::string name_;
  bool busy_ = false;
  Target head_; // head of the unfinished bone
  // Names of the vertices of the unfinished cage, in the order of the clicks.
  std::vector<std::string> cage_;
  vtkSmartPointer<vtkPolyData> start_; // the dataset before the current interaction
  std::optional<Drag> drag_; // the current move of rest positions; empty: none
  std::vector<HandleEnd> ends_; // the ends that `drag_` moves
  std::vector<Vec3> start_positions_; // positions of `ends_` before the move
};

} // namespace bindpose

#endif
