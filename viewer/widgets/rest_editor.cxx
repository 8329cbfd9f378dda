// Creates and moves handles at rest with the mouse. A click gets the first of these positions that
// exists:
// (1) The end of a handle under the mouse.
// (2) The position where the mouse ray enters the surface. With EditSettings::place_inside, points
//     and bones are placed halfway between this position and the exit of the ray.
// (3) The intersection of the mouse ray with a plane that faces the camera. The plane goes through
//     the previously placed position, if there is one.
// A cage surrounds a shape. Therefore only the first vertex of a cage is placed by (2), all other
// vertices by (3).
//
// Every edit renumbers cells, so an unfinished cage is identified by the names of its vertices.
#include "rest_editor.h"

#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{
namespace
{
constexpr double snap_pixels = 14.0;
constexpr double shortest_pixels = 5.0; // minimum length of a bone; a shorter one is a click
} // namespace

Index RestEditor::handle_index(vtkIdType cell) const
{
  Handles handles;
  std::vector<Index> cells;
  if (!to_editable(this->data_.get(), handles, cells).ok())
  {
    return -1;
  }
  const auto found = std::find(cells.begin(), cells.end(), cell);
  return found == cells.end() ? -1 : static_cast<Index>(found - cells.begin());
}

bool RestEditor::edit(const char* name, const HandleListEdit& edit)
{
  const Status status =
    edit_handles(this->data_.get(), edit, &this->result_.cell_of, &this->result_.added);
  this->name_ = name;
  this->result_.changed = status.ok();
  this->result_.message = status.message;
  return status.ok();
}

EditResult RestEditor::take_result()
{
  EditResult result = std::move(this->result_);
  this->result_ = EditResult();
  return result;
}

// ---- Position under the mouse ------------------------------------------------------------------

std::optional<RestEditor::Target> RestEditor::handle_end_at(const ScreenView& view,
  const Eigen::Vector2d& mouse, const EditSettings& settings, bool any_kind) const
{
  std::optional<Target> best;
  double nearest = std::max(settings.sizes.ball + settings.sizes.tolerance,
    any_kind ? snap_pixels * settings.sizes.ball / 7.0 : 0.0);
  const std::vector<HandleRecord> records = this->data_.records(true);
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    for (const bool tail : { true, false }) // at a joint, prefer the tail of the parent bone
    {
      const HandleRecord& record = records[i];
      const Vec3& end_position = tail ? record.tail : record.head;
      if (!record.is_handle() || (tail && !record.is_bone()) ||
        view.pixel_length_at(end_position) == 0.0)
      {
        continue;
      }
      const double distance = (view.to_display(end_position).head<2>() - mouse).norm();
      if (distance < nearest)
      {
        nearest = distance;
        best = Target{ end_position, static_cast<vtkIdType>(i), tail, true };
      }
    }
  }
  // If a head was found first, prefer a tail at the same position.
  for (std::size_t i = 0; best && !best->tail && i < records.size(); ++i)
  {
    if (records[i].is_bone() && (records[i].tail - best->position).norm() == 0.0)
    {
      best = Target{ records[i].tail, static_cast<vtkIdType>(i), true, true };
    }
  }
  return best;
}

std::optional<RestEditor::Target> RestEditor::find(const ScreenView& view,
  const MouseState& mouse_state, const EditSettings& settings,
  const std::optional<Vec3>& depth_point, bool snap_to_ends)
{
  if (snap_to_ends || mouse_state.snap)
  {
    const std::optional<Target> end =
      this->handle_end_at(view, mouse_state.mouse, settings, mouse_state.snap);
    if (end)
    {
      return end;
    }
  }
  Target target;
  const Ray ray = view.ray(mouse_state.mouse);
  const SurfaceProbe* probe = this->surface_.probe();
  LineSpan span;
  const bool cage = settings.mode == EditMode::add_cage;
  if (probe && (mouse_state.snap || !(cage && depth_point)) &&
    probe->first_inside(ray.origin, ray.direction, span))
  {
    if (mouse_state.snap)
    {
      target.position = this->surface_.nearest_vertex(span.triangle, span.entry);
      target.snapped = true;
    }
    else
    {
      target.position = settings.place_inside && !cage ? span.middle() : span.entry;
    }
    return target;
  }
  if (probe && !depth_point && !cage)
  {
    return std::nullopt; // the mouse is outside the shape
  }
  const Vec3 plane_point = depth_point ? *depth_point
    : probe                            ? this->surface_.center()
                                       : settings.focus;
  if (!intersect_plane(ray, plane_point, view.forward(), target.position))
  {
    return std::nullopt;
  }
  return target;
}

void RestEditor::clear_preview()
{
  this->target_.reset();
  this->preview_ = Preview();
}

void RestEditor::hover(
  const ScreenView& view, const MouseState& mouse_state, const EditSettings& settings)
{
  this->clear_preview();
  if (settings.mode == EditMode::pose || settings.mode == EditMode::move_rest)
  {
    return;
  }
  // Discard vertices of the unfinished cage that an undo has removed.
  while (!this->cage_.empty() && this->cell_named(this->cage_.back()) < 0)
  {
    this->cage_.pop_back();
  }
  std::optional<Vec3> depth_point;
  if (settings.mode == EditMode::add_cage && !this->cage_.empty())
  {
    depth_point = this->data_.record(this->cell_named(this->cage_.back()), true).head;
  }
  this->target_ =
    this->find(view, mouse_state, settings, depth_point, settings.mode != EditMode::add_points);
  if (this->target_)
  {
    this->preview_.ball = this->target_->position;
    this->preview_.snapped = this->target_->snapped;
    if (depth_point)
    {
      this->preview_.bar = { *depth_point, this->target_->position };
    }
  }
}

vtkIdType RestEditor::cell_named(const std::string& name) const
{
  for (vtkIdType cell = 0; cell < this->data_.count(); ++cell)
  {
    if (this->data_.name(cell) == name)
    {
      return cell;
    }
  }
  return -1;
}

// ---- The button --------------------------------------------------------------------------------

bool RestEditor::press(const ScreenView& view, const MouseState& mouse_state,
  const EditSettings& settings, const std::vector<vtkIdType>& selected)
{
  if (settings.mode == EditMode::move_rest)
  {
    this->busy_ = this->press_rest(view, mouse_state, settings, selected);
    return this->busy_;
  }
  this->hover(view, mouse_state, settings);
  if (settings.mode == EditMode::pose || !this->target_)
  {
    return false;
  }
  if (settings.mode == EditMode::add_cage)
  {
    return this->press_cage(*this->target_);
  }
  this->save_start();
  this->name_ = settings.mode == EditMode::add_points ? "add point" : "add bone";
  this->head_ = *this->target_;
  this->busy_ = true;
  return true;
}

void RestEditor::move(
  const ScreenView& view, const MouseState& mouse_state, const EditSettings& settings)
{
  if (!this->busy_)
  {
    return;
  }
  if (this->drag_)
  {
    this->move_rest(view, mouse_state, settings);
    return;
  }
  const bool bone = settings.mode == EditMode::add_bones;
  // Outside the shape, the tail of a bone is placed at the depth of the head.
  this->target_ = this->find(view, mouse_state, settings,
    bone ? std::optional<Vec3>(this->head_.position) : std::nullopt, false);
  this->preview_ = Preview();
  if (!this->target_)
  {
    return;
  }
  this->preview_.snapped = this->target_->snapped;
  this->preview_.ball = this->target_->position;
  if (bone)
  {
    this->preview_.bone = { this->head_.position, this->target_->position };
  }
}

void RestEditor::release(
  const ScreenView& view, const MouseState& mouse_state, const EditSettings& settings)
{
  if (!this->busy_)
  {
    return;
  }
  if (!this->drag_)
  {
    this->move(view, mouse_state, settings);
  }
  this->busy_ = false;
  if (this->drag_)
  {
    this->drag_.reset();
    this->result_.changed = !this->result_.cell_of.empty();
    return;
  }
  const std::optional<Target> target = this->target_;
  this->clear_preview();
  Handle handle;
  if (!target)
  {
    return;
  }
  handle.head = handle.tail = target->position;
  if (settings.mode == EditMode::add_bones)
  {
    handle.kind = HandleKind::bone;
    handle.head = this->head_.position;
    const double length =
      (view.to_display(handle.head) - view.to_display(handle.tail)).head<2>().norm();
    if (length < shortest_pixels * settings.sizes.ball / 7.0)
    {
      return; // the bone is too short: treat the press as a click
    }
    // a bone that starts at the end of another bone becomes its child
    handle.parent =
      this->data_.record(this->head_.cell).is_bone() ? this->handle_index(this->head_.cell) : -1;
  }
  this->edit(this->name_.c_str(),
    [&](const Handles& before, EditedHandles& after) { return add_handle(before, handle, after); });
}

void RestEditor::cancel()
{
  if (this->busy_)
  {
    this->busy_ = false;
    this->drag_.reset();
    this->data_.get()->ShallowCopy(this->start_);
    this->data_.get()->Modified();
    this->clear_preview();
  }
}

/// Save the dataset for a cancel. Edits replace the arrays and never write into them, so a shallow
/// copy is sufficient.
void RestEditor::save_start()
{
  this->start_ = vtkSmartPointer<vtkPolyData>::New();
  this->start_->ShallowCopy(this->data_.get());
}

// ---- Cages -------------------------------------------------------------------------------------

bool RestEditor::press_cage(const Target& target)
{
  const vtkIdType last = this->cage_.empty() ? -1 : this->cell_named(this->cage_.back());
  const HandleRecord clicked = this->data_.record(target.cell, true);
  const Index from = last < 0 ? -1 : this->handle_index(last);
  if (target.cell >= 0 && clicked.kind == static_cast<int>(HandleKind::cage_vertex))
  {
    const std::string name = this->data_.name(target.cell);
    if (target.cell == last)
    {
      this->finish_cage();
      return true;
    }
    const bool closes_cage = !this->cage_.empty() && name == this->cage_.front();
    const Index to = this->handle_index(target.cell);
    if (from < 0)
    {
      this->cage_ = { name }; // continue the cage from the clicked vertex
      return true;
    }
    // A click on the previous vertex, back along the edge that was just added, is ignored.
    const bool back = this->cage_.size() > 1 && name == this->cage_[this->cage_.size() - 2];
    if (!back)
    {
      this->edit(closes_cage ? "close cage" : "add cage edge",
        [&](const Handles& before, EditedHandles& after)
        { return toggle_cage_edge(before, from, to, after); });
    }
    if (closes_cage)
    {
      this->finish_cage();
    }
    else if (!back)
    {
      this->cage_.push_back(name);
    }
    return true;
  }
  Handle handle;
  handle.kind = HandleKind::cage_vertex;
  handle.head = handle.tail = target.position;
  const bool done = this->edit("add cage vertex",
    [&](const Handles& before, EditedHandles& after)
    {
      if (from >= 0)
      {
        handle.cage = { { static_cast<Index>(before.size()), from, -1 } };
      }
      return add_handle(before, handle, after);
    });
  if (done && !this->result_.added.empty())
  {
    this->cage_.push_back(this->data_.name(this->result_.added.front()));
  }
  return true;
}

bool RestEditor::finish_cage()
{
  const bool had_cage = !this->cage_.empty();
  this->cage_.clear();
  this->clear_preview();
  return had_cage;
}

bool RestEditor::drop_cage_vertex()
{
  if (this->cage_.empty())
  {
    return false;
  }
  const Index last = this->handle_index(this->cell_named(this->cage_.back()));
  this->cage_.pop_back();
  this->clear_preview();
  if (last >= 0)
  {
    this->edit("remove cage vertex",
      [&](const Handles& before, EditedHandles& after)
      { return remove_handles(before, { last }, after); });
  }
  return true;
}

// ---- Rest positions ----------------------------------------------------------------------------

bool RestEditor::press_rest(const ScreenView& view, const MouseState& mouse_state,
  const EditSettings& settings, const std::vector<vtkIdType>& selected)
{
  const std::vector<HandleRecord> records = this->data_.records(true);
  const HandlePick pick = pick_handle(view, records, mouse_state.mouse, settings.sizes);
  Handles handles;
  std::vector<Index> cells;
  if (pick.part == HandlePart::none || !to_editable(this->data_.get(), handles, cells).ok() ||
    records[static_cast<std::size_t>(pick.handle)].locked)
  {
    return false;
  }
  this->ends_.clear();
  this->start_positions_.clear();
  const auto add = [&](vtkIdType cell, bool tail)
  {
    const HandleEnd end{ this->handle_index(cell), tail };
    const HandleRecord& record = records[static_cast<std::size_t>(cell)];
    this->ends_.push_back(end);
    this->start_positions_.push_back(tail ? record.tail : record.head);
  };
  const auto add_head_and_tail = [&](vtkIdType cell)
  {
    const HandleRecord& record = records[static_cast<std::size_t>(cell)];
    if (record.is_handle() && !record.locked)
    {
      add(cell, false);
      if (record.is_bone())
      {
        add(cell, true);
      }
    }
  };
  const bool is_multi_selected = selected.size() > 1 &&
    std::find(selected.begin(), selected.end(), pick.handle) != selected.end();
  const bool tail = pick.part == HandlePart::tail;
  if (is_multi_selected)
  {
    for (const vtkIdType cell : selected)
    {
      add_head_and_tail(cell);
    }
  }
  else if (pick.part == HandlePart::body)
  {
    add_head_and_tail(pick.handle);
  }
  else
  {
    add(pick.handle, tail);
  }
  const HandleRecord& picked = records[static_cast<std::size_t>(pick.handle)];
  DragSetup setup;
  setup.grabbed = pick.part == HandlePart::body ? Vec3(0.5 * (picked.head + picked.tail))
    : tail                                      ? picked.tail
                                                : picked.head;
  setup.pivot = setup.grabbed;
  setup.length_step = settings.length_step;
  this->drag_.emplace(view, setup, mouse_state.mouse);
  this->save_start();
  this->name_ = "move rest";
  return true;
}

void RestEditor::constrain(int axes)
{
  if (this->drag_)
  {
    const bool same = this->drag_->setup().axes == axes;
    this->drag_->constrain(Eigen::Matrix3d::Identity(), same ? 7 : axes);
  }
}

void RestEditor::move_rest(
  const ScreenView& view, const MouseState& mouse_state, const EditSettings& settings)
{
  this->drag_->move_to(mouse_state.mouse, mouse_state.fine);
  this->drag_->set_snapping(mouse_state.snap);
  Vec3 displacement = this->drag_->motion().motion.translation();
  // Start again from the state before the drag, because edits must not accumulate.
  vtkNew<vtkPolyData> last_valid;
  last_valid->ShallowCopy(this->data_.get());
  this->data_.get()->ShallowCopy(this->start_);
  if (mouse_state.snap && this->drag_->setup().axes == 7)
  {
    // Snap to another handle's end or a vertex of the surface, if one is near.
    const std::optional<Target> target =
      this->find(view, mouse_state, settings, this->drag_->setup().grabbed, false);
    const bool is_grabbed_end = target && target->cell >= 0 &&
      (target->position - this->drag_->setup().grabbed).norm() == 0.0;
    if (target && target->snapped && !is_grabbed_end)
    {
      displacement = target->position - this->drag_->setup().grabbed;
    }
  }
  std::vector<Vec3> positions = this->start_positions_;
  for (Vec3& position : positions)
  {
    position += displacement;
  }
  if (!this->edit("move rest",
        [&](const Handles& before, EditedHandles& after)
        { return move_ends(before, this->ends_, positions, after); }))
  {
    this->data_.get()->ShallowCopy(last_valid); // restore the last valid state
  }
  this->data_.get()->Modified();
}

} // namespace bindpose
